"""A mesh's pattern, widened where parts touch that share no element."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array

from solver.mesh.assembly import LowerPattern, weighted_sums

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]


def _keys(pattern: LowerPattern) -> Indices:
    """Column · size + row of each entry, ascending."""
    return pattern.columns * pattern.size + pattern.rows


def _lower(matrix: coo_array) -> tuple[Indices, Vectors]:
    """Keys and values of the entries on and below the diagonal of a symmetric matrix."""
    row, column = (np.asarray(c, dtype=np.int64) for c in matrix.coords)
    below = row >= column
    keys = column[below] * matrix.shape[0] + row[below]
    return keys, np.asarray(matrix.data, dtype=np.float64)[below]


@dataclass(frozen=True)
class WidenedPattern:
    """A pattern that holds another, the base, and some entries more.

    Attributes
    ----------
    base, whole : LowerPattern
    """

    base: LowerPattern
    whole: LowerPattern

    @cached_property
    def _keys(self) -> Indices:
        return _keys(self.whole)

    @cached_property
    def _base_slots(self) -> Indices:
        return np.searchsorted(self._keys, _keys(self.base))

    def holding(self, matrices: list[coo_array]) -> WidenedPattern:
        """Give this pattern if it has a place for all entries; else the base widened for them."""
        keys = np.unique(np.concatenate([_lower(matrix)[0] for matrix in matrices]))
        if len(np.setdiff1d(keys, self._keys, assume_unique=True)) == 0:
            return self
        size = self.base.size
        every = np.union1d(_keys(self.base), keys)
        starts = np.searchsorted(every, np.arange(size + 1) * size)
        return WidenedPattern(self.base, LowerPattern(size, starts, every % size))

    def entries(self, base: Vectors, matrices: list[coo_array]) -> Vectors:
        """Entries (nnz,) of the sum of a matrix of the base's pattern and symmetric matrices."""
        out = np.zeros(len(self.whole.rows))
        out[self._base_slots] = base
        for matrix in matrices:
            keys, values = _lower(matrix)
            out += weighted_sums(np.searchsorted(self._keys, keys), values, len(out))
        return out
