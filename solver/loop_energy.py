"""Energy of one loop in a space of smooth shapes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.disc_basis import DiscBasis
from solver.membrane import Membrane
from solver.reading import density_coefficients
from solver.rod import Rod
from solver.scene import LoopScene

Vectors = NDArray[np.float64]


@dataclass(frozen=True)
class LoopEnergy:
    """Fabric and wire of a scene, on shapes spanned by a basis."""

    membrane: Membrane
    rod: Rod
    basis: DiscBasis

    def terms(self, q: Vectors) -> dict[str, float]:
        """Energy by term, units of E_f t R², at unknowns ``q`` (n,)."""
        basis = self.basis
        bending, stretch = self.rod.energies(basis.tangent @ q, basis.second @ q, basis.arc)
        return {
            "fabric stretch": self.membrane.energy(basis.gradient @ q, basis.area),
            "wire bending": bending,
            "wire stretch": stretch,
        }

    def value(self, q: Vectors) -> float:
        """Energy at unknowns ``q`` (n,)."""
        return sum(self.terms(q).values())

    def derivatives(self, q: Vectors) -> tuple[float, Vectors, Vectors]:
        """Energy, gradient (n,) and Hessian (n, n) at unknowns ``q`` (n,)."""
        return self.derivatives_around(self.basis.gradient @ q, *self._edge(q))

    def _edge(self, q: Vectors) -> tuple[Vectors, Vectors]:
        return self.basis.tangent @ q, self.basis.second @ q

    def derivatives_around(
        self, gradient: Vectors, tangent: Vectors, second: Vectors
    ) -> tuple[float, Vectors, Vectors]:
        """Derivatives by the basis' unknowns around any shape, given at the basis' own points.

        Parameters
        ----------
        gradient : array (P, 3, 2)
            Derivatives of the position at the points of the disc.
        tangent, second : array (Q, 3)
            First and second derivative of the position at the points of the edge.
        """
        basis = self.basis
        fabric = self.membrane.derivatives(gradient, basis.area, basis.gradient)
        wire = self.rod.derivatives(tangent, second, basis.arc, basis.tangent, basis.second)
        return fabric[0] + wire[0], fabric[1] + wire[1], fabric[2] + wire[2]


def loop_energy(scene: LoopScene, basis: DiscBasis) -> LoopEnergy:
    """Energy of a scene on the shapes of a basis."""
    a, b = density_coefficients(scene.poisson, scene.reading)
    return LoopEnergy(Membrane(scene.strain, a, b), Rod(scene.beta, scene.axial_stiffness), basis)
