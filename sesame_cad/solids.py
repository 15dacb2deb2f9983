"""Printable solids: a sheet of fabric with its edge of wire, and arrays of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np
import trimesh
from manifold3d import Manifold, Mesh64, OpType
from numpy.typing import NDArray

from sesame_cad.errors import InputError
from sesame_cad.watertight import vertex_normals, watertight

Vectors = NDArray[np.float64]
Triangles = NDArray[np.int64]

Surface = Callable[[Vectors, Vectors], Vectors]
"""From radius (n,) in 0..1 and angle (n,) in radians to points (n, 3) in mm."""

Boundary = Callable[[Vectors], Vectors]
"""From angle (n,) in radians to points (n, 3) in mm."""

ClosedSurface = tuple[Vectors, Triangles]
"""Points (n, 3) in mm and faces (m, 3), turned outward."""

RIM_SHARE = 0.6
"""The fabric's edge is at most this share of the wire, so that it ends well inside the tube."""


def boundary_segments(boundary: Boundary, tolerance_mm: float = 0.05) -> int:
    """Count the chords, a multiple of 4, that keep within ``tolerance_mm`` of a closed boundary.

    Raises
    ------
    InputError
        When the tolerance is not positive.
    """
    if not tolerance_mm > 0:
        raise InputError(f"{tolerance_mm:g} mm is no tolerance: give more than 0")
    segments = 16
    while _chord_error_mm(boundary, segments) > tolerance_mm:
        segments += 4
    return segments


def cell_bodies(
    surface: Surface,
    boundary: Boundary,
    *,
    wire_diameter_mm: float,
    fabric_thickness_mm: float,
    rings: int,
    segments: int,
    sides: int,
) -> tuple[ClosedSurface, ClosedSurface]:
    """Make a slab of fabric, and the tube of wire around it.

    Parameters
    ----------
    surface : callable
        The middle of the fabric; radius 1 is the wire's centreline.
    boundary : callable
        The wire's centreline, once around as the angle goes from 0 to 2π.
    rings : int
        Steps of the fabric from the centre to the edge.
    segments : int
        Chords around the edge, a multiple of 4: see `boundary_segments`.
    sides : int
        Sides of the wire's cross-section, a multiple of 4, so that it measures its full diameter
        along z and across.

    Returns
    -------
    slab, tube : tuple
        Points (n, 3) in mm and faces (m, 3) each.

    Raises
    ------
    InputError
        When the fabric is thicker than the wire, or a number is out of range.
    """
    faults = _cell_faults(wire_diameter_mm, fabric_thickness_mm, rings, segments, sides)
    if faults:
        raise InputError(*faults)
    slab = _slab(surface, wire_diameter_mm, fabric_thickness_mm, rings, segments)
    return slab, tube_mesh(boundary, wire_diameter_mm, segments, sides)


def union_solid(parts: Iterable[ClosedSurface]) -> trimesh.Trimesh:
    """Join closed surfaces, each points and faces, into one solid.

    Raises
    ------
    InputError
        When the union does not come out as one closed solid.
    """
    return watertight(_union([_manifold(*part) for part in parts]))


def array_solid(cell: trimesh.Trimesh, centres_mm: Vectors) -> trimesh.Trimesh:
    """Join copies of a cell into one solid.

    Parameters
    ----------
    centres_mm : array, shape (n, 2)
        Where the cell's origin goes; neighbours overlap where their wires touch.

    Raises
    ------
    InputError
        When the union does not come out as one closed solid.
    """
    solid = _manifold(cell.vertices, cell.faces)
    return watertight(_union([solid.translate((float(x), float(y), 0.0)) for x, y in centres_mm]))


def _cell_faults(
    wire_diameter_mm: float, thickness_mm: float, rings: int, segments: int, sides: int
) -> tuple[str, ...]:
    checks = (
        (
            0 < thickness_mm <= wire_diameter_mm,
            (
                f"fabric of {thickness_mm:g} mm does not end inside "
                f"wire of {wire_diameter_mm:g} mm: give a thickness up to the wire's diameter"
            ),
        ),
        (rings >= 1, f"rings is {rings}: give 1 or more"),
        (segments >= 8 and segments % 4 == 0, f"segments is {segments}: give 8, 12, 16, ..."),
        (sides >= 4 and sides % 4 == 0, f"sides is {sides}: give 4, 8, 12, ..."),
    )
    return tuple(message for good, message in checks if not good)


def _chord_error_mm(boundary: Boundary, segments: int) -> float:
    point = boundary(_turn(2 * segments + 1, 2 * segments))
    return float(np.linalg.norm(point[1::2] - (point[:-1:2] + point[2::2]) / 2, axis=1).max())


def _turn(count: int, steps: int) -> Vectors:
    """Angles from 0 in so many equal steps a turn."""
    return np.arange(count, dtype=np.float64) * (2 * np.pi / steps)


def _slab(
    surface: Surface, wire_diameter_mm: float, thickness_mm: float, rings: int, segments: int
) -> tuple[Vectors, Triangles]:
    """Offset the disc to both sides and close it at the rim."""
    middle, faces = disc_mesh(surface, rings, segments)
    half_mm = np.full((len(middle), 1), thickness_mm / 2)
    half_mm[-segments:] = min(thickness_mm / 2, RIM_SHARE * wire_diameter_mm / 2)
    offset = vertex_normals(middle, faces) * half_mm
    rim = np.arange(len(middle) - segments, len(middle))
    wall = quads(rim, np.roll(rim, -1), rim + len(middle), np.roll(rim, -1) + len(middle))
    closed = np.concatenate([faces, faces[:, ::-1] + len(middle), wall[:, ::-1]])
    return np.concatenate([middle + offset, middle - offset]), closed


def disc_mesh(surface: Surface, rings: int, segments: int) -> tuple[Vectors, Triangles]:
    """Triangulate a disc: points (1 + rings * segments, 3), the edge last; faces turned to +z."""
    radius = np.repeat(np.arange(1, rings + 1) / rings, segments)
    angle = np.tile(_turn(segments, segments), rings)
    points = surface(np.append(0.0, radius), np.append(0.0, angle))
    ring = 1 + np.arange(rings * segments).reshape(rings, segments)
    turned = np.roll(ring, -1, axis=1)
    fan = np.stack([np.zeros(segments, dtype=np.int64), ring[0], turned[0]], axis=1)
    bands = quads(ring[:-1].ravel(), ring[1:].ravel(), turned[:-1].ravel(), turned[1:].ravel())
    return points, np.concatenate([fan, bands])


def tube_mesh(
    boundary: Boundary, wire_diameter_mm: float, segments: int, sides: int
) -> tuple[Vectors, Triangles]:
    """Wrap a closed tube around the boundary; each ring has a vertex as high as it can be.

    Raises
    ------
    InputError
        When the boundary stands upright somewhere: up is then no direction across the wire.
    """
    angle = _turn(segments, segments)
    up, across = _frame(boundary, angle)
    around = _turn(sides, sides)
    # Exact zeros and ones at the quarter turns: the height is then the centreline's plus the wire.
    cosine, sine = np.round(np.cos(around), 15), np.round(np.sin(around), 15)
    spoke = cosine[None, :, None] * up[:, None] + sine[None, :, None] * across[:, None]
    points = boundary(angle)[:, None] + wire_diameter_mm / 2 * spoke
    ring = np.arange(segments * sides).reshape(segments, sides)
    onward, aside = np.roll(ring, -1, axis=0), np.roll(ring, -1, axis=1)
    corner = np.roll(onward, -1, axis=1)
    return points.reshape(-1, 3), quads(
        ring.ravel(), onward.ravel(), aside.ravel(), corner.ravel()
    )[:, ::-1]


def _frame(boundary: Boundary, angle: Vectors) -> tuple[Vectors, Vectors]:
    step = 1e-4
    tangent = boundary(angle + step) - boundary(angle - step)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    up = np.array([0.0, 0.0, 1.0]) - tangent[:, 2:] * tangent
    length = np.linalg.norm(up, axis=1, keepdims=True)
    if length.min() < 1e-3:
        place = np.rad2deg(angle[int(np.argmin(length))])
        raise InputError(f"the wire stands upright at {place:.0f}° around its loop")
    return up / length, np.cross(tangent, up / length)


def quads(a: Triangles, b: Triangles, c: Triangles, d: Triangles) -> Triangles:
    """Two triangles each for the quadrilaterals a-b-d-c."""
    return np.concatenate([np.stack([a, b, d], axis=1), np.stack([a, d, c], axis=1)])


def _manifold(points: Vectors, faces: Triangles) -> Manifold:
    # Plain copies: the binding takes no subclass of ndarray, such as trimesh holds.
    return Manifold(
        Mesh64(np.array(points, dtype=np.float64), np.array(faces, dtype=np.uint64, order="C"))
    )


def _union(parts: list[Manifold]) -> Manifold:
    return Manifold.batch_boolean(parts, OpType.Add)
