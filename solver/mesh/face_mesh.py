"""Triangles for one region of a plane drawing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import Delaunay, QhullError, cKDTree

from solver.errors import SceneError
from solver.mesh.faces import Face, contains

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]

SMALLEST_ANGLE = 1.0
"""Degrees; the cusps between equal loops that touch have 18, and half with each refinement."""

MOST_SPOKES = 24
_SMALLEST_FAN_ANGLE = 10.0
"""Degrees; thinner spokes stiffen what they fill: in the gap between four equal loops, of 4."""
_CLEARANCE = 0.6
"""Distance of inner vertices from those of the edge, over the spacing.

More than half of it keeps them out of the circles over the edges, so that Delaunay's triangulation
has those edges.
"""

_DIGITS = 9
_NO_ANGLE = 1e-3
"""Degrees; such triangles are of three points on a straight edge."""
_ON_ONE_CIRCLE = 1e-6
"""Radians by which opposite angles of a quadrilateral on a circle may miss π."""


@dataclass(frozen=True)
class Filling:
    """Triangles (m, 3) of a region, with the inner points (i, 2) they need.

    Inner vertices are numbered on from those of the drawing.
    """

    points: Vectors
    triangles: Indices


def smallest_angles(points: Vectors, triangles: Indices) -> Vectors:
    """Smallest angle (m,) of each triangle in degrees; negative when it runs clockwise."""
    corners = points[triangles]
    angles: list[Vectors] = []
    for k in range(3):
        one, other = (corners[:, (k + s) % 3] - corners[:, k] for s in (1, 2))
        cross = one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]
        angles.append(np.arctan2(cross, np.sum(one * other, axis=1)))
    return np.degrees(np.min(angles, axis=0))


def fan_about(points: Vectors, face: Face, centre: Vectors) -> Filling:
    """Triangles from a centre (1, 2) to each edge round a face."""
    edges = face.edges
    hub = np.full(len(edges), len(points))
    return Filling(centre, np.column_stack([hub, edges]))


def _fan(points: Vectors, face: Face) -> Filling | None:
    """Fan about the middle, where the face is small, simple and seen from there."""
    rim = np.unique(face.outline)
    if face.holes or len(rim) < len(face.outline) or len(rim) > MOST_SPOKES:
        return None
    middle = points[face.outline].mean(axis=0)[None]
    return fan_about(points, face, middle) if _sees_arcs(points, face, middle) else None


def _sees_arcs(points: Vectors, face: Face, centre: Vectors) -> bool:
    """Whether spokes leave the rim into the region also where its edges become arcs.

    In a cusp that can fail though the edges, chords of the arcs, leave room. One-sided differences
    of second order along the rim stand for the arcs' tangents.
    """
    rim = points[face.outline]
    spokes = centre - rim
    for way in (1, -1):
        near, far = (np.roll(rim, -way * step, axis=0) for step in (1, 2))
        tangent = way * (4 * near - 3 * rim - far)
        if (tangent[:, 0] * spokes[:, 1] - tangent[:, 1] * spokes[:, 0] <= 0).any():
            return False
    return True


def _sharpest(points: Vectors, filling: Filling) -> float:
    """Smallest angle, in degrees."""
    return float(smallest_angles(np.concatenate([points, filling.points]), filling.triangles).min())


def _inner_points(points: Vectors, face: Face, spacing: float) -> Vectors:
    """Points of a triangular grid that are well inside a face."""
    rim, corners = points[face.edges], points[face.outline]
    # about the middle, so that the grid is as symmetric as the face
    low, high = corners.min(axis=0), corners.max(axis=0)
    step = spacing * np.array([1.0, np.sqrt(3) / 2])
    across, up = (int(n) + 1 for n in (high - low) / 2 / step)
    row, place = np.mgrid[-up : up + 1, -across - 1 : across + 1]
    place = place + np.where(row % 2, 0.5, 0.0)
    grid = (low + high) / 2 + step * np.stack([place.ravel(), row.ravel()], axis=1)
    grid = grid[contains(points, face.edges, grid)]
    near = cKDTree(np.concatenate([rim[:, 0], rim.mean(axis=1)])).query(grid)[0]
    return grid[near > _CLEARANCE * spacing]


def _delaunay(points: Vectors, face: Face, spacing: float) -> Filling:
    """Delaunay's triangulation of a face's vertices and inner points.

    Raises
    ------
    SceneError
        When it lacks an edge of the face.
    """
    edges = face.edges
    rim = np.unique(edges)
    inner = _inner_points(points, face, spacing)
    number = np.concatenate([rim, len(points) + np.arange(len(inner))])
    try:
        found = number[_triangulated(np.concatenate([points[rim], inner]))]
    except QhullError:
        raise SceneError(f"the region near {_place(points, face)} has no area") from None
    everything = np.concatenate([points, inner])
    filling = Filling(inner, found[contains(points, edges, everything[found].mean(axis=1))])
    sides = np.sort(_sides(filling.triangles).reshape(-1, 2), axis=1)
    known = {tuple(side) for side in sides.tolist()}
    if not {tuple(edge) for edge in np.sort(edges, axis=1).tolist()} <= known:
        raise SceneError(
            f"the region near {_place(points, face)} is too narrow for the edges round it: "
            "divide the loops into more segments"
        )
    return _evened(points, filling)


def _triangulated(points: Vectors) -> Indices:
    """Delaunay's triangles (m, 3) of points (n, 2), counterclockwise, none without area."""
    # in an order, and with digits, that do not depend on where the points lie
    local = np.round(points - points.mean(axis=0), _DIGITS)
    order = np.lexsort(local.T)
    found = order[Delaunay(local[order]).simplices].astype(np.int64)
    clockwise = smallest_angles(points, found) < 0
    found[clockwise] = found[clockwise][:, ::-1]
    return found[smallest_angles(points, found) > _NO_ANGLE]


def _sides(triangles: Indices) -> Indices:
    """Sides (m, 3, 2) of triangles, each opposite the corner of its number."""
    return triangles[:, [[1, 2], [2, 0], [0, 1]]]


def _evened(points: Vectors, filling: Filling) -> Filling:
    """Fill polygons whose corners lie on one circle with fans about their middles.

    Delaunay's criterion leaves the diagonals of such a polygon open, and either choice would break
    the symmetry of the region.
    """
    everything = np.concatenate([points, filling.points])
    triangles = filling.triangles
    corners = everything[triangles]
    ahead, back = (np.roll(corners, -s, axis=1) - corners for s in (1, 2))
    cross = ahead[..., 0] * back[..., 1] - ahead[..., 1] * back[..., 0]
    angles = np.arctan2(cross, np.sum(ahead * back, axis=2)).ravel()
    sides = np.sort(_sides(triangles).reshape(-1, 2), axis=1)
    order = np.lexsort(sides.T)
    one, other = order[:-1], order[1:]
    shared = (sides[one] == sides[other]).all(axis=1)
    open_sides = shared & (np.abs(angles[one] + angles[other] - np.pi) < _ON_ONE_CIRCLE)
    pairs = one[open_sides] // 3, other[open_sides] // 3
    count = len(triangles)
    links = coo_array((np.ones(len(pairs[0])), pairs), shape=(count, count))
    polygon = connected_components(links, directed=False)[1]
    single = np.bincount(polygon)[polygon] == 1
    out, middles = [triangles[single]], [filling.points]
    for number in np.unique(polygon[~single]):
        within = np.sort(_sides(triangles[polygon == number]).reshape(-1, 2), axis=1)
        directed = _sides(triangles[polygon == number]).reshape(-1, 2)
        _, back_to, times = np.unique(within, axis=0, return_inverse=True, return_counts=True)
        rim = directed[times[back_to] == 1]
        hub = len(points) + sum(len(m) for m in middles)
        middles.append(everything[np.unique(rim)].mean(axis=0)[None])
        out.append(np.column_stack([np.full(len(rim), hub), rim]))
    return Filling(np.concatenate(middles), np.concatenate(out))


def _place(points: Vectors, face: Face) -> str:
    x, y = points[face.outline].mean(axis=0)
    return f"({x:.4g}, {y:.4g})"


def filled(points: Vectors, face: Face, spacing: float) -> Filling:
    """Fill a face with triangles: a fan where it is small, Delaunay's triangulation elsewhere.

    Raises
    ------
    SceneError
        When an angle would be smaller than `SMALLEST_ANGLE`, or the region cannot be filled.
    """
    fan = _fan(points, face)
    if fan is not None and _sharpest(points, fan) >= _SMALLEST_FAN_ANGLE:
        return fan
    try:
        filling = _delaunay(points, face, spacing)
    except SceneError:
        if fan is None or _sharpest(points, fan) < SMALLEST_ANGLE:
            raise
        return fan
    if (angle := _sharpest(points, filling)) < SMALLEST_ANGLE:
        raise SceneError(
            f"the region near {_place(points, face)} has a corner of {angle:.2g} degrees: "
            f"at least {SMALLEST_ANGLE:g} are needed"
        )
    return filling
