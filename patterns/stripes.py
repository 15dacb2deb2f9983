"""Stripes of thread that does not stretch, across the loops, sewn when all wire is laid."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, cos, radians, sin
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from patterns.errors import PatternError
from patterns.laid_wire import LaidWire
from patterns.layout import Loop
from patterns.locks import with_locks
from patterns.path import Vectors
from patterns.stitching import Stitching, Stripes

GRID_MM = 0.05
"""Distance of the places along a stripe at which room for the needle is looked for."""

SAME_LINE_MM = 0.01
"""Centres of loops that lie this near to a line share a stripe."""

FARTHEST_END_MM = 2.0
"""Past the nearest place outside of the outer wire, or inside its loop, no end is looked for."""

ROUND_OFF_MM = 1e-6

ANGLE_DEG: Mapping[Stripes, float] = MappingProxyType({"rows": 0.0, "columns": 90.0})
"""Directions of the stripes that a setting may ask for."""

Lengths = NDArray[np.float64]


@dataclass(frozen=True)
class _Line:
    """A line through centres of loops: direction, distance from the origin, and the loops' places.

    Attributes
    ----------
    along, across : array (2,)
        Unit vectors.
    offset_mm : float
        Along ``across``.
    loops : array (n, 2)
        Place along the line and radius of each loop, in order.
    """

    along: Lengths
    across: Lengths
    offset_mm: float
    loops: Vectors

    def at(self, t_mm: Lengths) -> Vectors:
        return t_mm[:, None] * self.along + self.offset_mm * self.across


def stripes(
    loops: Sequence[Loop],
    laid: LaidWire,
    *,
    angle_deg: float,
    clear_mm: float,
    longest_mm: float,
    stitching: Stitching,
) -> list[Vectors]:
    """Sew straight lines through the centres of loops, from outside the first wire past the last.

    Loops on one line that touch share a stripe. Over wire goes one stitch that steps over all of
    it: the needle goes in only where it misses every wire.

    Parameters
    ----------
    loops
        The loops that get a stripe.
    laid
        All wire.
    angle_deg
        Direction of the stripes, from the x axis.
    clear_mm
        Smallest distance of the needle from a centreline.
    longest_mm
        Longest stitch that the machine sews; only stitches over wire are longer than
        `Stitching.stripe_stitch_mm`.

    Returns
    -------
    list of Vectors
        Needle points (n, 2) in mm of each stripe, locked at both ends; with two passes there and
        back.

    Raises
    ------
    PatternError
        When the needle finds no way over the wire; the message says where.
    """
    sewn: list[Vectors] = []
    for line in _lines(loops, radians(angle_deg)):
        for begin, end in _stretches(line):
            row = _Row(line, laid, clear_mm, longest_mm, stitching)
            sewn.append(row.needles(begin, end))
    return sewn


def _lines(loops: Sequence[Loop], angle_rad: float) -> list[_Line]:
    along = np.array([cos(angle_rad), sin(angle_rad)])
    across = np.array([-sin(angle_rad), cos(angle_rad)])
    centre = np.array([(loop.x_mm, loop.y_mm) for loop in loops])
    radius = np.array([loop.along_mm(angle_rad) for loop in loops])
    place, offset = centre @ along, centre @ across
    order = np.argsort(offset, kind="stable")
    breaks = np.flatnonzero(np.diff(offset[order]) > SAME_LINE_MM) + 1
    lines: list[_Line] = []
    for own in np.split(order, breaks):
        here = own[np.argsort(place[own], kind="stable")]
        held = np.stack([place[here], radius[here]], axis=1)
        lines.append(_Line(along, across, float(offset[here].mean()), held))
    return lines


def _stretches(line: _Line) -> list[tuple[float, float]]:
    """Begin and end of every row of loops that touch."""
    begin, end = line.loops[:, 0] - line.loops[:, 1], line.loops[:, 0] + line.loops[:, 1]
    apart = np.flatnonzero(begin[1:] > end[:-1] + SAME_LINE_MM) + 1
    cuts = [0, *apart.tolist(), len(begin)]
    return [(float(begin[i]), float(end[j - 1])) for i, j in pairwise(cuts)]


@dataclass(frozen=True)
class _Row:
    """One line, the wire it must miss, and the limits of its stitches."""

    line: _Line
    laid: LaidWire
    clear_mm: float
    longest_mm: float
    stitching: Stitching

    def needles(self, begin_mm: float, end_mm: float) -> Vectors:
        """Needle points (n, 2) from outside one outer wire to outside the other."""
        lock = self.stitching.lock_length_mm
        first, last = self._end(begin_mm, -1.0), self._end(end_mm, 1.0)
        free = self._free_stretches(first, last)
        there = np.concatenate([_divided(a, b, self._count(a, b)) for a, b in free])
        if self.stitching.stripe_passes == 1:
            return self.line.at(with_locks(there, lock))
        back = np.concatenate([_divided(b, a, self._count(a, b) + 1) for a, b in free[::-1]])
        round_way = np.concatenate([there, back[1:]])
        locked = with_locks(round_way, lock)
        locked[-2] += 2 * lock  # it ends where it began, and locks to the same side
        return self.line.at(locked)

    def _count(self, begin_mm: float, end_mm: float) -> int:
        return ceil((end_mm - begin_mm) / self.stitching.stripe_stitch_mm)

    def _end(self, edge_mm: float, outward: float) -> float:
        """Where the stripe is locked: beyond the outer wire, or else inside its loop."""
        lock = self.stitching.lock_length_mm
        beyond = np.arange(0.0, FARTHEST_END_MM, GRID_MM)
        out = np.concatenate([self.clear_mm + lock + beyond, -self.clear_mm - beyond])
        at = edge_mm + outward * out
        usable = self._free(at) & self._free(at - outward * lock)
        if not usable.any():
            raise self._no_way(edge_mm)
        return float(at[int(np.argmax(usable))])

    def _free(self, at_mm: Lengths) -> NDArray[np.bool_]:
        distance = self.laid.distance_mm(self.line.at(at_mm), self.clear_mm)
        return distance >= self.clear_mm - ROUND_OFF_MM

    def _free_stretches(self, first_mm: float, last_mm: float) -> list[tuple[float, float]]:
        """Stretches in which the needle may go in, one stitch apart from one another."""
        at = np.linspace(first_mm, last_mm, ceil((last_mm - first_mm) / GRID_MM) + 1)
        free = np.pad(self._free(at), 1)
        begin = at[np.flatnonzero(free[1:-1] & ~free[:-2])]
        end = at[np.flatnonzero(free[1:-1] & ~free[2:])]
        over = (begin[1:] - end[:-1]) * np.abs(self.line.along).max()
        if np.any(over > self.longest_mm):
            raise self._no_way(float(end[int(np.argmax(over))]))
        return list(zip(begin.tolist(), end.tolist(), strict=True))

    def _no_way(self, at_mm: float) -> PatternError:
        x, y = self.line.at(np.array([at_mm]))[0]
        return PatternError(
            f"no way for a stripe over the wire at ({x:.2f}, {y:.2f}) mm with stitches of at most "
            f"{self.longest_mm:g} mm; take another direction in stitching.stripes, or none"
        )


def _divided(begin_mm: float, end_mm: float, count: int) -> Lengths:
    return np.linspace(begin_mm, end_mm, max(count, 1) + 1)
