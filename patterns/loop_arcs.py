"""The wire along a loop as circular arcs: one on a circle, a smooth chain on an ellipse."""

from __future__ import annotations

from functools import cache
from itertools import pairwise
from math import ceil, floor, pi

import numpy as np

from patterns.biarc import biarcs
from patterns.loop import Loop
from patterns.path import Arc

ARC_TOLERANCE_MM = 1e-3
"""The chain of arcs stays this near to the ellipse."""

_SHARES = np.linspace(0.0, 1.0, 7)
_NO_PIECE = 1e-5


def loop_arcs(loop: Loop, start_rad: float, sweep_rad: float) -> tuple[Arc, ...]:
    """Lay wire along a loop.

    Ends of the chain lie exactly on the loop, in its exact direction.

    Parameters
    ----------
    start_rad
        Direction of the outward normal where the wire begins.
    sweep_rad
        How far the normal turns: at most once around, positive counter-clockwise.
    """
    if loop.axis_ratio == 1:
        return (Arc(loop.x_mm, loop.y_mm, loop.radius_mm, start_rad, sweep_rad),)
    begin, end = loop.eccentric_rad([start_rad, start_rad + sweep_rad]).tolist()
    points, tangents = loop.at_eccentric(_knots(begin, end, loop))
    return biarcs(points, np.copysign(1.0, sweep_rad) * tangents)


def _knots(begin: float, end: float, loop: Loop) -> list[float]:
    """Eccentric angles to go through: the ends of the axes, and others near enough.

    Between the ends of the axes the curvature grows or falls all the way, and that of the arcs
    stays within it: no arc is tighter than the ellipse.
    """
    low, high = sorted((begin, end))
    turns = [k * pi / 2 for k in range(floor(low / (pi / 2)) + 1, ceil(high / (pi / 2)))]
    marks = [low, *(one for one in turns if low + _NO_PIECE < one < high - _NO_PIECE), high]
    largest = _largest_step_rad(*loop.semi_axes_mm)
    knots = [low]
    for one, other in pairwise(marks):
        steps = max(1, ceil((other - one) / largest))
        knots += np.linspace(one, other, steps + 1)[1:].tolist()
    return knots if begin <= end else knots[::-1]


@cache
def _largest_step_rad(long_mm: float, short_mm: float) -> float:
    """Steps of the eccentric angle within which two arcs are near enough, tried on a quarter."""
    steps = 1
    while _deviation_mm(long_mm, short_mm, steps) > ARC_TOLERANCE_MM / 2:
        steps += 1
    return pi / 2 / steps


def _deviation_mm(long_mm: float, short_mm: float, steps: int) -> float:
    """How far arcs, through so many points of a quarter, leave an ellipse; to first order."""
    angle = np.linspace(0.0, pi / 2, steps + 1)
    axes = np.array([long_mm, short_mm])
    point = axes * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    along = axes * np.stack([-np.sin(angle), np.cos(angle)], axis=1)
    along /= np.hypot(*along.T)[:, None]
    arcs = biarcs(point, along)
    laid = np.concatenate([arc.at(_SHARES * arc.length_mm)[0] for arc in arcs])
    level = np.sum((laid / axes) ** 2, axis=1) - 1
    slope = 2 * np.hypot(*(laid / axes**2).T)
    return float(np.max(np.abs(level) / slope))
