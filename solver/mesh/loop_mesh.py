"""Mesh of one loop: a fan of triangles about the middle, the same that Surface Evolver was given."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.special import ellipe

from solver.mesh.triangulation import Mesh, RoundRegion, Wire, unrefined

Vectors = NDArray[np.float64]

SEGMENTS = 20
"""Edges of the wire in the unrefined fan."""


def semi_axes(axis_ratio: float) -> tuple[float, float]:
    """Semi-axes a ≥ b of the ellipse of perimeter 2π with a/b = ``axis_ratio`` ≥ 1.

    The perimeter is 4 a E(m), m = 1 − b²/a², with E the complete elliptic integral (DLMF 19.9.9).
    """
    a = 2 * math.pi / (4 * float(ellipe(1 - axis_ratio**-2)))
    return a, a / axis_ratio


def fan(region: RoundRegion) -> Mesh:
    """Coarsest mesh of one loop: vertex 0 in the middle, then the wire's from the +x axis on."""
    angles = np.arange(SEGMENTS) * (2 * np.pi / SEGMENTS)
    edge = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    points = np.concatenate([np.zeros((1, 2)), edge]) * region.semi_axes + region.centre
    around = 1 + np.arange(SEGMENTS)
    triangles = np.stack([np.zeros_like(around), around, np.roll(around, -1)], axis=1)
    return unrefined(
        points, triangles, np.zeros(SEGMENTS, dtype=np.int64), (region,), (Wire(around),)
    )


def loop_fan(axis_ratio: float = 1.0) -> Mesh:
    """Coarsest mesh of a loop about the origin, an ellipse of perimeter 2π."""
    axes = (1.0, 1.0) if axis_ratio == 1 else semi_axes(axis_ratio)
    return fan(RoundRegion(semi_axes=axes))
