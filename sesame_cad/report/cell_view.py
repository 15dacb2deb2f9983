"""A grid of equal loops in space: one loop's shapes on the way, to be copied to every place."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from sesame_cad.report.fabric_look import FabricLook, fabric_look
from sesame_cad.report.heating import austenite_fraction, heating_data
from sesame_cad.report.packing import packed_reals
from sesame_cad.report.solved_path import SolvedPath, solved_path
from sesame_cad.specification import Specification
from sesame_cad.state import CellState
from solver.edge import EdgeCurve
from solver.loop_energy import scene_membrane
from solver.mesh.fabric_law import StVenantKirchhoff
from solver.mesh.fields import strained_fields
from solver.mesh.triangle_energy import green_lagrange
from solver.shape import LoopShape

Data = dict[str, Any]
Vectors = NDArray[np.float64]

RINGS, SEGMENTS = 16, 96
"""Of the fabric; the page leaves out every second or fourth where there are many loops."""

_NEAR_CENTRE = 1e-6
"""Derivatives have no direction at the centre itself."""


def cell_view(spec: Specification, cold: CellState, hot: CellState) -> Data:
    """Data of the 3-D view.

    Points are listed from the centre outward, ring by ring, each from the +x axis; of the wire once
    around. Lengths are in mm, tension in N/m, stretch in percent, curvature in 1/mm.
    """
    path = solved_path(spec, cold, hot)
    radius, angle = _grid()
    shapes = [state.shape for state in path.states]
    scale = cold.radius_mm
    looks = [_look(spec, cold, shape) for shape in shapes]
    places = np.array(cold.cells, dtype=np.float64)[:, ::-1]
    return {
        "kind": "cell",
        "rings": RINGS,
        "segments": SEGMENTS,
        "wireDiameterMm": spec.wire.diameter_mm,
        "places": (places - (places.min(axis=0) + places.max(axis=0)) / 2).tolist(),
        "points": packed_reals(np.stack([scale * s.position(radius, angle) for s in shapes])),
        "stretch": packed_reals(np.stack([one.stretch_percent for one in looks])),
        "tension": packed_reals(np.stack([one.tension_N_m for one in looks])),
        "curvature": packed_reals(
            np.stack([_curvature(s.curve, SEGMENTS) / scale for s in shapes])
        ),
        "heating": heating_data(spec),
        "states": _states(spec, path),
        "whole": path.whole,
    }


def _states(spec: Specification, path: SolvedPath) -> list[Data]:
    stops = {0: "flat", path.cold: "cold", len(path.states) - 1: "hot"}
    return [
        {
            "stop": stops.get(k),
            "heightMm": state.height_mm,
            "pitchMm": state.pitch_mm,
            "modulusGPa": state.wire_modulus_GPa,
            # a softer and softer wire on the way to the cold shape is not a cooler one
            "austenite": austenite_fraction(spec, state.wire_modulus_GPa)
            if k >= path.cold
            else None,
        }
        for k, state in enumerate(path.states)
    ]


def _grid() -> tuple[Vectors, Vectors]:
    """Radius and angle of each point of the unit disc."""
    radius = np.repeat(np.arange(1, RINGS + 1) / RINGS, SEGMENTS)
    angle = np.tile(np.arange(SEGMENTS) * (2 * np.pi / SEGMENTS), RINGS)
    return np.append(0.0, radius), np.append(0.0, angle)


def _look(spec: Specification, state: CellState, shape: LoopShape) -> FabricLook:
    membrane = scene_membrane(state.equilibrium.scene)
    radius, angle = _grid()
    gradient = _gradient(shape, np.maximum(radius, _NEAR_CENTRE), angle)
    strain = green_lagrange(gradient * membrane.stretch)
    return fabric_look(spec, strained_fields(strain, StVenantKirchhoff(membrane.stiffness)))


def _gradient(shape: LoopShape, radius: Vectors, angle_rad: Vectors) -> Vectors:
    """Derivatives (n, 3, 2) of the position by x and y of the unit disc."""
    out = np.zeros((len(radius), 3, 2))
    for (component, function), value in shape.expansion.items():
        out[:, component] += value * np.stack(function.gradient(radius, angle_rad), axis=-1)
    return out


def _curvature(curve: EdgeCurve, count: int) -> Vectors:
    """Curvature (count,) in units of 1/R at equal angles: |x' × x''| / |x'|³."""
    angle = np.arange(count, dtype=np.float64) * (2 * np.pi / count)
    along, bend = curve.position(angle, 1), curve.position(angle, 2)
    across = np.linalg.norm(np.cross(along, bend), axis=1)
    return across / np.linalg.norm(along, axis=1) ** 3
