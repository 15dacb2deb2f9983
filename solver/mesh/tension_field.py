"""Fabric that wrinkles at no cost instead of bearing compression: a tension field.

The density is relaxed to the least that wrinkles of any fineness give,
w*(E) = min w(E + P) over P positive semidefinite (Pipkin, IMA J. Appl. Math. 36 (1986) 85;
Steigmann, Proc. R. Soc. Lond. A 429 (1990) 141). It is convex in E and never falls when E grows,
and E is convex in the shape: so w* is convex in the positions, and no mesh wrinkles at its own
scale. For isotropic fabric, with principal strains E₁ ≥ E₂ and w = a Tr E² + b (Tr E)²:

* taut, where both principal stresses are tensile: w* = w;
* wrinkled, where the smaller would be compressive and E₁ > 0: the fabric narrows across the
  wrinkles until that stress vanishes, w* = ½ Q E₁² with Q = 2a (a + 2b)/(a + b);
* slack, where E₁ ≤ 0 too: w* = 0.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.errors import SceneError
from solver.mesh.fabric_law import StVenantKirchhoff

Vectors = NDArray[np.float64]
Flags = NDArray[np.bool_]

_STEADYING = 0.03
"""Part of the taut stiffness lent to wrinkled fabric while steps are looked for: less and they
overshoot into the taut region and back, more and what the wire does takes more steps."""


@dataclass(frozen=True)
class _Axes:
    """Principal strains (m,) of e, and derivatives by e of the larger one.

    Attributes
    ----------
    high, radius : array (m,)
        E₁ and (E₁ − E₂)/2.
    slope, turn : array (m, 3)
        ∂E₁/∂e, and v such that ∂²E₁/∂e² = v vᵀ/radius: the principal axes turn with e.
    """

    high: Vectors
    radius: Vectors
    slope: Vectors
    turn: Vectors


def _axes(strain: Vectors) -> _Axes:
    half_difference, shear = (strain[:, 0] - strain[:, 1]) / 2, strain[:, 2] / 2
    radius = np.hypot(half_difference, shear)
    safe = np.where(radius > 0, radius, 1.0)
    c, s = half_difference / safe / 2, shear / safe / 2
    return _Axes(
        high=(strain[:, 0] + strain[:, 1]) / 2 + radius,
        radius=safe,
        slope=np.stack([0.5 + c, 0.5 - c, s], axis=1),
        turn=np.stack([-s, s, c], axis=1),
    )


@dataclass(frozen=True)
class TensionField:
    """Relaxed density w* of isotropic St. Venant–Kirchhoff fabric.

    Attributes
    ----------
    stiffness : array (3, 3)
        From strain (E₁₁, E₂₂, 2E₁₂) to stress where the fabric is taut, in units of E_f.

    Raises
    ------
    SceneError
        When the fabric is not alike in all directions.
    """

    stiffness: Vectors

    def __post_init__(self) -> None:
        c = self.stiffness
        isotropic = np.isclose(c[0, 0], c[1, 1], rtol=1e-9, atol=0) and np.isclose(
            2 * c[2, 2], c[0, 0] - c[0, 1], rtol=1e-9, atol=0
        )
        if not isotropic:
            raise SceneError(
                "the tension field knows fabric with equal moduli in all directions only; "
                "set modulus_ratio = 1, or solve without it where the fabric stays taut"
            )

    @property
    def _plain(self) -> StVenantKirchhoff:
        return StVenantKirchhoff(self.stiffness)

    @property
    def uniaxial_modulus(self) -> float:
        """Q, the stiffness of fabric that is free to narrow, in units of E_f."""
        along, coupling = float(self.stiffness[0, 0]), float(self.stiffness[0, 1])
        return along - coupling**2 / along

    def compressed(self, strain: Vectors) -> Flags:
        """Whether the fabric is wrinkled or slack (m,)."""
        return self._plain.compressed(strain)

    def _wrinkled(self, strain: Vectors, axes: _Axes) -> tuple[Flags, Vectors]:
        """Where the fabric wrinkles or is slack, and the tension (m,) along the wrinkles there."""
        return self.compressed(strain), self.uniaxial_modulus * np.maximum(axes.high, 0)

    def density(self, strain: Vectors) -> Vectors:
        """Energy (m,) over unstretched area."""
        axes = _axes(strain)
        wrinkled, tension = self._wrinkled(strain, axes)
        return np.where(wrinkled, tension * axes.high / 2, self._plain.density(strain))

    def stress(self, strain: Vectors) -> Vectors:
        """Second Piola–Kirchhoff stress (m, 3)."""
        axes = _axes(strain)
        wrinkled, tension = self._wrinkled(strain, axes)
        uniaxial = tension[:, None] * axes.slope
        return np.where(wrinkled[:, None], uniaxial, self._plain.stress(strain))

    def root(self, strain: Vectors) -> Vectors:
        """Matrices R (m, 5, 3) with Rᵀ R the derivative of the stress."""
        return self._rows(strain, 0.0)

    def steady_root(self, strain: Vectors) -> Vectors:
        """Like `root`, with a part of the taut fabric's stiffness where it wrinkles."""
        return self._rows(strain, _STEADYING)

    def _rows(self, strain: Vectors, lent: float) -> Vectors:
        """Two rows for the tension along the wrinkles, three for taut fabric or a part of it."""
        axes = _axes(strain)
        wrinkled, tension = self._wrinkled(strain, axes)
        along = np.where(wrinkled & (tension > 0), self.uniaxial_modulus, 0.0)
        turning = np.where(wrinkled, tension / axes.radius, 0.0)
        part = np.where(wrinkled, np.sqrt(lent), 1.0)
        rows = np.empty((len(strain), 5, 3))
        rows[:, 0] = np.sqrt(along)[:, None] * axes.slope
        rows[:, 1] = np.sqrt(turning)[:, None] * axes.turn
        rows[:, 2:] = part[:, None, None] * self._plain.root(strain)
        return rows

    def smallest_stress(self, strain: Vectors) -> Vectors:
        """Smaller principal stress (m,): never negative."""
        return np.maximum(self._plain.smallest_stress(strain), 0.0)
