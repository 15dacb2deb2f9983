"""Distances of segments from segments and of points from triangles, and where they pierce."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.float64]
Flags = NDArray[np.bool_]

_TINY = 1e-300
_INSIDE = 1e-9
"""Part of a length that is taken for none: a segment that ends in a plane does not cross it."""


def _dot(one: Vectors, other: Vectors) -> Vectors:
    return np.sum(one * other, axis=1)


def _between_0_and_1(values: Vectors) -> Vectors:
    return np.clip(values, 0.0, 1.0)


def segment_distance(p: Vectors, p_end: Vectors, q: Vectors, q_end: Vectors) -> Vectors:
    """Distance (m,) of segments from p to p_end and from q to q_end, each (m, 3).

    Ericson, Real-Time Collision Detection (2005), section 5.1.9.
    """
    along, across, apart = p_end - p, q_end - q, p - q
    a, e, b = _dot(along, along), _dot(across, across), _dot(along, across)
    c, f = _dot(along, apart), _dot(across, apart)
    whole = a * e - b * b
    # parallel ones are nearest anywhere; the first point serves
    s = np.where(whole > 1e-12 * a * e, (b * f - c * e) / np.maximum(whole, _TINY), 0.0)
    s = _between_0_and_1(s)
    t = _between_0_and_1((b * s + f) / np.maximum(e, _TINY))
    s = _between_0_and_1((b * t - c) / np.maximum(a, _TINY))
    return np.linalg.norm(apart + s[:, None] * along - t[:, None] * across, axis=1)


def _barycentric(points: Vectors, triangles: Vectors) -> tuple[Vectors, Vectors, Vectors]:
    """Coordinates u, v (m,) in triangles (m, 3, 3) of the feet of points, and signed heights."""
    one, other = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    normal = np.cross(one, other)
    square = np.maximum(_dot(normal, normal), _TINY)
    arm = points - triangles[:, 0]
    u = _dot(np.cross(arm, other), normal) / square
    v = _dot(np.cross(one, arm), normal) / square
    return u, v, _dot(arm, normal) / np.sqrt(square)


def height_over_triangle(points: Vectors, triangles: Vectors) -> Vectors:
    """Distance (m,) of points (m, 3) from the inside of triangles; infinite beside them."""
    u, v, height = _barycentric(points, triangles)
    inside = (u >= 0) & (v >= 0) & (u + v <= 1)
    return np.where(inside, np.abs(height), np.inf)


def pierces(start: Vectors, end: Vectors, triangles: Vectors) -> Flags:
    """Whether segments (m, 3) pass through triangles (m, 3, 3), their sides included."""
    u_0, v_0, one = _barycentric(start, triangles)
    u_1, v_1, other = _barycentric(end, triangles)
    size = np.linalg.norm(end - start, axis=1)
    through = (one * other < 0) & (np.minimum(np.abs(one), np.abs(other)) > _INSIDE * size)
    part = np.where(through, one / np.where(through, one - other, 1.0), 0.0)
    u, v = u_0 + part * (u_1 - u_0), v_0 + part * (v_1 - v_0)
    # shapes with mirror planes cross themselves just on the sides of triangles
    return through & (u > -_INSIDE) & (v > -_INSIDE) & (u + v < 1 + _INSIDE)


def on_both_sides(start: Vectors, end: Vectors, triangles: Vectors) -> Flags:
    """Whether segments (m, 3) have their ends on different sides of triangles' planes.

    A quick test that leaves few pairs to `pierces`.
    """
    corner = triangles[:, 0]
    normal = np.cross(triangles[:, 1] - corner, triangles[:, 2] - corner)
    return _dot(start - corner, normal) * _dot(end - corner, normal) < 0


def segment_triangle_distance(start: Vectors, end: Vectors, triangles: Vectors) -> Vectors:
    """Distance (m,) of segments (m, 3) from triangles (m, 3, 3); 0 where one pierces the other."""
    sides = [
        segment_distance(start, end, triangles[:, k], triangles[:, (k + 1) % 3]) for k in range(3)
    ]
    ends = [height_over_triangle(points, triangles) for points in (start, end)]
    return np.where(pierces(start, end, triangles), 0.0, np.min([*sides, *ends], axis=0))
