"""From strain to energy and stress in the fabric: what a law offers, and the plain one."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from solver.mesh.plane_tensor import principal

Vectors = NDArray[np.float64]
Flags = NDArray[np.bool_]


class FabricLaw(Protocol):
    """Energy density of m points by the Green–Lagrange strain e = (E₁₁, E₂₂, 2E₁₂), (m, 3)."""

    def density(self, strain: Vectors) -> Vectors:
        """Energy (m,) over unstretched area, units of E_f."""
        ...

    def stress(self, strain: Vectors) -> Vectors:
        """Second Piola–Kirchhoff stress (S₁₁, S₂₂, S₁₂), (m, 3), units of E_f."""
        ...

    def derivatives(self, strain: Vectors, *, steady: bool) -> tuple[Vectors, Vectors, Vectors]:
        """Density, stress, and matrices R, (m, r, 3) or (r, 3), with Rᵀ R the stress's derivative.

        Steady ones have some of the stiffness that comes back when the fabric is pulled.
        """
        ...

    def smallest_stress(self, strain: Vectors) -> Vectors:
        """Smaller principal stress (m,), units of E_f."""
        ...

    def compressed(self, strain: Vectors) -> Flags:
        """Whether the fabric is shorter than it would be by itself in some direction, (m,)."""
        ...


def stored_energy(stress: Vectors, strain: Vectors) -> Vectors:
    """½ S·E (m,): the energy density of a law that grows as the square of the strain."""
    return np.sum(strain * stress, axis=1) / 2


@dataclass(frozen=True)
class StVenantKirchhoff:
    """w = ½ eᵀ C e, also where the fabric is compressed: as if it could not wrinkle.

    Attributes
    ----------
    stiffness : array (3, 3)
        C, in units of E_f.
    """

    stiffness: Vectors

    @cached_property
    def root(self) -> Vectors:
        """R (3, 3) with Rᵀ R = C."""
        return np.linalg.cholesky(self.stiffness).T.astype(np.float64, copy=False)

    def density(self, strain: Vectors) -> Vectors:
        """Energy (m,) over unstretched area."""
        return stored_energy(self.stress(strain), strain)

    def stress(self, strain: Vectors) -> Vectors:
        """Second Piola–Kirchhoff stress (m, 3)."""
        return strain @ self.stiffness

    def derivatives(self, strain: Vectors, *, steady: bool) -> tuple[Vectors, Vectors, Vectors]:
        """Density, stress and one root for all points: this fabric keeps its stiffness."""
        stress = self.stress(strain)
        return stored_energy(stress, strain), stress, self.root

    def smallest_stress(self, strain: Vectors) -> Vectors:
        """Smaller principal stress (m,)."""
        return principal(self.stress(strain))[0]

    def compressed(self, strain: Vectors) -> Flags:
        """Whether a principal stress is negative (m,)."""
        return self.smallest_stress(strain) < 0
