"""Where the wire is split into stages, so that a cover can lie between the passes of a contact."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain, pairwise

import numpy as np

SAME_POINT_MM = 1e-3
"""Split points are at least this far from every contact."""

Passes = Sequence[tuple[float, float]]
"""Where along a curve each contact is passed: first time, second time."""


def stage_count(tour: Sequence[int]) -> int:
    """Count the stages that a tour of contacts needs: no stage passes a contact twice.

    Each stage goes on as far as it can, which makes the fewest.
    """
    stage = 1
    last: dict[int, int] = {}
    for contact in tour:
        if last.get(contact) == stage:
            stage += 1
        last[contact] = stage
    return max(stage, 2)  # the terminals cross too


def split_points_mm(
    passes: Passes, length_mm: float, further_mm: Sequence[float] = ()
) -> tuple[float, ...]:
    """Choose the fewest points of a curve, one at least between the two passes of each contact.

    Intervals are stabbed greedily by their ends, which is optimal for intervals; then each point
    goes to the middle of the widest stretch without a contact in the gap that it may lie in.

    Parameters
    ----------
    passes
        Of every contact; the ends of the curve, which meet, are understood.
    length_mm
        Of the curve.
    further_mm
        Places where it touches other circuits, passed once each.
    """
    gaps: list[tuple[float, float]] = []
    for first, second in sorted((*passes, (0.0, length_mm)), key=lambda one: one[1]):
        if gaps and first < gaps[-1][1] - 2 * SAME_POINT_MM:
            low, high = gaps[-1]
            gaps[-1] = max(low, first), high
        else:
            gaps.append((first, second))
    places = np.unique(np.array([*chain.from_iterable(passes), *further_mm], dtype=float))
    return tuple(_widest_middle(low, high, places) for low, high in gaps)


def _widest_middle(low: float, high: float, places: np.ndarray) -> float:
    """Middle of the widest stretch between places; of equal ones that nearest to the middle."""
    inside = places[(places > low) & (places < high)].tolist()
    edges = [low, *inside, high]
    begin, end = max(
        pairwise(edges), key=lambda s: (round(s[1] - s[0], 6), -abs(s[0] + s[1] - low - high))
    )
    return (begin + end) / 2
