"""Ellipses of the perimeter of the unit circle."""

from __future__ import annotations

import math
from functools import lru_cache

from scipy.special import ellipe


@lru_cache(maxsize=256)
def semi_axes(axis_ratio: float) -> tuple[float, float]:
    """Semi-axes (a, b), a/b = ``axis_ratio`` ≥ 1, of the ellipse of perimeter 2π.

    The perimeter is 4 a E(m), m = 1 − b²/a² (DLMF 19.30.5).
    """
    if axis_ratio == 1:
        return 1.0, 1.0
    a = math.pi / (2 * float(ellipe(1 - axis_ratio**-2)))
    return a, a / axis_ratio
