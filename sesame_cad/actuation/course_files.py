"""An actuation as tables and pictures."""

from __future__ import annotations

from itertools import chain, repeat

import numpy as np
from numpy.typing import NDArray

from sesame_cad.actuation.course import SAMPLES, Actuation
from sesame_cad.files.table_csv import Column, table_csv
from sesame_cad.omissions import GRAVITY_M_S2
from sesame_cad.pictures.curves import COLD, HOT, NEUTRAL, Line, Panel, curves_picture
from sesame_cad.state import CellState, loop_materials
from solver.equilibrium import Equilibrium

Values = NDArray[np.float64]

_ROOM_C = 5.0
"""The picture of the path goes on this far beyond the transformations."""

_LOAD_FRACTIONS = (0.0, 0.25, 0.5, 0.75, 1.0)


def actuation_files(made: Actuation) -> dict[str, bytes]:
    """Everything but `actuation.json`, by path in the folder."""
    path, time, load = path_columns(made), time_columns(made), load_columns(made)
    files = {
        "curves/path.csv": table_csv(path).encode(),
        "curves/time.csv": table_csv(time).encode(),
        "curves/load.csv": table_csv(load).encode(),
    }
    if not made.spec.output.pictures:
        return files
    return files | {
        "pictures/path.png": _path_picture(made, path),
        "pictures/time.png": _time_picture(made),
        "pictures/load.png": _load_picture(made),
    }


def path_columns(made: Actuation) -> dict[str, Column]:
    """Every state of the free array, slowly heated and cooled again."""
    law, path = made.wire.transformation, made.path
    fractions = [float(one) for one in path.fractions]
    ways = [
        *zip(repeat("heating"), fractions, path.heating, strict=False),
        *zip(repeat("cooling"), reversed(fractions), reversed(path.cooling), strict=False),
    ]
    states = [_cell_state(made, fraction, found) for _, fraction, found in ways]
    return {
        "way": [way for way, _, _ in ways],
        "temperature_C": [
            (law.heated_to if way == "heating" else law.cooled_to)(fraction)
            for way, fraction, _ in ways
        ],
        "austenite_fraction": [fraction for _, fraction, _ in ways],
        "modulus_GPa": [float(made.wire.modulus_Pa(fraction)) / 1e9 for _, fraction, _ in ways],
        "beta": [found.scene.beta for _, _, found in ways],
        "height_mm": [state.height_mm for state in states],
        "pitch_mm": [state.pitch_mm for state in states],
        "width_mm": [state.footprint_mm[0] for state in states],
        "depth_mm": [state.footprint_mm[1] for state in states],
        "loop_energy_mJ": [state.energy_mJ for state in states],
        "lowest_eigenvalue": [found.lowest_eigenvalue for _, _, found in ways],
    }


def _cell_state(made: Actuation, fraction: float, found: Equilibrium) -> CellState:
    modulus_GPa = float(made.wire.modulus_Pa(fraction)) / 1e9  # noqa: N806
    materials = loop_materials(made.spec, modulus_GPa)
    return CellState(f"{fraction:g}", found, materials, (), 0.0, made.spec.layout.cells())


def time_columns(made: Actuation) -> dict[str, Column]:
    """The wire and the array through all cycles; energies of the whole array."""
    course, metres = made.history.course, made.body.wire_length_mm / 1e3
    ratio = made.path.cell.modulus_ratio
    return {
        "time_s": course.time_s.tolist(),
        "current_A": made.history.current_A.tolist(),
        "temperature_C": course.temperature_C.tolist(),
        "austenite_fraction": course.fraction.tolist(),
        "beta": (made.path.cell.cold.beta * (1 + course.fraction * (ratio - 1))).tolist(),
        "resistance_ohm_m": made.wire.resistance_ohm_m(course.fraction).tolist(),
        "height_mm": made.heights_mm.tolist(),
        "height_under_load_mm": made.loaded[0].tolist(),
        "joule_J": (course.joule_J_m * metres).tolist(),
        "loss_J": (course.loss_J_m * metres).tolist(),
    }


def load_columns(made: Actuation) -> dict[str, Column]:
    """Height of the wires under a slab, at several fractions of austenite, while they stand."""
    curves = [(fraction, *_standing(made, fraction)) for fraction in _LOAD_FRACTIONS]
    return {
        "austenite_fraction": list(chain(*(repeat(f, len(h)) for f, h, _ in curves))),
        "load_g": list(chain(*(loads.tolist() for _, _, loads in curves))),
        "height_mm": list(chain(*(heights.tolist() for _, heights, _ in curves))),
    }


def _standing(made: Actuation, fraction: float) -> tuple[Values, Values]:
    """Heights in mm and loads in g of the whole array, from none to that which flattens it."""
    heights, forces = made.table.curve(fraction)
    last = int(np.argmax(forces)) + 1
    chosen = np.unique(np.linspace(0, last - 1, 41).astype(int))
    loads = forces[chosen] * made.array_force_unit_N / GRAVITY_M_S2 * 1e3
    return heights[chosen] * made.radius_mm, loads


def _path_picture(made: Actuation, columns: dict[str, Column]) -> bytes:
    way = np.array(columns["way"])
    temperature_C = np.array(columns["temperature_C"])  # noqa: N806
    ends_C = temperature_C.min() - _ROOM_C, temperature_C.max() + _ROOM_C  # noqa: N806

    def line(key: str, name: str, colour: str) -> Line:
        """One way, with the stretches before and after in which the wire only changes heat."""
        outer = ends_C if name == "heating" else ends_C[::-1]
        known, own = temperature_C[way == name], np.array(columns[key])[way == name]
        x = np.concatenate([outer[:1], known, outer[1:]])
        return Line(x, np.concatenate([own[:1], own, own[-1:]]), name, colour, marked=True)

    panels = [
        Panel(quantity, [line(key, "heating", HOT), line(key, "cooling", COLD)])
        for quantity, key in (
            ("height in mm", "height_mm"),
            ("pitch in mm", "pitch_mm"),
            ("energy of a loop in mJ", "loop_energy_mJ"),
        )
    ]
    title = f"{made.spec.name}: slowly heated and cooled, without load"
    return curves_picture(title, "temperature of the wire in °C", panels)


def _time_picture(made: Actuation) -> bytes:
    course = made.history.course
    time = course.time_s
    names = ("As", "Af", "Ms", "Mf")
    levels = list(zip(made.wire.transformation.temperatures_C, names, strict=True))
    heights = [Line(time, made.heights_mm, "without load" if made.load > 0 else "", NEUTRAL)]
    if made.load > 0:
        load = f"under {made.spec.actuation.load_g:g} g"
        heights = [
            Line(time, made.loaded[0], load, HOT),
            Line(time, made.heights_mm, "without load", NEUTRAL, dashed=True),
        ]
    spans = [
        (float(time[k]), float(time[k + SAMPLES - 1]))
        for k in range(0, len(time), SAMPLES)
        if made.history.current_A[k] > 0
    ]
    panels = [
        Panel("temperature in °C", [Line(time, course.temperature_C)], levels),
        Panel("fraction of austenite", [Line(time, course.fraction)]),
        Panel("height in mm", heights),
    ]
    title = f"{made.spec.name}: {made.duty.current_A:g} A while shaded"
    return curves_picture(title, "time in s", panels, spans)


def _load_picture(made: Actuation) -> bytes:
    colours = (COLD, "#56B4E9", "#999999", "#E69F00", HOT)
    lines: list[Line] = []
    for fraction, colour in zip(_LOAD_FRACTIONS, colours, strict=True):
        heights, loads = _standing(made, fraction)
        name = {0.0: "cold", 1.0: "hot"}.get(fraction, f"{100 * fraction:g} % austenite")
        lines.append(Line(loads, heights, name, colour))
    title = f"{made.spec.name}: height under a slab; where a curve ends, it snaps flat"
    return curves_picture(title, "mass of the slab in g", [Panel("height in mm", lines)])
