"""Mesh of one loop: a fan of triangles about the middle, as given to Surface Evolver."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.ellipse import semi_axes
from solver.mesh.triangulation import Mesh, RoundRegion, Wire, unrefined

Vectors = NDArray[np.float64]

SEGMENTS = 20
"""Edges of the wire in the unrefined fan."""


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
    return fan(RoundRegion(semi_axes=semi_axes(axis_ratio)))
