"""Force of a sleeve against its pitch, cold and hot."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.sleeve.couple import SleeveCouple
from solver.sleeve.pressed import SHORTEST_PITCH, free_pitch_m, press_along
from solver.sleeve.segment import SegmentPrediction

Vectors = NDArray[np.float64]

SAMPLES = 13
_BELOW = 0.8
"""Of the compressed pitch: where curves begin."""


@dataclass(frozen=True)
class ForceCurve:
    """A sleeve's force at pitches from below the compressed to the free one.

    Attributes
    ----------
    temperature : str
        ``"cold"`` or ``"hot"``.
    pitch_mm, force_N, crest_height_mm, stripe_tension_N : array (n,)
        Crests over valleys; rising pitches.
    """

    temperature: str
    pitch_mm: Vectors
    force_N: Vectors  # noqa: N815 - the units' own names
    crest_height_mm: Vectors
    stripe_tension_N: Vectors  # noqa: N815


def force_curves(prediction: SegmentPrediction) -> tuple[ForceCurve, ForceCurve]:
    """Give the curves cold and hot.

    Raises
    ------
    NotConvergedError
        When a loop has no shape to rely on at some pitch.
    """
    return _curve("cold", prediction.cold), _curve("hot", prediction.hot)


def _curve(temperature: str, couple: SleeveCouple) -> ForceCurve:
    cell = couple.pressed.cell
    shortest = 2 * SHORTEST_PITCH * cell.materials.loop_radius_m
    begin = max(shortest, _BELOW * couple.pressed.pitch_m)
    pitches = np.linspace(free_pitch_m(cell), begin, SAMPLES)
    found = list(press_along(cell, pitches.tolist()))[::-1]
    return ForceCurve(
        temperature,
        pitch_mm=1e3 * pitches[::-1],
        force_N=np.array([one.force_N for one in found]),
        crest_height_mm=np.array([1e3 * one.crest_height_m for one in found]),
        stripe_tension_N=np.array([one.stripe_tension_N for one in found]),
    )


def force_curve_csv(curves: tuple[ForceCurve, ...]) -> str:
    """Write a line a pitch."""
    lines = ["temperature,pitch_mm,force_N,crest_height_mm,stripe_tension_N"]
    for curve in curves:
        columns = (curve.pitch_mm, curve.force_N, curve.crest_height_mm, curve.stripe_tension_N)
        rows = np.round(np.stack(columns, axis=1), 4) + 0.0
        lines += [f"{curve.temperature},{','.join(f'{v:.4f}' for v in row)}" for row in rows]
    return "\n".join(lines) + "\n"
