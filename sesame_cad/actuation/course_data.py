"""An actuation in numbers: what `actuation.json` holds."""

from __future__ import annotations

from math import isfinite
from typing import Any

import numpy as np

from sesame_cad.actuation.course import Actuation
from sesame_cad.actuation.course_findings import flattened_at, supply_faults, warnings, work_J
from sesame_cad.electrics_data import in_parallel_ohm
from sesame_cad.omissions import material_omissions
from sesame_cad.omitted_data import omitted_data
from solver.omitted import OmittedTerm

Data = dict[str, Any]

FORMAT_VERSION = 1


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
        "warnings": list(warnings(made)),
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
        "flattened_at": flattened_at(made),
        "flattens_when_heated_to_C": _flattens_when_heated_to_C(made),
        "work_per_cycle_mJ": work_J(made) * 1e3,
    }


def _flattens_when_heated_to_C(made: Actuation) -> float | None:  # noqa: N802
    """Temperature of the wire at which the load flattens the array, slowly heated from cold.

    None when it never does, and when the array does not carry the load cold.
    """
    fraction = made.table.snaps_at(0.0, 1.0, made.load)
    return made.wire.transformation.heated_to(fraction) if fraction else None


def _power_data(made: Actuation) -> Data:
    current, metres = made.duty.current_A, made.body.wire_length_mm / 1e3
    cold = sum(cold * current**2 for cold, _ in made.body.resistances_ohm)
    drives = made.body.drives(current)
    joule = made.history.course.joule_J_m[made.last_cycle]
    energy = float(joule[-1] - joule[0]) * metres
    work = work_J(made)
    return {
        "power_cold_W": cold,
        "power_hot_W": sum(drive.power_W for drive in drives),
        "voltage_hot_V": max(drive.voltage_V for drive in drives),
        "energy_per_cycle_J": energy,
        "work_over_energy": work / energy if energy > 0 else None,
        "supply_faults": list(supply_faults(made)),
    }


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
