"""Ellipses by their perimeter, which is the wire that goes into a loop."""

from __future__ import annotations

from functools import cache
from math import pi, sqrt

MOST_ROUNDS = 60


def perimeter(long: float, short: float) -> float:
    """Perimeter of an ellipse, in the unit of its semi-axes.

    By the arithmetic-geometric mean: DLMF 19.8.1 and 19.8.6, with the perimeter as four times the
    long semi-axis times the complete elliptic integral E. The mean converges quadratically.

    Parameters
    ----------
    long, short : float
        Semi-axes, positive; in either order.
    """
    upper, lower = max(long, short), min(long, short)
    rest, weight = (upper**2 + lower**2) / 2, 0.5
    for _ in range(MOST_ROUNDS):
        half_gap = (upper - lower) / 2
        if half_gap <= 1e-16 * upper:
            break
        upper, lower = (upper + lower) / 2, sqrt(upper * lower)
        weight *= 2
        rest -= weight * half_gap**2
    return 2 * pi * rest / ((upper + lower) / 2)


@cache
def semi_axes(diameter: float, axis_ratio: float) -> tuple[float, float]:
    """Semi-axes, the long one first, of the ellipse as long around as a circle.

    Parameters
    ----------
    diameter : float
        Of the circle; the semi-axes are in its unit.
    axis_ratio : float
        Length over width, at least 1.
    """
    if axis_ratio == 1:
        return diameter / 2, diameter / 2
    short = pi * diameter / perimeter(axis_ratio, 1.0)
    return axis_ratio * short, short
