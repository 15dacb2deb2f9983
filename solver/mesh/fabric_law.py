"""From strain to energy and stress in the fabric: what a law offers, and the plain one."""

from __future__ import annotations

from dataclasses import dataclass
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

    def root(self, strain: Vectors) -> Vectors:
        """Matrices R, (m, r, 3) or (r, 3), with Rᵀ R the derivative of the stress."""
        ...

    def steady_root(self, strain: Vectors) -> Vectors:
        """Like `root`, with some of the stiffness that comes back when the fabric is pulled."""
        ...

    def smallest_stress(self, strain: Vectors) -> Vectors:
        """Smaller principal stress (m,), units of E_f."""
        ...

    def compressed(self, strain: Vectors) -> Flags:
        """Whether the fabric is shorter than it would be by itself in some direction, (m,)."""
        ...


@dataclass(frozen=True)
class StVenantKirchhoff:
    """w = ½ eᵀ C e, also where the fabric is compressed: as if it could not wrinkle.

    Attributes
    ----------
    stiffness : array (3, 3)
        C, in units of E_f.
    """

    stiffness: Vectors

    def density(self, strain: Vectors) -> Vectors:
        """Energy (m,) over unstretched area."""
        return np.sum(strain * self.stress(strain), axis=1) / 2

    def stress(self, strain: Vectors) -> Vectors:
        """Second Piola–Kirchhoff stress (m, 3)."""
        return strain @ self.stiffness

    def root(self, strain: Vectors) -> Vectors:
        """Give one matrix (3, 3) for all points."""
        return np.linalg.cholesky(self.stiffness).T.astype(np.float64, copy=False)

    def steady_root(self, strain: Vectors) -> Vectors:
        """Give the same: this fabric keeps its stiffness."""
        return self.root(strain)

    def smallest_stress(self, strain: Vectors) -> Vectors:
        """Smaller principal stress (m,)."""
        return principal(self.stress(strain))[0]

    def compressed(self, strain: Vectors) -> Flags:
        """Whether a principal stress is negative (m,)."""
        return self.smallest_stress(strain) < 0
