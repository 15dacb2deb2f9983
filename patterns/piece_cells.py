"""Which pieces of wire pass near a point, looked up in square cells of the plane."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from patterns.path import Arc, Piece, Vectors

Indices = NDArray[np.int64]
Numbers = NDArray[np.float64]

_ROUND_OFF_MM = 1e-9

_SMALLEST_REACH_MM = 1.0
"""Smaller reaches are looked up in the cells of this one, so that long wire has few cells."""

_COLUMN = 2**31
"""Cells are numbered by column and row; there are fewer rows than this."""


@dataclass(frozen=True)
class _Cells:
    """Pieces by cell, for one reach; the numbers of the cells rise."""

    size_mm: float
    number: Indices
    piece: Indices


class PieceCells:
    """Finds the pieces of wire near many points in time that grows with the number of points.

    Every piece stands for a row of places on it, and each cell of a square grid knows the pieces
    with a place near it. There is a grid for each power of two up to which a reach is asked for,
    made when it is first needed.

    Parameters
    ----------
    pieces : sequence of Line or Arc
    """

    def __init__(self, pieces: Sequence[Piece]) -> None:
        self._rows = np.array([_row(piece) for piece in pieces]).reshape(len(pieces), 6)
        self._ends = np.array([piece.at(np.array([0.0, piece.length_mm]))[0] for piece in pieces])
        self._cells: dict[float, _Cells] = {}

    def near(self, points_mm: Vectors, reach_mm: float) -> tuple[Indices, Indices]:
        """Pair points (n, 2) with all pieces within ``reach_mm``, and some that are farther off.

        Returns
        -------
        point, piece : arrays (m,)
            Indices of the pairs, no pair twice.
        """
        cells = self._within(reach_mm)
        number = _numbers(np.floor(points_mm / cells.size_mm))
        first = np.searchsorted(cells.number, number, side="left")
        count = np.searchsorted(cells.number, number, side="right") - first
        which = np.repeat(np.arange(len(points_mm)), count)
        rank = np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)
        piece = cells.piece[np.repeat(first, count) + rank]
        near = self._to_whole_mm(points_mm[which], piece) <= reach_mm + _ROUND_OFF_MM
        return which[near], piece[near]

    def distance_mm(self, points_mm: Vectors, piece: Indices) -> Numbers:
        """Distance (m,) of point i (m, 2) from its piece i (m,)."""
        from_start = np.hypot(*(points_mm - self._ends[piece, 0]).T)
        from_end = np.hypot(*(points_mm - self._ends[piece, 1]).T)
        x, y, across, along, radius, sweep = self._rows[piece].T
        off_x, off_y = points_mm[:, 0] - x, points_mm[:, 1] - y
        turn = np.mod(np.sign(sweep) * (np.arctan2(off_y, off_x) - across), 2 * np.pi)
        share = off_x * across + off_y * along
        beside = np.where(
            radius > 0, turn <= np.abs(sweep), (share >= 0) & (share <= across**2 + along**2)
        )
        whole = self._to_whole_mm(points_mm, piece)
        return np.where(beside, whole, np.minimum(from_start, from_end))

    def _to_whole_mm(self, points_mm: Vectors, piece: Indices) -> Numbers:
        """Distance from the whole circle, or the line without ends, that each piece is part of."""
        x, y, across, along, radius, _ = self._rows[piece].T
        off_x, off_y = points_mm[:, 0] - x, points_mm[:, 1] - y
        to_circle = np.hypot(off_x, off_y) - radius
        length = np.where(radius > 0, 1.0, np.hypot(across, along))
        to_line = (across * off_y - along * off_x) / length
        return np.abs(np.where(radius > 0, to_circle, to_line))

    def _within(self, reach_mm: float) -> _Cells:
        reach = float(2 ** np.ceil(np.log2(max(reach_mm, _SMALLEST_REACH_MM))))
        if reach not in self._cells:
            self._cells[reach] = self._made(reach)
        return self._cells[reach]

    def _made(self, reach_mm: float) -> _Cells:
        """Enter each piece in the cells in which a point within the reach of it can lie.

        Such a point is within the reach and half a step of one of the places. Around each of these
        lies a square of half that size, no larger than a cell: the cells of its corners are all.
        """
        step = 2 * reach_mm
        place, piece = self._places(step)
        around = reach_mm + step / 2
        size = 2 * around
        corners = [(x, y) for x in (-around, around) for y in (-around, around)]
        number = np.concatenate([_numbers(np.floor((place + one) / size)) for one in corners])
        entries = np.stack([number, np.tile(piece, len(corners))], axis=1)
        order = np.lexsort((entries[:, 1], entries[:, 0]))
        entries = entries[order]
        new = np.ones(len(entries), dtype=np.bool_)
        new[1:] = np.any(entries[1:] != entries[:-1], axis=1)
        return _Cells(size, entries[new, 0].copy(), entries[new, 1].copy())

    def _places(self, step_mm: float) -> tuple[Vectors, Indices]:
        """Places (n, 2) on the pieces at most a step apart, ends included; and their pieces."""
        x, y, across, along, radius, sweep = self._rows.T
        length = np.where(radius > 0, radius * np.abs(sweep), np.hypot(across, along))
        count = np.ceil(length / step_mm).astype(np.int64) + 1
        piece = np.repeat(np.arange(len(count)), count)
        rank = np.arange(len(piece)) - np.repeat(np.cumsum(count) - count, count)
        share = rank / np.maximum(count - 1, 1)[piece]
        start = np.where(radius > 0, across, 0.0)[piece]
        angle = start + share * sweep[piece]
        bent = radius[piece] > 0
        dx = np.where(bent, radius[piece] * np.cos(angle), share * across[piece])
        dy = np.where(bent, radius[piece] * np.sin(angle), share * along[piece])
        return np.stack([x[piece] + dx, y[piece] + dy], axis=1), piece


def _numbers(cell: Vectors) -> Indices:
    """Number (n,) the cells (n, 2), given by column and row."""
    whole = cell.astype(np.int64)
    return whole[:, 0] * _COLUMN + whole[:, 1]


def _row(piece: Piece) -> tuple[float, float, float, float, float, float]:
    """Start and extent of a line; centre, first angle, radius and sweep of an arc."""
    if isinstance(piece, Arc):
        centre = piece.centre_x_mm, piece.centre_y_mm
        return *centre, piece.start_rad, 0.0, piece.radius_mm, piece.sweep_rad
    extent = piece.x1_mm - piece.x0_mm, piece.y1_mm - piece.y0_mm
    return piece.x0_mm, piece.y0_mm, *extent, 0.0, 0.0
