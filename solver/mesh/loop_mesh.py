"""Mesh of one loop: a fan of triangles about the middle, as given to Surface Evolver."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.ellipse import semi_axes
from solver.errors import SceneError
from solver.mesh.triangulation import Mesh, RoundRegion, Wire, unrefined

Vectors = NDArray[np.float64]

SEGMENTS = 20
"""Edges of the wire in the unrefined fan, unless others are asked for."""
_FEWEST_SEGMENTS = 8


def check_segments(segments: int) -> None:
    """Refuse so many edges of a wire in the unrefined fan.

    Raises
    ------
    SceneError
        When it is no multiple of 4, as contacts a quarter turn apart need, or too few to bend.
    """
    if segments < _FEWEST_SEGMENTS or segments % 4:
        raise SceneError(
            f"segments = {segments}: must be a multiple of 4, at least {_FEWEST_SEGMENTS}"
        )


def fan(region: RoundRegion, segments: int = SEGMENTS) -> Mesh:
    """Coarsest mesh of one loop: vertex 0 in the middle, then the wire's from the +x axis on."""
    check_segments(segments)
    angles = np.arange(segments) * (2 * np.pi / segments)
    edge = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    points = np.concatenate([np.zeros((1, 2)), edge]) * region.semi_axes + region.centre
    around = 1 + np.arange(segments)
    triangles = np.stack([np.zeros_like(around), around, np.roll(around, -1)], axis=1)
    return unrefined(
        points, triangles, np.zeros(segments, dtype=np.int64), (region,), (Wire(around),)
    )


def loop_fan(axis_ratio: float = 1.0, segments: int = SEGMENTS) -> Mesh:
    """Coarsest mesh of a loop about the origin, an ellipse of perimeter 2π."""
    return fan(RoundRegion(semi_axes=semi_axes(axis_ratio)), segments)
