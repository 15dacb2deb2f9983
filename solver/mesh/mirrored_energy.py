"""Energy of shapes with two upright mirror planes, of a quarter of the unknowns.

A grid of equal loops is its own image in the planes through its middle, and so is the shape in
which it buckles with crests along its rows. By symmetry nothing pulls a shape out of the planes;
whether a minimum among such shapes is one among all, the full Hessian must tell.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from solver.mesh.assembly import LowerPattern, weighted_sums
from solver.mesh.elements import Curvature
from solver.mesh.mesh_energy import Energy
from solver.mesh.mirror import Mirrors

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True)
class _Folding:
    """Where the entries (nnz,) of the whole Hessian go: to slots of a pattern, with factors."""

    pattern: LowerPattern
    slots: Indices
    factors: Vectors

    def entries(self, whole: Vectors) -> Vectors:
        return weighted_sums(self.slots, self.factors * whole, len(self.pattern.rows))


def _folding(whole: LowerPattern, mirrors: Mirrors) -> _Folding:
    unknown = (3 * mirrors.of[:, None] + np.arange(3)).ravel()
    sign = mirrors.signs.ravel()
    size = 3 * len(mirrors.chosen)
    row, column = unknown[whole.rows], unknown[whole.columns]
    # an entry off the diagonal stands for two, which may meet on the diagonal
    twice = (row == column) & (whole.rows != whole.columns)
    factors = sign[whole.rows] * sign[whole.columns] * np.where(twice, 2.0, 1.0)
    key = np.minimum(row, column) * size + np.maximum(row, column)
    keys = np.unique(key)
    starts = np.searchsorted(keys, np.arange(size + 1) * size)
    return _Folding(LowerPattern(size, starts, keys % size), np.searchsorted(keys, key), factors)


@dataclass(frozen=True)
class MirroredEnergy:
    """Energy of a whole mesh by the positions (r, 3) of the vertices that stand for all.

    Components across a plane, of vertices on it, have no gradient and a Hessian of 1.
    """

    whole: Energy
    mirrors: Mirrors

    @cached_property
    def _folding(self) -> _Folding:
        return _folding(self.whole.pattern, self.mirrors)

    @cached_property
    def _pinned(self) -> Indices:
        """Slots of the Hessian's diagonal that nothing fills."""
        across = self.mirrors.signs[self.mirrors.chosen].ravel() == 0
        return self.pattern.diagonal[across]

    @property
    def pattern(self) -> LowerPattern:
        """Of the Hessian."""
        return self._folding.pattern

    def terms(self, positions: Vectors) -> dict[str, float]:
        """Energy by term."""
        return self.whole.terms(self.mirrors.all(positions))

    def value(self, positions: Vectors) -> float:
        """Energy at positions (r, 3)."""
        return self.whole.value(self.mirrors.all(positions))

    def derivatives(
        self, positions: Vectors, curvature: Curvature = Curvature.TRUE
    ) -> tuple[float, Vectors, Vectors]:
        """Energy, gradient (r, 3) and the entries (nnz,) of the Hessian's lower triangle."""
        value, gradient, whole = self.whole.derivatives(self.mirrors.all(positions), curvature)
        entries = self._folding.entries(whole)
        entries[self._pinned] = 1.0
        return value, self.mirrors.pulls(gradient), entries

    def excess(self, positions: Vectors, move: Vectors, reached: Vectors) -> Vectors:
        """Pull (3r,) of the stretch that a move (r, 3) brings beyond what is linear in it."""
        spread = self.mirrors.all
        whole = self.whole.excess(spread(positions), self.mirrors.moves(move), spread(reached))
        return self.mirrors.pulls(whole.reshape(-1, 3)).ravel()
