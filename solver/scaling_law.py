"""Height of a circular loop in closed form: the exact threshold, and a fitted law beyond it.

Saddles of all scenes are nearly members of one family, told apart by w = (π H)², H being the height
over the perimeter. Along it the four integrals of the energy are functions of w alone,

    ∫ Tr C² dA = 2π − 4π Σ p w^n/n,    ∫ (Tr C)² dA = 4π − 8π Σ p w^n/n,
    ∫ Tr C dA = 2π − 2π Σ p w^n/n,     ∮ κ² dl = 2π + 12π Σ p w^n/n,

whose first coefficient, p = 1 for n = 1, is exact: it gives the threshold T = 12 β and the square
root by which the height sets in. The coefficients of w² and w³ are fitted. With them the energy is
stationary where a quadratic in w vanishes.
"""

from __future__ import annotations

import math

from solver.reading import Reading, density_coefficients
from solver.threshold import line_tension

LARGEST_ERROR = 0.012
RMS_ERROR = 0.0011
"""Errors of H against the compact solve, by ``python -m benchmarks.scaling_law``.

They are those over β 0.01–0.25, strain 0.01–0.5, ν 0–0.49 and both readings, for a wire that does
not stretch, where the loop buckles and no fabric is slack; H goes up to 0.167 there. The largest
error is 0.0023 in the plane-stress reading, 0.0039 in the published one up to ν = 0.45.
"""

_SHEAR = (-5.710, 7.294)
_SWELL = (-5.580, 6.953)
_METRIC = (-4.609, 3.363)
_BENDING = (-3.111, -2.080)
"""Slopes by w of the four integrals, over their slopes at w = 0, less 1: by w and by w²."""


def scaling_height(strain: float, beta: float, poisson: float, reading: Reading) -> float:
    """Height over perimeter of a loop whose wire hardly stretches, in microseconds.

    Parameters
    ----------
    strain, beta, poisson : float
        ε, β and ν.
    reading : Reading

    Raises
    ------
    SceneError
        When ν is out of its range.
    """
    a, b = density_coefficients(poisson, reading)
    excess = line_tension(strain, poisson, reading) - 12 * beta
    if excess <= 0:
        return 0.0
    square = (1 + strain) ** 2
    weights = (-square * a, -2 * square * b, a + 2 * b, 12 * beta)
    slopes = (_SHEAR, _SWELL, _METRIC, _BENDING)
    linear = sum(weight * slope[0] for weight, slope in zip(weights, slopes, strict=True))
    bent = sum(weight * slope[1] for weight, slope in zip(weights, slopes, strict=True))
    # the root of bent w² + linear w − excess that tends to 0 with the excess
    root = math.sqrt(max(linear**2 + 4 * bent * excess, 0.0))
    return math.sqrt(2 * excess / (linear + root)) / math.pi
