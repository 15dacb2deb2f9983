"""From elements to the gradient and the sparse Hessian of a whole mesh.

The Hessian's lower triangle is kept in compressed columns. Where each entry of each element goes
is found once; a Hessian is then one sum by slot.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]


def weighted_sums(places: Indices, weights: Vectors, size: int) -> Vectors:
    """Sum (size,) of the weights that go to each place."""
    return np.bincount(places, weights, minlength=size).astype(np.float64, copy=False)


@dataclass(frozen=True)
class LowerPattern:
    """Places of a symmetric matrix' lower triangle, by compressed columns.

    Attributes
    ----------
    size : int
        Rows.
    starts : array (size + 1,)
        Where each column begins; its first entry is the diagonal.
    rows : array (nnz,)
        Row of each entry, ascending in each column.
    """

    size: int
    starts: Indices
    rows: Indices

    @property
    def diagonal(self) -> Indices:
        """Slots (size,) of the diagonal."""
        return self.starts[:-1]

    @cached_property
    def columns(self) -> Indices:
        """Column (nnz,) of each entry."""
        return np.repeat(np.arange(self.size), np.diff(self.starts))


@dataclass(frozen=True)
class BlockPattern:
    """Pattern of 3 × 3 blocks, one for each pair of vertices that share an element.

    Attributes
    ----------
    vertices : int
    keys : array (b,)
        column · vertices + row of each block with row > column, ascending.
    first : array (vertices + 1,)
        First of ``keys`` in each column.
    """

    vertices: int
    keys: Indices
    first: Indices

    @cached_property
    def _column_starts(self) -> Indices:
        """Where each vertex' three columns begin: they hold 6 entries, and 9 for each block."""
        return 6 * np.arange(self.vertices + 1) + 9 * self.first

    def slots(self, row: Indices, column: Indices, i: Indices, j: Indices) -> Indices:
        """Slots of entries (i, j) of the blocks at (row, column); row ≥ column, i ≥ j if equal."""
        below = self.first[column + 1] - self.first[column]
        on_diagonal = row == column
        key = column * self.vertices + row
        rank = np.searchsorted(self.keys, key) - self.first[column]
        # before column j of a vertex come columns of 3 + 3·below, 2 + 3·below entries
        column_start = self._column_starts[column] + j * (3 + 3 * below) - j * (j - 1) // 2
        return column_start + np.where(on_diagonal, i - j, 3 - j + 3 * rank + i)

    def lower(self) -> LowerPattern:
        """Spell out the pattern entry by entry."""
        n = self.vertices
        column, row = self.keys // n, self.keys % n
        below = np.diff(self.first)
        lengths = (3 + 3 * below)[:, None] - np.arange(3)
        starts = np.concatenate([[0], np.cumsum(lengths.ravel())])
        rows = np.empty(starts[-1], dtype=np.int64)
        every = np.arange(n)
        for j in range(3):
            for i in range(3):
                rows[self.slots(row, column, np.full_like(row, i), np.full_like(row, j))] = (
                    3 * row + i
                )
                if i >= j:
                    rows[self.slots(every, every, np.full(n, i), np.full(n, j))] = 3 * every + i
        return LowerPattern(3 * n, starts, rows)


def block_pattern(families: list[Indices], vertices: int) -> BlockPattern:
    """Pattern of elements given by their vertices (m, a), family by family."""
    keys: list[Indices] = [np.empty(0, dtype=np.int64)]
    for family in families:
        one, other = np.tril_indices(family.shape[1], -1)
        pair = np.stack([family[:, one].ravel(), family[:, other].ravel()])
        keys.append(pair.min(axis=0) * vertices + pair.max(axis=0))
    unique = np.unique(np.concatenate(keys))
    first = np.searchsorted(unique, np.arange(vertices + 1) * vertices)
    return BlockPattern(vertices, unique, first)


@dataclass(frozen=True)
class FamilyAssembly:
    """Where the gradients and Hessians of one family of elements go.

    Attributes
    ----------
    unknowns : array (m, 3a)
    slots : array (m · 3a(3a + 1)/2,)
        Of the lower triangle of each element's Hessian, row by row.
    lower : array (3a(3a + 1)/2,)
        Places of that triangle in the flattened Hessian.
    """

    unknowns: Indices
    slots: Indices
    lower: Indices

    def gradient(self, gradients: Vectors, size: int) -> Vectors:
        """Sum (size,) of the elements' gradients (m, 3a)."""
        return weighted_sums(self.unknowns.ravel(), gradients.ravel(), size)

    def hessian(self, hessians: Vectors, entries: int) -> Vectors:
        """Sum (entries,) of the elements' Hessians (m, 3a, 3a)."""
        flat = hessians.reshape(len(hessians), -1)
        return weighted_sums(self.slots, flat[:, self.lower].ravel(), entries)


def family_assembly(family: Indices, blocks: BlockPattern) -> FamilyAssembly:
    """Find the slots of a family of elements with vertices (m, a)."""
    size = 3 * family.shape[1]
    i, j = np.tril_indices(size)
    row, column = family[:, i // 3], family[:, j // 3]
    i_component = np.broadcast_to(i % 3, row.shape)
    j_component = np.broadcast_to(j % 3, row.shape)
    swapped = row < column
    slots = blocks.slots(
        np.where(swapped, column, row),
        np.where(swapped, row, column),
        np.where(swapped, j_component, i_component),
        np.where(swapped, i_component, j_component),
    )
    unknowns = (3 * family[:, :, None] + np.arange(3)).reshape(len(family), size)
    return FamilyAssembly(unknowns, slots.ravel(), i * size + j)
