"""The uniaxial stress of fabric that wrinkles.

In the coordinates of `solver.mesh.stress_cone` the stress of wrinkled fabric is the point s of the
cone's surface where s·e − ½ Σ dᵢ sᵢ² is largest. With a multiplier μ ≥ 0,

    s₀ = e₀/(d₀ − μ),  s₁ = e₁/(d₁ + μ),  s₂ = e₂/(d₂ + μ),  s₀² = s₁² + s₂²,

and with x = (d₀ + d₁)/(d₁ + μ) and k = (d₂ − d₁)/(d₀ + d₁) ≥ 0 these four are one equation,

    (x − 1) √(e₁² + e₂²/(1 + kx)²) = e₀,

whose left side grows with x: there is one solution (docs/theory.md, eq. 9b). It is 0 where the
fabric becomes slack, 1 + d₀/d₁ where it becomes taut, and 1 + e₀/√(e₁² + e₂²) for k = 0.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.mesh.stress_cone import StressCone

Vectors = NDArray[np.float64]

_NEARLY = 1e-9
"""Last change of x: what a Newton step leaves is of the order of its square."""
_MOST_STEPS = 100
_ALIKE = 1e-13
"""k up to which fabric is alike in all directions, but for rounding."""


@dataclass(frozen=True)
class Wrinkles:
    """Stress of m points of wrinkled fabric.

    Attributes
    ----------
    cone : StressCone
    part : array (m,)
        x of this module's equation.
    tension : array (m,)
        s₀, half the stress along the wrinkles in these coordinates.
    cosine, sine : array (m,)
        s₁/s₀ and s₂/s₀.
    """

    cone: StressCone
    part: Vectors
    tension: Vectors
    cosine: Vectors
    sine: Vectors

    @property
    def stress(self) -> Vectors:
        """Second Piola–Kirchhoff stress (S₁₁, S₂₂, S₁₂), (m, 3)."""
        return self.tension[:, None] * self._direction @ self.cone.frame

    @property
    def _direction(self) -> Vectors:
        return np.stack([np.ones_like(self.sine), self.cosine, self.sine], axis=1)

    @property
    def rows(self) -> Vectors:
        """Two rows (m, 2, 3): the sum of their squares is the derivative of the stress.

        The largest over angles φ, (s₁, s₂) = s₀ (cos φ, sin φ), of ½ (τ·e)²/B with
        τ = (1, cos φ, sin φ) and B = Σ dᵢ τᵢ² has the second derivative τ τᵀ/B + v vᵀ/κ with
        v = τ′ − τ B′/2B and κ = μ + d₁ sin² φ + d₂ cos² φ − (B′)²/4B.
        """
        d, c, s = self.cone.compliance, self.cosine, self.sine
        total, excess = d[0] + d[1], d[2] - d[1]
        flexibility = total + excess * s**2
        half_slope = excess * s * c
        # κ = (total + part * rest)/part, which has no bound where the fabric becomes slack
        rest = excess * c**2 * total / flexibility
        along, turn = self._direction, np.zeros((len(s), 3))
        turn[:, 1], turn[:, 2] = -s, c
        turn -= (half_slope / flexibility)[:, None] * along
        along /= np.sqrt(flexibility)[:, None]
        turn *= np.sqrt(self.part / (total + self.part * rest))[:, None]
        return np.stack([along, turn], axis=1) @ self.cone.frame


def wrinkles(cone: StressCone, strain: Vectors) -> Wrinkles:
    """Find the stress by the strain (E₁₁, E₂₂, 2E₁₂), (m, 3), of fabric that is wrinkled.

    It is neither taut nor slack: E is not negative semidefinite, nor would the stress of taut
    fabric be positive semidefinite.
    """
    d = cone.compliance
    total = d[0] + d[1]
    mean, first, second = (strain @ cone.frame.T).T
    radius = np.hypot(first, second)
    excess = float((d[2] - d[1]) / total)
    taut = float(total / d[1])
    part = _part(mean / radius, (first / radius) ** 2, (second / radius) ** 2, excess, taut)
    second = second / (1 + excess * part)
    size = np.hypot(first, second)
    return Wrinkles(cone, part, part * size / total, first / size, second / size)


def _part(mean: Vectors, first: Vectors, second: Vectors, excess: float, taut: float) -> Vectors:
    """Solve (x − 1) √(c + s/(1 + kx)²) = g for g > −1 and c + s = 1, all (m,): Newton's steps.

    Bounds are the solutions at s = 0 and c = 0, and where the fabric becomes taut.
    """
    if excess < _ALIKE:
        return 1 + mean
    narrow = 1 - excess * mean
    ends = 1 + mean, np.where(narrow > 0, (1 + mean) / np.where(narrow > 0, narrow, 1), np.inf)
    low, high = np.minimum(*ends), np.minimum(np.maximum(*ends), 2 * taut)
    x = low
    for _ in range(_MOST_STEPS):
        q = 1 / (1 + excess * x)
        size = np.sqrt(first + second * q**2)
        beyond = (x - 1) * size - mean
        low, high = np.where(beyond < 0, x, low), np.where(beyond > 0, x, high)
        after = x - beyond * size / (first + (1 + excess) * second * q**3)
        after = np.where((after < low) | (after > high), (low + high) / 2, after)
        change, x = np.abs(after - x), after
        if (change <= _NEARLY * (1 + x)).all():
            break
    return x
