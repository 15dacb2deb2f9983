"""Closed lines around loops."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from patterns.loop import Loop

Ring = NDArray[np.float64]
"""A closed line, shape (n, 2) in mm; the first point is not repeated at the end."""

CHORD_MM = 0.002
"""How far corners stand out, at most."""


def quarter_steps(radius_mm: float, chord_mm: float = CHORD_MM) -> int:
    """Chords in a quarter of a circle that stay within a distance of it."""
    half_turn = np.arccos(max(0.0, 1 - chord_mm / radius_mm))
    return max(2, int(np.ceil(np.pi / 4 / half_turn)))


def ring_around(loop: Loop, grown_mm: float = 0.0) -> Ring:
    """Give the polygon around everything within a distance of a loop, counter-clockwise.

    Its sides touch the parallel of the loop, so it holds all of it.
    """
    steps = 4 * quarter_steps(loop.largest_radius_mm + grown_mm)
    turn = 2 * np.pi / steps
    normal = turn * (np.arange(steps) + 0.5)
    long, short = loop.semi_axes_mm
    angle = normal - loop.axis_rad
    reach = np.hypot(long * np.cos(angle), short * np.sin(angle)) + grown_mm
    before, behind = np.roll(reach, 1), np.roll(normal, 1)
    # the corner in which the side meets the one before it
    x = (before * np.sin(normal) - reach * np.sin(behind)) / np.sin(turn)
    y = (reach * np.cos(behind) - before * np.cos(normal)) / np.sin(turn)
    return np.stack([x + loop.x_mm, y + loop.y_mm], axis=1)
