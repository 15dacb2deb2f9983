"""Straight pieces of rebuilt wire, looked up many at once."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from patterns.cell_table import CellTable, Indices, counted
from patterns.path import Vectors

APART_MM = 4.0
"""Places nearer to one another along one wire than this are one stretch of it."""

Numbers = NDArray[np.float64]


class SewnPieces:
    """The straight pieces between the points of rows, in stretches of half `APART_MM`.

    Stretches after one another thus hold no two places that are apart; those that come near one
    another are few, however long the wire.

    Parameters
    ----------
    rows : sequence of arrays (n, 2)
        Points along each strand of wire.

    Attributes
    ----------
    start_mm, end_mm : arrays (m, 2)
        Of all pieces, row after row.
    row : array (m,)
        Which row each belongs to.
    begin_mm, size_mm : arrays (m,)
        Length along the row to the start of each piece, and its own.
    """

    def __init__(self, rows: Sequence[Vectors]) -> None:
        rows = rows or [np.empty((1, 2))]
        self.start_mm = np.concatenate([row[:-1] for row in rows])
        self.end_mm = np.concatenate([row[1:] for row in rows])
        self.row = np.repeat(np.arange(len(rows)), [len(row) - 1 for row in rows])
        self.size_mm = np.hypot(*(self.end_mm - self.start_mm).T)
        first = np.flatnonzero(np.diff(self.row, prepend=-1))
        before = np.cumsum(self.size_mm) - self.size_mm
        self.begin_mm = before - np.repeat(before[first], np.diff(np.append(first, len(self.row))))
        self._number = np.floor(self.middle_mm / (APART_MM / 2)).astype(np.int64)
        new = (np.diff(self.row, prepend=-1) != 0) | (np.diff(self._number, prepend=-1) != 0)
        self._first = np.flatnonzero(new)
        self._count = np.diff(np.append(self._first, len(new)))
        low, high = np.minimum(self.start_mm, self.end_mm), np.maximum(self.start_mm, self.end_mm)
        if len(self._first):
            low = np.minimum.reduceat(low, self._first)
            high = np.maximum.reduceat(high, self._first)
        self._centre_mm, self._half_mm = (low + high) / 2, np.hypot(*(high - low).T) / 2

    @property
    def middle_mm(self) -> Numbers:
        """Length along the row to the middle of each piece."""
        return self.begin_mm + self.size_mm / 2

    def near_one_another(self, reach_mm: float) -> tuple[Indices, Indices]:
        """Pair pieces of stretches that come within a reach, but for stretches that follow.

        Returns
        -------
        later, earlier : arrays (n,)
            Indices of the pairs; of each two pieces once, the later first, and a piece of a stretch
            that comes near itself never.
        """
        later, earlier = self._stretches_near(self._centre_mm, self._half_mm + reach_mm)
        row, number = self.row[self._first], self._number[self._first]
        follow = (row[later] == row[earlier]) & (number[later] <= number[earlier] + 1)
        kept = (later > earlier) & ~follow
        return self._expanded(later[kept], earlier[kept])

    def crossed(self, start_mm: Vectors, end_mm: Vectors) -> tuple[Indices, Indices, Numbers]:
        """Find which straight stitches meet which pieces.

        Returns
        -------
        stitch, piece : arrays (n,)
            Indices of the pairs.
        share : array (n,)
            How far along the piece, from 0 to 1.
        """
        half = np.hypot(*(end_mm - start_mm).T) / 2
        stitch, piece = self._near((start_mm + end_mm) / 2, half)
        a, c = self.start_mm[piece], start_mm[stitch]
        own, other = self.end_mm[piece] - a, end_mm[stitch] - c
        turn = _cross(own, other)
        with np.errstate(divide="ignore", invalid="ignore"):
            share, along = _cross(c - a, other) / turn, _cross(c - a, own) / turn
        met = (share >= 0) & (share <= 1) & (along >= 0) & (along <= 1)
        return stitch[met], piece[met], share[met]

    def distance_mm(self, points_mm: Vectors, reach_mm: float) -> Numbers:
        """Distance (n,) of points (n, 2) to the nearest piece; infinite beyond the reach."""
        point, piece = self._near(points_mm, np.full(len(points_mm), reach_mm))
        result = np.full(len(points_mm), np.inf)
        np.minimum.at(result, point, self.to_pieces_mm(points_mm[point], piece))
        result[result > reach_mm] = np.inf
        return result

    def to_pieces_mm(self, points_mm: Vectors, piece: Indices) -> Numbers:
        """Distance of point i from its piece i."""
        away = points_mm - self.start_mm[piece]
        along = self.end_mm[piece] - self.start_mm[piece]
        square = np.maximum(self.size_mm[piece] ** 2, np.finfo(float).tiny)
        share = np.clip((away * along).sum(axis=1) / square, 0.0, 1.0)
        return np.hypot(*(away - share[:, None] * along).T)

    def _near(self, points_mm: Vectors, reach_mm: Numbers) -> tuple[Indices, Indices]:
        """Pair points with the pieces of all stretches that may come within a reach of each."""
        point, stretch = self._stretches_near(points_mm, reach_mm)
        pair, rank = counted(self._count[stretch])
        return point[pair], self._first[stretch][pair] + rank

    def _stretches_near(self, points_mm: Vectors, reach_mm: Numbers) -> tuple[Indices, Indices]:
        """Pair points with stretches around whose middle a circle comes within a reach of each."""
        farthest = max(float(reach_mm.max(initial=0.0)), APART_MM / 2)
        around = farthest + float(self._half_mm.max(initial=0.0))
        table = CellTable(self._centre_mm, np.arange(len(self._centre_mm)), around)
        point, stretch = table.near(points_mm)
        away = points_mm[point] - self._centre_mm[stretch]
        near = np.hypot(away[:, 0], away[:, 1]) <= reach_mm[point] + self._half_mm[stretch]
        return point[near], stretch[near]

    def _expanded(self, later: Indices, earlier: Indices) -> tuple[Indices, Indices]:
        """Every piece of one stretch with every piece of the other, pair by pair of stretches."""
        width = self._count[earlier]
        count = self._count[later] * width
        pair, rank = counted(count)
        a, b = np.divmod(rank, width[pair])
        return self._first[later][pair] + a, self._first[earlier][pair] + b


def _cross(a: Vectors, b: Vectors) -> Numbers:
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
