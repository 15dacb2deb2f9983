"""Height of a circular loop in closed form: the exact threshold, and a fitted law beyond it.

Saddles of all scenes are nearly members of one family, told apart by w = (π H)², H being the height
over the perimeter. Along it the four integrals of the energy are functions of w alone,

    ∫ Tr C² dA = 2π − 4π Σ p w^n/n,    ∫ (Tr C)² dA = 4π − 8π Σ p w^n/n,
    ∫ Tr C dA = 2π − 2π Σ p w^n/n,     ∮ κ² dl = 2π + 12π Σ p w^n/n,

whose first coefficient, p = 1 for n = 1, is exact: it gives the threshold T = 12 β and the square
root by which the height sets in. The coefficients of w² and w³ are fitted. With them the energy is
stationary where a quadratic in w vanishes.

A wire that shortens by a part s of its length makes the loop one of radius 1 − s: its fabric is
stretched by (1 + ε)(1 − s), its wire has β/(1 − s)³, and s is where the energy of the four
integrals and of the wire's stretch is stationary. Of the flat loop that is exact, and so is the
threshold, (6) of docs/theory.md, for any axial stiffness. Its section 8 says where the law holds.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from solver.reading import Reading, density_coefficients

LARGEST_ERROR = 0.004
LARGEST_ERROR_INCOMPRESSIBLE = 0.0085
"""Errors of H that no loop exceeds whose wire does not stretch; see `LawLoop.error`."""
ERROR_BY_SHORTENING = 0.5
"""What is added to them, over the part by which the wire shortens."""
RMS_ERROR = 0.0019
"""Root of the mean square of errors of H with k ≥ 1000, in the reading where it is larger."""

LARGEST_SHORTENING = 0.03
"""Part of its length by which the wire may shorten, as far as errors are stated."""

_INCOMPRESSIBLE = 0.0999
"""Of a/(a + 2b): below it, ν > 0.45 of the published reading, the larger error holds."""

_SHEAR = (-5.710, 7.294)
_SWELL = (-5.580, 6.953)
_METRIC = (-4.609, 3.363)
_BENDING = (-3.111, -2.080)
"""Slopes by w of the four integrals, over their slopes at w = 0, less 1: by w and by w²."""

_SLACK = (0.135, 0.3, 10.0)
"""Below 0.135 g^0.3 (1 + 10 s) of the β at which it buckles a loop may have slack fabric, for
g = a/(a + 2b) and a wire shortened by s. It encloses all loops that were compared."""

_MOST_STEPS = 12
_SMALLEST_RADIUS, _LARGEST_RADIUS = 0.4, 2.0
_NEAR = 1e-10


@dataclass(frozen=True, slots=True)
class LawLoop:
    """A loop by the law.

    Attributes
    ----------
    height : float
        Over the perimeter 2π R; 0 where the loop is flat.
    radius : float
        Of the circle of the wire's length, in units of R: 1 where it does not shorten.
    below_threshold : float
        β over that at which the loop, of this radius, buckles.
    taut_above : float
        Of ``below_threshold``: where it is less the fabric may be slack.
    error : float
        Of ``height``, absolute, at most; infinite where the wire shortens by more than
        `LARGEST_SHORTENING`. It holds for β 0.01–0.25, strain 0–0.5, ν 0–0.49, both readings and
        fabric that is not slack, by ``python -m benchmarks.scaling_law``; H goes up to 0.168 there.
        A flat loop has none.
    """

    height: float
    radius: float
    below_threshold: float
    taut_above: float
    error: float

    @property
    def shortening(self) -> float:
        """Part of its length by which the wire is shorter than it was laid; at least 0."""
        return max(0.0, 1 - self.radius)

    @property
    def may_be_slack(self) -> bool:
        """Whether the fabric is slack somewhere, or nearly."""
        return self.below_threshold < self.taut_above


def scaling_height(
    strain: float,
    beta: float,
    poisson: float,
    reading: Reading,
    axial_stiffness: float = math.inf,
) -> float:
    """Height over perimeter of a loop, in microseconds; the parameters are `scaling_loop`'s."""
    return scaling_loop(strain, beta, poisson, reading, axial_stiffness).height


def scaling_loop(
    strain: float,
    beta: float,
    poisson: float,
    reading: Reading,
    axial_stiffness: float = math.inf,
) -> LawLoop:
    """Give a loop by the law, in tens of microseconds.

    Parameters
    ----------
    strain, beta, poisson : float
        ε, β and ν.
    reading : Reading
    axial_stiffness : float
        k; by default the wire does not stretch.

    Raises
    ------
    SceneError
        When ν is out of its range.
    """
    law = _Law(strain, beta, *density_coefficients(poisson, reading), axial_stiffness)
    radius, square, settled = _balanced(law)
    stiffness = law.a + 2 * law.b
    tension = stiffness * (((1 + strain) * radius) ** 2 - 1)
    compliance = law.a / stiffness
    shortening = max(0.0, 1 - radius)
    share, power, by_shortening = _SLACK
    return LawLoop(
        height=radius * math.sqrt(square) / math.pi,
        radius=radius,
        below_threshold=12 * beta / radius**3 / tension if tension > 0 else math.inf,
        taut_above=share * compliance**power * (1 + by_shortening * shortening),
        error=_largest_error(compliance, shortening, flat=square == 0) if settled else math.inf,
    )


def _largest_error(compliance: float, shortening: float, *, flat: bool) -> float:
    if flat:
        return 0.0
    if shortening > LARGEST_SHORTENING:
        return math.inf
    nearly = compliance < _INCOMPRESSIBLE
    rigid = LARGEST_ERROR_INCOMPRESSIBLE if nearly else LARGEST_ERROR
    return rigid + ERROR_BY_SHORTENING * shortening


@dataclass(frozen=True, slots=True)
class _Law:
    """What is stationary by w and by the loop's radius: ε, β, the density's a and b, and k."""

    strain: float
    beta: float
    a: float
    b: float
    axial_stiffness: float

    def square(self, radius: float) -> float:
        """Give w where the energy of a loop of a radius is stationary; 0 where that is flat."""
        stretch = ((1 + self.strain) * radius) ** 2
        metric, bending = self.a + 2 * self.b, 12 * self.beta / radius**3
        excess = metric * (stretch - 1) - bending
        if excess <= 0:
            return 0.0
        weights = (-stretch * self.a, -2 * stretch * self.b, metric, bending)
        slopes = (_SHEAR, _SWELL, _METRIC, _BENDING)
        linear = sum(weight * slope[0] for weight, slope in zip(weights, slopes, strict=True))
        bent = sum(weight * slope[1] for weight, slope in zip(weights, slopes, strict=True))
        # the root of bent w² + linear w − excess that tends to 0 with the excess
        root = math.sqrt(max(linear**2 + 4 * bent * excess, 0.0))
        return 2 * excess / (linear + root)

    def imbalance(self, radius: float) -> tuple[float, float]:
        """Slope of the energy by the radius over 2π k, and w."""
        w = self.square(radius)
        stretch = ((1 + self.strain) * radius) ** 2
        shear, swell, metric, bending = (
            1 - fall * (w + slope[0] * w**2 / 2 + slope[1] * w**3 / 3)
            for fall, slope in zip((2, 2, 1, -6), (_SHEAR, _SWELL, _METRIC, _BENDING), strict=True)
        )
        fabric = self.a * (stretch * shear - metric) + 2 * self.b * (stretch * swell - metric)
        pull = radius * fabric - self.beta * bending / radius**2
        return radius - 1 + pull / self.axial_stiffness, w

    def steepness(self) -> float:
        """Slope of the imbalance of a flat loop at radius 1."""
        fabric = (self.a + 2 * self.b) * (3 * (1 + self.strain) ** 2 - 1)
        return 1 + (fabric + 2 * self.beta) / self.axial_stiffness


def _balanced(law: _Law) -> tuple[float, float, bool]:
    """Radius and w in balance, and whether they are, by the secant method."""
    before, radius = 1.0, 1.0
    off, square = law.imbalance(radius)
    steepness = law.steepness()
    for _ in range(_MOST_STEPS):
        if abs(off) <= _NEAR:
            return radius, square, True
        before = radius
        radius = min(max(radius - off / steepness, _SMALLEST_RADIUS), _LARGEST_RADIUS)
        last, (off, square) = off, law.imbalance(radius)
        if off == last or radius == before:
            break
        steepness = (off - last) / (radius - before)
    return radius, square, abs(off) <= _NEAR
