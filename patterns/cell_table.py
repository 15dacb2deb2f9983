"""Things near many points of the plane, looked up in the cells of a square grid."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from patterns.path import Vectors

Indices = NDArray[np.int64]

_COLUMN = 2**31
"""Cells are numbered by column and row; there are fewer rows than this."""


class CellTable:
    """Every thing stands in the cells that come within a distance of one of its places.

    Time and memory grow with the number of places and of points, not with their product.

    Parameters
    ----------
    places_mm : array (n, 2)
    thing : array (n,)
        Which thing each place belongs to.
    around_mm : float
        Points no farther than this from a place, along each axis, find its thing.
    """

    def __init__(self, places_mm: Vectors, thing: Indices, around_mm: float) -> None:
        self._size_mm = 2 * around_mm
        # A square no larger than a cell lies in the cells of its corners.
        corners = [(x, y) for x in (-around_mm, around_mm) for y in (-around_mm, around_mm)]
        number = np.stack([self._numbers(places_mm + one) for one in corners], axis=1)
        kept = np.ones(number.shape, dtype=np.bool_)
        for k in range(1, len(corners)):
            kept[:, k] = np.all(number[:, :k] != number[:, k : k + 1], axis=1)
        number, entry = number[kept], np.repeat(thing, kept.sum(axis=1))
        order = np.lexsort((entry, number))
        number, entry = number[order], entry[order]
        new = (np.diff(number, prepend=-1) != 0) | (np.diff(entry, prepend=-1) != 0)
        self._number, self._thing = number[new], entry[new]

    def near(self, points_mm: Vectors) -> tuple[Indices, Indices]:
        """Pair points (n, 2) with all things around them, and some that are farther off.

        Returns
        -------
        point, thing : arrays (m,)
            Indices of the pairs, in the order of the points, no pair twice.
        """
        number = self._numbers(points_mm)
        first = np.searchsorted(self._number, number, side="left")
        count = np.searchsorted(self._number, number, side="right") - first
        which, rank = counted(count)
        return which, self._thing[first[which] + rank]

    def _numbers(self, points_mm: Vectors) -> Indices:
        """Number (n,) the cells in which points lie, by column and row."""
        whole = np.floor(points_mm / self._size_mm).astype(np.int64)
        return whole[:, 0] * _COLUMN + whole[:, 1]


def counted(count: Indices) -> tuple[Indices, Indices]:
    """List each index as often as it counts, and how often it was listed before."""
    which = np.repeat(np.arange(len(count)), count)
    return which, np.arange(len(which)) - (np.cumsum(count) - count)[which]
