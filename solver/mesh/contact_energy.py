"""Energy of a mesh whose parts must not pass through each other."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from solver.mesh.assembly import LowerPattern
from solver.mesh.barrier import Barrier, Collisions
from solver.mesh.elements import Curvature
from solver.mesh.factorization import Factored, Factoriser, factoriser
from solver.mesh.mesh_energy import MeshEnergy
from solver.mesh.widened import WidenedPattern

Vectors = NDArray[np.float64]

CONTACT_TERM = "contact"


class ContactEnergy:
    """Sum of a mesh's energy and of barriers.

    What touches changes on the way, and the Hessian's pattern with it: `pattern` is that of the
    last derivatives. From their positions on no shape is offered that cannot be reached in a
    straight line without passing through itself: the energy of such a one is infinite.
    """

    def __init__(self, free: MeshEnergy, barriers: tuple[Barrier, ...]) -> None:
        self.free = free
        self.barriers = barriers
        self._widened = WidenedPattern(free.pattern, free.pattern)
        self._reached: Vectors | None = None

    @property
    def pattern(self) -> LowerPattern:
        """Of the Hessian where the last derivatives were taken."""
        return self._widened.whole

    def _found(self, positions: Vectors) -> list[Collisions]:
        return [barrier.collisions(positions) for barrier in self.barriers]

    def _barrier_energy(self, positions: Vectors) -> float:
        found = zip(self.barriers, self._found(positions), strict=True)
        return sum(barrier.energy(pairs) for barrier, pairs in found)

    def terms(self, positions: Vectors) -> dict[str, float]:
        """Energy by term at positions (n, 3)."""
        return {**self.free.terms(positions), CONTACT_TERM: self._barrier_energy(positions)}

    def value(self, positions: Vectors) -> float:
        """Energy at positions (n, 3), infinite where the way there is barred."""
        if self._reached is not None and self.free_way(self._reached, positions) < 1:
            return math.inf
        return self.free.value(positions) + self._barrier_energy(positions)

    def free_way(self, start: Vectors, end: Vectors) -> float:
        """Part of the straight way between two shapes (n, 3) on which nothing crosses."""
        return min(barrier.largest_step(start, end) for barrier in self.barriers if barrier.swept)

    def derivatives(
        self, positions: Vectors, curvature: Curvature = Curvature.TRUE
    ) -> tuple[float, Vectors, Vectors]:
        """Energy, gradient (n, 3) and the entries (nnz,) of the Hessian's lower triangle."""
        value, gradient, entries = self.free.derivatives(positions, curvature)
        pairs = list(zip(self.barriers, self._found(positions), strict=True))
        hessians = [barrier.hessian(found, curvature) for barrier, found in pairs]
        slope = sum((b.gradient(found) for b, found in pairs), np.zeros(positions.size))
        self._reached = positions
        self._widened = self._widened.holding(hessians)
        return (
            value + sum(barrier.energy(found) for barrier, found in pairs),
            gradient + slope.reshape(-1, 3),
            self._widened.entries(entries, hessians),
        )

    def excess(self, positions: Vectors, move: Vectors, reached: Vectors) -> Vectors:
        """Pull (3n,) of the excessive stretch that a bent move takes back; barriers have none."""
        return self.free.excess(positions, move, reached)

    def forces(self, positions: Vectors) -> Vectors:
        """Contact forces (n, 3) on the vertices, in units of E_f t R."""
        found = zip(self.barriers, self._found(positions), strict=True)
        total = sum((b.gradient(pairs) for b, pairs in found), np.zeros(positions.size))
        return -total.reshape(-1, 3)

    def touching(self, positions: Vectors) -> int:
        """Number of pairs that feel each other."""
        return sum(len(found.pairs) for found in self._found(positions))


class ContactFactoriser:
    """Factorises the matrices of a contact energy, anew analysed when its pattern has changed."""

    def __init__(self, energy: ContactEnergy, backend: str | None = None) -> None:
        self._energy = energy
        self._backend = backend
        self._pattern = energy.pattern
        self._factoriser: Factoriser = factoriser(self._pattern, backend)

    def factorise(self, entries: Vectors) -> Factored:
        """Factorise the matrix whose lower triangle has these entries of the energy's pattern."""
        if self._energy.pattern is not self._pattern:
            self._pattern = self._energy.pattern
            self._factoriser = factoriser(self._pattern, self._backend)
        return self._factoriser.factorise(entries)
