"""Which pieces of wire pass near a point, and how near."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from patterns.cell_table import CellTable, Indices, counted
from patterns.path import Arc, Piece, Vectors

Numbers = NDArray[np.float64]

_ROUND_OFF_MM = 1e-9

_SMALLEST_REACH_MM = 1.0
"""Smaller reaches are looked up in the cells of this one, so that long wire has few cells."""


class PieceCells:
    """Finds the pieces of wire near many points in time that grows with the number of points.

    Every piece stands for a row of places on it. There is a table of cells for each power of two up
    to which a reach is asked for, made when it is first needed.

    Parameters
    ----------
    pieces : sequence of Line or Arc
    """

    def __init__(self, pieces: Sequence[Piece]) -> None:
        rows = np.array([_row(piece) for piece in pieces]).reshape(len(pieces), 6)
        self._x, self._y, self._a, self._b, self._radius, self._sweep = rows.T.copy()
        self._start = self._places(np.arange(len(pieces)), np.zeros(len(pieces)))
        self._end = self._places(np.arange(len(pieces)), np.ones(len(pieces)))
        self._tables: dict[float, CellTable] = {}

    @property
    def ends_mm(self) -> Vectors:
        """First and last point (n, 2, 2) of every piece."""
        return np.stack([self._start, self._end], axis=1)

    def near(self, points_mm: Vectors, reach_mm: float) -> tuple[Indices, Indices]:
        """Pair points (n, 2) with all pieces within ``reach_mm``, and some that are farther off.

        Returns
        -------
        point, piece : arrays (m,)
            Indices of the pairs, in the order of the points, no pair twice.
        """
        which, piece = self._table(reach_mm).near(points_mm)
        near = self._to_whole_mm(points_mm[which], piece) <= reach_mm + _ROUND_OFF_MM
        return which[near], piece[near]

    def distance_mm(self, points_mm: Vectors, piece: Indices) -> Numbers:
        """Distance (m,) of point i (m, 2) from its piece i (m,)."""
        distance = self._to_whole_mm(points_mm, piece)
        x, y = points_mm[:, 0] - self._x[piece], points_mm[:, 1] - self._y[piece]
        sweep = self._sweep[piece]
        # an arc of no length has a sign, too
        turn = np.mod(np.copysign(1.0, sweep) * (np.arctan2(y, x) - self._a[piece]), 2 * np.pi)
        beyond = turn > np.abs(sweep)
        lines = np.flatnonzero(self._radius[piece] == 0)
        a, b = self._a[piece[lines]], self._b[piece[lines]]
        along = x[lines] * a + y[lines] * b
        beyond[lines] = (along < 0) | (along > a**2 + b**2)
        ends = np.flatnonzero(beyond)
        away = [points_mm[ends] - one[piece[ends]] for one in (self._start, self._end)]
        distance[ends] = np.minimum(*(np.hypot(one[:, 0], one[:, 1]) for one in away))
        return distance

    def _to_whole_mm(self, points_mm: Vectors, piece: Indices) -> Numbers:
        """Distance from the whole circle, or the line without ends, that each piece is part of."""
        x, y = points_mm[:, 0] - self._x[piece], points_mm[:, 1] - self._y[piece]
        radius = self._radius[piece]
        distance = np.abs(np.hypot(x, y) - radius)
        lines = np.flatnonzero(radius == 0)
        a, b = self._a[piece[lines]], self._b[piece[lines]]
        distance[lines] = np.abs(a * y[lines] - b * x[lines]) / np.hypot(a, b)
        return distance

    def _table(self, reach_mm: float) -> CellTable:
        """Cells for a reach: a point within it is within the reach and half a step of a place."""
        reach = float(2 ** np.ceil(np.log2(max(reach_mm, _SMALLEST_REACH_MM))))
        if reach not in self._tables:
            step = 2 * reach
            bent = self._radius * np.abs(self._sweep)
            length = np.where(self._radius > 0, bent, np.hypot(self._a, self._b))
            count = np.ceil(length / step).astype(np.int64) + 1
            piece, rank = counted(count)
            places = self._places(piece, rank / np.maximum(count - 1, 1)[piece])
            self._tables[reach] = CellTable(places, piece, reach + step / 2)
        return self._tables[reach]

    def _places(self, piece: Indices, share: Numbers) -> Vectors:
        """Points (n, 2) at shares of the way along pieces."""
        radius, a, b = self._radius[piece], self._a[piece], self._b[piece]
        angle = a + share * self._sweep[piece]
        x = np.where(radius > 0, radius * np.cos(angle), share * a)
        y = np.where(radius > 0, radius * np.sin(angle), share * b)
        return np.stack([self._x[piece] + x, self._y[piece] + y], axis=1)


def _row(piece: Piece) -> tuple[float, float, float, float, float, float]:
    """Start and extent of a line; centre, first angle, radius and sweep of an arc."""
    if isinstance(piece, Arc):
        centre = piece.centre_x_mm, piece.centre_y_mm
        return *centre, piece.start_rad, 0.0, piece.radius_mm, piece.sweep_rad
    extent = piece.x1_mm - piece.x0_mm, piece.y1_mm - piece.y0_mm
    return piece.x0_mm, piece.y0_mm, *extent, 0.0, 0.0
