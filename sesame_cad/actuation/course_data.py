"""An actuation in numbers: what `actuation.json` holds."""

from __future__ import annotations

from collections.abc import Iterator
from math import isfinite
from typing import Any

import numpy as np

from patterns.electrics import Supply
from sesame_cad.actuation.course import Actuation
from sesame_cad.electrics_data import in_parallel_ohm
from sesame_cad.omissions import material_omissions
from sesame_cad.omitted_data import omitted_data
from solver.omitted import OmittedTerm

Data = dict[str, Any]

FORMAT_VERSION = 1
THREAD_MELTS_C = 250.0
"""Polyester, of which embroidery thread is made, melts from about here on (250 to 260 °C)."""

_SMALL = 0.01
"""A fraction of austenite below this is none."""


def actuation_data(made: Actuation) -> Data:
    """Everything in `actuation.json` but the list of files; null where something never happens."""
    return {
        "format": FORMAT_VERSION,
        "name": made.spec.name,
        "wire": _wire_data(made),
        "surroundings": _surroundings_data(made),
        "duty": {
            "current_A": made.duty.current_A,
            "heating_s": made.duty.heating_s,
            "cooling_s": made.duty.cooling_s,
            "cycles": made.duty.cycles,
        },
        "array": _array_data(made),
        "heat": _heat_data(made),
        "path": _path_data(made),
        "stroke": _stroke_data(made),
        "load": _load_data(made),
        "power": _power_data(made),
        "warnings": list(_warnings(made)),
        "omitted_terms": omitted_data(_omitted(made)),
        "specification": made.spec.model_dump(mode="json"),
    }


def _wire_data(made: Actuation) -> Data:
    wire, law = made.wire, made.wire.transformation
    start_A, finish_A, start_M, finish_M = law.temperatures_C  # noqa: N806
    return {
        "diameter_mm": made.spec.wire.diameter_mm,
        "austenite_start_C": start_A,
        "austenite_finish_C": finish_A,
        "martensite_start_C": start_M,
        "martensite_finish_C": finish_M,
        "modulus_cold_GPa": made.spec.wire.modulus_cold_GPa,
        "modulus_hot_GPa": made.spec.wire.modulus_hot_GPa,
        "mass_g_m": wire.mass_kg_m * 1e3,
        "resistance_ohm_m_cold": float(wire.resistance_ohm_m(0.0)),
        "resistance_ohm_m_hot": float(wire.resistance_ohm_m(1.0)),
    }


def _surroundings_data(made: Actuation) -> Data:
    loss = made.around.loss_W_mK(made.wire)
    capacity = made.wire.mass_kg_m * made.wire.heat_capacity_J_kgK
    given = made.spec.actuation.convection_W_m2K is not None
    return {
        "ambient_C": made.around.ambient_C,
        "convection_W_m2K": made.around.convection_W_m2K,
        "convection_from": "specification" if given else "horizontal wire in still air",
        "time_constant_s": capacity / loss if loss > 0 else None,
    }


def _array_data(made: Actuation) -> Data:
    body = made.body
    cold, hot = zip(*body.resistances_ohm, strict=True)
    return {
        "cells": body.cells,
        "wire_length_mm": body.wire_length_mm,
        "mass_g": body.mass_g,
        "wire_g": body.wire_g,
        "fabric_g": body.fabric_g,
        "resistance_ohm_cold": in_parallel_ohm(cold),
        "resistance_ohm_hot": in_parallel_ohm(hot),
    }


def _heat_data(made: Actuation) -> Data:
    course, metres = made.history.course, made.body.wire_length_mm / 1e3
    stored = made.wire.stored_J_m(course.temperature_C, course.fraction)
    gained, joule = float(stored[-1] - stored[0]), float(course.joule_J_m[-1])
    loss = float(course.loss_J_m[-1])
    return {
        "final_C": made.final_C,
        "highest_C": float(course.temperature_C.max()),
        "highest_austenite_fraction": float(course.fraction.max()),
        "last_austenite_fraction": float(course.fraction[-1]),
        "joule_J": joule * metres,
        "loss_J": loss * metres,
        "stored_J": gained * metres,
        "balance_error": abs(joule - loss - gained) / joule if joule > 0 else 0.0,
    }


def _path_data(made: Actuation) -> Data:
    states = (*made.path.heating, *made.path.cooling)
    law = made.wire.transformation
    return {
        "states": len(states),
        "status": "converged",
        "largest_gradient_norm": max(one.gradient_norm for one in states),
        "lowest_eigenvalue": min(one.lowest_eigenvalue for one in states),
        "largest_height_change": max(one.height_change for one in states),
        "events": [
            {
                "kind": event.kind,
                "way": event.way,
                "austenite_fraction": event.fraction,
                "temperature_C": (
                    law.heated_to(event.fraction)
                    if event.way == "heating"
                    else law.cooled_to(event.fraction)
                ),
            }
            for event in made.path.events
        ],
    }


def _stroke_data(made: Actuation) -> Data:
    response, unit = made.path.response, made.radius_mm
    ends = np.array([0.0, 1.0])
    (cold, hot), pitches = response.height(ends) * unit, response.width(ends) * unit
    cycle = made.working_mm[made.last_cycle]
    tallest = max(cold, hot)
    return {
        "height_cold_mm": float(cold),
        "height_hot_mm": float(hot),
        "stroke_mm": float(cold - hot),
        "stroke_over_height": float(abs(cold - hot) / tallest) if tallest > 0 else None,
        "pitch_cold_mm": float(pitches[0]),
        "pitch_hot_mm": float(pitches[1]),
        "last_cycle_highest_mm": float(cycle.max()),
        "last_cycle_lowest_mm": float(cycle.min()),
        "last_cycle_stroke_mm": float(np.ptp(cycle)),
        "time_to_90_percent_s": made.time_to_s(0.9),
        "time_back_50_percent_s": made.time_back_s(0.5),
        "time_back_90_percent_s": made.time_back_s(0.9),
    }


def _load_data(made: Actuation) -> Data:
    mass_g, load_g = made.body.mass_g, made.spec.actuation.load_g
    cold_g, hot_g = made.flattening_load_g(0.0), made.flattening_load_g(1.0)
    return {
        "load_g": load_g,
        "load_on_a_cell_N": made.load_N / made.body.cells,
        "load_over_mass": load_g / mass_g,
        "height_cold_mm": made.height_mm(0.0),
        "height_hot_mm": made.height_mm(1.0),
        "slab_above_support_cold_mm": made.height_mm(0.0) + made.spec.wire.diameter_mm,
        "slab_above_support_hot_mm": made.height_mm(1.0) + made.spec.wire.diameter_mm,
        "flattening_load_cold_g": cold_g,
        "flattening_load_hot_g": hot_g,
        "flattening_load_over_mass_cold": cold_g / mass_g,
        "flattening_load_over_mass_hot": hot_g / mass_g,
        "flattened_at": _snap_data(made),
        "work_per_cycle_mJ": _work_J(made) * 1e3,
    }


def _snap_data(made: Actuation) -> Data | None:
    """When and where the load flattens the array."""
    heights, place = made.loaded
    if place is None or heights.size == 0:
        return None
    course = made.history.course
    return {
        "time_s": float(course.time_s[place]),
        "temperature_C": float(course.temperature_C[place]),
        "austenite_fraction": float(course.fraction[place]),
    }


def _work_J(made: Actuation) -> float:  # noqa: N802 - the unit's own spelling
    """What the array lifts the slab by in the last cycle, on its way up; none once flattened."""
    if made.loaded[1] is not None:
        return 0.0
    rises = np.maximum(np.diff(made.loaded[0][made.last_cycle]), 0.0)
    return made.load_N * float(rises.sum()) / 1e3


def _power_data(made: Actuation) -> Data:
    current, metres = made.duty.current_A, made.body.wire_length_mm / 1e3
    cold = sum(cold * current**2 for cold, _ in made.body.resistances_ohm)
    drives = made.body.drives(current)
    joule = made.history.course.joule_J_m[made.last_cycle]
    energy = float(joule[-1] - joule[0]) * metres
    supply = Supply(made.spec.supply.voltage_V, made.spec.supply.current_A)
    work = _work_J(made)
    return {
        "power_cold_W": cold,
        "power_hot_W": sum(drive.power_W for drive in drives),
        "voltage_hot_V": max(drive.voltage_V for drive in drives),
        "energy_per_cycle_J": energy,
        "work_over_energy": work / energy if energy > 0 else None,
        "supply_faults": list(made.body.supply_faults(supply, current)),
    }


def _warnings(made: Actuation) -> Iterator[str]:
    """Say in a line each what keeps the array from working as an actuator."""
    law, heat = made.wire.transformation, made.spec.actuation
    for fault in _power_data(made)["supply_faults"]:
        yield f"the supply cannot drive the array: {fault}"
    if made.start.fraction > 1 - _SMALL:
        yield f"at {heat.ambient_C:g} C the wire is hot before any current flows"
    elif made.history.course.fraction.max() < made.start.fraction + _SMALL:
        yield (
            f"the wire does not transform: it reaches {made.history.course.temperature_C.max():.1f}"
            f" C, and austenite begins at {law.austenite_start_C:g} C"
        )
    highest_C = float(made.history.course.temperature_C.max())  # noqa: N806
    if highest_C > THREAD_MELTS_C:
        yield (
            f"the wire reaches {highest_C:.0f} C, and polyester thread melts at "
            f"{THREAD_MELTS_C:g} C; lower wire.current_A or actuation.heating_s"
        )
    stays = float(law.cooled(heat.ambient_C))
    if stays > _SMALL:
        yield (
            f"once heated the wire stays hot: it cools to {heat.ambient_C:g} C, where "
            f"{100 * stays:.0f} % is still austenite, and turns back from "
            f"{law.martensite_start_C:g} to {law.martensite_finish_C:g} C; take wire of a higher "
            "transition, or check actuation.hysteresis_C"
        )
    snap = _snap_data(made)
    if snap is not None:
        yield (
            f"the load flattens the array after {snap['time_s']:.3g} s, at "
            f"{snap['temperature_C']:.1f} C, and it stays flat as long as the load lies on it"
        )


def _omitted(made: Actuation) -> tuple[OmittedTerm, ...]:
    body = made.body
    fabric_share = body.fabric_g / body.wire_g
    wanted = ("bending of the fabric", "gravity", "fabric left outside the wire")
    terms = [t for t in material_omissions(made.spec, made.materials) if t.term in wanted]
    known = {t.term: t for one in made.path.heating for t in one.omitted if isfinite(t.value)}
    terms += [t for t in known.values() if t.term not in wanted and t.matters]
    return (
        *terms,
        OmittedTerm(
            "heat that fabric and thread take up",
            "mass of the fabric / mass of the wire",
            fabric_share,
            matters=fabric_share > 0.1,
        ),
        OmittedTerm(
            "heat that flows into the slab, the support and the crimps",
            "load / mass of the wire",
            made.spec.actuation.load_g / body.wire_g,
            matters=made.spec.actuation.load_g > 0,
        ),
    )
