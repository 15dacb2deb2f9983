"""Where one wire comes near another, or near itself."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from patterns.path import Vectors
from patterns.wire_index import Numbers, WireIndex

_COARSE_MM = 2.0
_FINE_MM = 0.005


@dataclass(frozen=True)
class _Gap:
    """Distance from places on one wire to another wire, or to farther parts of the same one.

    The other wire starts ``offset_mm`` along the one. Places less than pi/2 times the separation
    apart along the wire are the same stretch of it: a bend of radius no less than that separation
    turns back no sooner.
    """

    wire: WireIndex
    other: WireIndex
    offset_mm: float
    separation_mm: float
    among: NDArray[np.bool_] | None

    def at(self, s_mm: Numbers) -> Numbers:
        reach = self.separation_mm + _COARSE_MM
        apart = np.pi / 2 * self.separation_mm
        points = self.wire.at(s_mm)
        here = s_mm - self.offset_mm
        nearest = self.other.nearest(points, reach, away_from=(here, apart), among=self.among)
        return nearest.distance_mm


def near_stretches(
    wire: WireIndex,
    other: WireIndex,
    offset_mm: float,
    separation_mm: float,
    among: NDArray[np.bool_] | None = None,
) -> Vectors:
    """Find the stretches of a wire that are nearer to another one than a separation.

    Parameters
    ----------
    wire, other : WireIndex
        Centrelines; they may be the same.
    offset_mm : float
        Arclength, counted along ``wire``, at which ``other`` starts: the length of ``wire`` when
        ``other`` continues it, 0 when they are the same, less than 0 when ``wire`` is a part of
        ``other`` farther on.
    separation_mm : float
        Distance of the centrelines, much smaller than the radius of any bend.
    among : array of bool, optional
        Which pieces of the other wire are looked at.

    Returns
    -------
    array (n, 2)
        Start and end of each stretch along ``wire``, in order, apart from one another. Ends are
        exact to 0.005 mm and never too far inside.
    """
    gap = _Gap(wire, other, offset_mm, separation_mm, among)
    station = np.linspace(0.0, wire.length_mm, 1 + int(np.ceil(wire.length_mm / _COARSE_MM)))
    distance = gap.at(station)
    cells = np.stack([station[:-1], station[1:], distance[:-1], distance[1:]], axis=1)
    return _joined(np.concatenate(_near_cells(gap, cells)))


def _near_cells(gap: _Gap, cells: Vectors) -> list[Vectors]:
    """Halve the cells (start, end, distance at start, at end) that straddle the separation.

    Distance changes no faster than arclength, so the distances at the ends of a cell bound it
    within.
    """
    near = [np.empty((0, 2))]
    while len(cells):
        size = cells[:, 1] - cells[:, 0]
        middle = (cells[:, 2] + cells[:, 3]) / 2
        inside = middle + size / 2 < gap.separation_mm
        doubtful = ~inside & (middle - size / 2 < gap.separation_mm)
        inside |= doubtful & (size < _FINE_MM)
        near.append(cells[inside, :2])
        cells = _halved(gap, cells[doubtful & ~inside])
    return near


def _halved(gap: _Gap, cells: Vectors) -> Vectors:
    start, end, at_start, at_end = cells.T
    middle = (start + end) / 2
    at_middle = gap.at(middle)
    left = np.stack([start, middle, at_start, at_middle], axis=1)
    right = np.stack([middle, end, at_middle, at_end], axis=1)
    return np.concatenate([left, right])


def _joined(cells: Vectors) -> Vectors:
    cells = cells[np.argsort(cells[:, 0])]
    breaks = np.flatnonzero(cells[1:, 0] > cells[:-1, 1] + 1e-9)
    first = np.concatenate([[0], breaks + 1]) if len(cells) else np.empty(0, dtype=np.int64)
    last = np.concatenate([breaks, [len(cells) - 1]]) if len(cells) else first
    return np.stack([cells[first, 0], cells[last, 1]], axis=1)
