"""The blocks ``sleeve`` and ``bistable`` of `design.json`."""

from __future__ import annotations

from math import degrees
from typing import Any

from sesame_cad.omitted_data import omitted_data
from solver.sleeve.couple import SleeveCouple
from solver.sleeve.segment import SegmentPrediction
from solver.strip.state import Side, StripState

Data = dict[str, Any]

_MILLI = 1e3
_LOWER, _UPPER = "lower", "upper"


def sleeve_data(prediction: SegmentPrediction) -> Data:
    """What a sleeve does, cold and hot, on a straight beam; and what the prediction leaves out."""
    cold, hot = prediction.cold, prediction.hot
    return {
        "loops": prediction.segment.loops,
        "compressed_pitch_mm": prediction.segment.pitch_m * _MILLI,
        "free_pitch_mm": prediction.free_pitch_m * _MILLI,
        "stripe": "does not stretch, slack where loops are narrower",
        "force_N": {"cold": cold.force_N, "hot": hot.force_N},
        "moment_Nmm": {"cold": cold.couple_N_m * _MILLI, "hot": hot.couple_N_m * _MILLI},
        "net_moment_Nmm": prediction.couple_N_m * _MILLI,
        "arm_mm": {"cold": cold.arm_m * _MILLI, "hot": hot.arm_m * _MILLI},
        "tip_height_mm": {
            "cold": cold.tip_height_m * _MILLI,
            "hot": hot.tip_height_m * _MILLI,
        },
        "bending_stiffness_Nmm2": {
            "beam": prediction.segment.strip.stiffness_N_m2 * _MILLI**2,
            "cold": cold.bending_stiffness_N_m2 * _MILLI**2,
            "hot": hot.bending_stiffness_N_m2 * _MILLI**2,
        },
        "stripe_tension_N": {
            "cold": cold.pressed.stripe_tension_N,
            "hot": hot.pressed.stripe_tension_N,
        },
        "solve": {"cold": _solve_data(cold), "hot": _solve_data(hot)},
        "omitted_terms": omitted_data(prediction.omitted),
    }


def bistable_data(prediction: SegmentPrediction) -> Data:
    """Both states of a segment, the barrier between them, and what heating one side does."""
    critical, released = prediction.critical_couple_N_m, prediction.released_J
    heated = {"+": _LOWER, "-": _UPPER}
    rest = prediction.rest.unloaded
    return {
        "length_mm": prediction.segment.strip.length_m * _MILLI,
        "chord_mm": prediction.segment.strip.constraint_m * _MILLI,
        "ends": str(prediction.segment.strip.ends),
        "states": [
            _state_data(rest[side]) | {"snaps_when_heated": heated[side.value]}
            for side in (Side.UP, Side.DOWN)
        ],
        "barrier_mJ": _milli(prediction.barrier_J),
        "critical_couple_Nmm": _milli(critical),
        "snaps": prediction.snaps,
        "margin": prediction.margin,
        "energy_released_mJ": _milli(released),
    }


def _milli(value: float | None) -> float | None:
    return None if value is None else value * _MILLI


def _state_data(state: StripState) -> Data:
    return {
        "state": state.side.value,
        "height_mm": state.height_m * _MILLI,
        "end_angles_deg": [degrees(state.headings_rad[k]) for k in (0, -1)],
        "energy_mJ": state.bending_J * _MILLI,
        "compression_N": state.force_N,
        "lowest_eigenvalue_mJ": state.eigenvalue_J * _MILLI,
    }


def _solve_data(couple: SleeveCouple) -> Data:
    held = couple.pressed.held
    return {
        "gradient_norm": held.gradient_norm,
        "lowest_eigenvalue": held.lowest_eigenvalue,
        "unknowns": held.unknowns,
        "relative_error": held.change,
    }
