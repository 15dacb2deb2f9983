"""Fabric that wrinkles at no cost instead of bearing compression: a tension field.

The density is relaxed to the least that wrinkles of any fineness give,
w*(E) = min w(E + P) over P positive semidefinite (Pipkin, IMA J. Appl. Math. 36 (1986) 85;
Steigmann, Proc. R. Soc. Lond. A 429 (1990) 141). It is convex in E and never falls when E grows,
and E is convex in the shape: so w* is convex in the positions, and no mesh wrinkles at its own
scale. It is also the largest of S·E − ½ S·C⁻¹S over stresses S that are tensile in all directions
(docs/theory.md, eq. 9a):

* taut, where CE is tensile: S = CE, w* = w;
* slack, where E stretches the fabric in no direction: S = 0, w* = 0;
* wrinkled elsewhere: S is uniaxial, see `solver.mesh.wrinkles`. Across the wrinkles the fabric
  narrows until it bears nothing. With principal strains E₁ ≥ E₂ of isotropic fabric
  w* = ½ Q E₁², Q being the modulus of fabric that is free to narrow.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from solver.mesh.fabric_law import StVenantKirchhoff, stored_energy
from solver.mesh.plane_tensor import principal
from solver.mesh.stress_cone import StressCone, stress_cone
from solver.mesh.wrinkles import Wrinkles, wrinkles

Vectors = NDArray[np.float64]
Flags = NDArray[np.bool_]

_STEADYING = 0.03
"""Part of the taut stiffness lent to wrinkled fabric while steps are looked for: less and they
overshoot into the taut region and back, more and what the wire does takes more steps."""


@dataclass(frozen=True)
class TensionField:
    """Relaxed density w* of St. Venant–Kirchhoff fabric, alike in all directions or not.

    Attributes
    ----------
    stiffness : array (3, 3)
        C, positive definite, from strain (E₁₁, E₂₂, 2E₁₂) to stress where the fabric is taut, in
        units of E_f.
    """

    stiffness: Vectors

    @cached_property
    def _plain(self) -> StVenantKirchhoff:
        return StVenantKirchhoff(self.stiffness)

    @cached_property
    def _cone(self) -> StressCone:
        return stress_cone(self.stiffness)

    def compressed(self, strain: Vectors) -> Flags:
        """Whether the fabric is wrinkled or slack (m,)."""
        return self._plain.compressed(strain)

    def _wrinkles(self, strain: Vectors) -> tuple[Flags, Flags, Wrinkles]:
        """Which points (m,) are wrinkled or slack, which wrinkled, and the stress of the latter."""
        compressed = self.compressed(strain)
        wrinkled = compressed & (principal(strain * [1.0, 1.0, 0.5])[1] > 0)
        return compressed, wrinkled, wrinkles(self._cone, strain[wrinkled])

    def _stress(
        self, strain: Vectors, compressed: Flags, wrinkled: Flags, found: Wrinkles
    ) -> Vectors:
        stress = self._plain.stress(strain)
        stress[compressed] = 0.0
        stress[wrinkled] = found.stress
        return stress

    def stress(self, strain: Vectors) -> Vectors:
        """Second Piola–Kirchhoff stress (m, 3)."""
        return self._stress(strain, *self._wrinkles(strain))

    def density(self, strain: Vectors) -> Vectors:
        """Energy (m,) over unstretched area."""
        return stored_energy(self.stress(strain), strain)

    def derivatives(self, strain: Vectors, *, steady: bool) -> tuple[Vectors, Vectors, Vectors]:
        """Density (m,), stress (m, 3) and R (m, 5, 3) with Rᵀ R the derivative of the stress.

        Two rows of R are for the tension along wrinkles, three for taut fabric or a part of it.
        """
        compressed, wrinkled, found = self._wrinkles(strain)
        stress = self._stress(strain, compressed, wrinkled, found)
        part = np.where(compressed, np.sqrt(_STEADYING if steady else 0.0), 1.0)
        rows = np.zeros((len(strain), 5, 3))
        rows[wrinkled, :2] = found.rows
        rows[:, 2:] = part[:, None, None] * self._plain.root
        return stored_energy(stress, strain), stress, rows

    def smallest_stress(self, strain: Vectors) -> Vectors:
        """Smaller principal stress (m,): never negative."""
        return np.maximum(self._plain.smallest_stress(strain), 0.0)
