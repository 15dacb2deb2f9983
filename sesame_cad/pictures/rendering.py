"""A small renderer for equal loops: one is drawn with its depths, and copied to every centre."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from sesame_cad.sheet_shape import Piece
from sesame_cad.sheet_solid import around
from sesame_cad.solids import Boundary, Surface, tube_mesh
from sesame_cad.watertight import vertex_normals

Vectors = NDArray[np.float64]
Floats = NDArray[np.float32]
Indices = NDArray[np.int64]
AnyFloat = TypeVar("AnyFloat", np.float32, np.float64)

FEW_LOOPS, FEW_SAMPLES, MANY_SAMPLES = 4, 2, 3
"""Samples along each side of a pixel: averaged, they smooth the edges. Few loops are drawn large,
and their wires need less of it."""

_LIGHT = np.array([-0.35, -0.30, 0.89])
_AMBIENT, _GLOSS = 0.42, 0.18
_RINGS, _SPOKES, _SIDES = 33, 193, 12
_BAND = 8
_MOST_SAMPLES = 2_000_000


@dataclass(frozen=True)
class View:
    """A parallel view.

    Attributes
    ----------
    azimuth_deg, elevation_deg : float
        Where the eye is.
    """

    azimuth_deg: float = -60.0
    elevation_deg: float = 32.0

    def axes(self) -> Vectors:
        """Right, up and toward the eye: three rows."""
        a, e = np.deg2rad(self.azimuth_deg), np.deg2rad(self.elevation_deg)
        toward = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
        right = np.array([-np.sin(a), np.cos(a), 0.0])
        return np.stack([right, np.cross(toward, right), toward])


@dataclass(frozen=True)
class Patch:
    """A grid of points (m, n, 3) in mm with normals, and its colour (3,) in 0..1."""

    points: Vectors
    normals: Vectors
    colour: Vectors


@dataclass(frozen=True)
class TrianglePatch:
    """Triangles (m, 3) of points (n, 3) in mm with normals, and their colour (3,) in 0..1."""

    points: Vectors
    normals: Vectors
    triangles: Indices
    colour: Vectors


AnyPatch = Patch | TrianglePatch


@dataclass(frozen=True)
class _Sprite:
    """Pixels of one loop: row (up) and column from its origin, depth in mm, colour."""

    row: Indices
    column: Indices
    depth: Floats
    colour: Floats


def fabric_patch(surface: Surface, colour: Vectors) -> Patch:
    """Grid a loop's fabric."""
    # The centre itself has no direction around it.
    radius, angle = np.linspace(1e-3, 1, _RINGS), np.linspace(0, 2 * np.pi, _SPOKES)
    r, a = np.meshgrid(radius, angle, indexing="ij")
    points = surface(r.ravel(), a.ravel()).reshape(_RINGS, _SPOKES, 3)
    outward = np.gradient(points, axis=0, edge_order=2)
    around = np.gradient(points, axis=1, edge_order=2)
    return Patch(points, _unit(np.cross(outward, around)), colour)


def wire_patch(surface: Surface, wire_diameter_mm: float, colour: Vectors) -> Patch:
    """Grid the tube of wire around a loop."""

    def edge(angle_rad: Vectors) -> Vectors:
        return surface(np.ones_like(angle_rad), angle_rad)

    return _tube(edge, wire_diameter_mm, _SPOKES - 1, colour)


def chain_patch(chain: Vectors, wire_diameter_mm: float, colour: Vectors) -> Patch:
    """Grid the tube of wire along a closed chain (n, 3)."""
    return _tube(around(chain), wire_diameter_mm, len(chain), colour)


def piece_patch(piece: Piece, colour: Vectors) -> TrianglePatch:
    """Triangles of a piece of fabric."""
    return TrianglePatch(
        piece.points, vertex_normals(piece.points, piece.faces), piece.faces, colour
    )


def solid_patch(points: Vectors, faces: Indices, colour: Vectors) -> TrianglePatch:
    """Triangles of a solid with sharp edges, each with its own normal."""
    corners = points[faces]
    normal = _unit(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
    own = np.arange(3 * len(faces), dtype=np.int64).reshape(-1, 3)
    return TrianglePatch(corners.reshape(-1, 3), np.repeat(normal, 3, axis=0), own, colour)


def _tube(boundary: Boundary, wire_diameter_mm: float, spokes: int, colour: Vectors) -> Patch:
    points, _ = tube_mesh(boundary, wire_diameter_mm, spokes, _SIDES)
    grid = points.reshape(spokes, _SIDES, 3)
    normals = _unit(grid - grid.mean(axis=1, keepdims=True))
    return Patch(_closed(grid), _closed(normals), colour)


def projected_bounds(
    patches: Sequence[AnyPatch], centres_mm: Vectors, view: View
) -> tuple[Vectors, Vectors]:
    """Lowest and highest (right, up) coordinates in mm over all copies of a loop."""
    flat = np.concatenate([patch.points.reshape(-1, 3) for patch in patches]) @ view.axes()[:2].T
    moved = centres_mm @ view.axes()[:2, :2].T
    return flat.min(axis=0) + moved.min(axis=0), flat.max(axis=0) + moved.max(axis=0)


def render(
    patches: Sequence[AnyPatch],
    centres_mm: Vectors,
    view: View,
    *,
    corner_mm: Vectors,
    mm_per_pixel: float,
    size: tuple[int, int],
) -> Vectors:
    """Draw copies of a loop.

    Parameters
    ----------
    corner_mm : array, shape (2,)
        Lower left corner of the picture in the view's (right, up) coordinates.
    size : tuple of int
        Rows and columns in pixels.

    Returns
    -------
    array, shape (rows, columns, 3)
        Colours in 0..1 on white, top row first.
    """
    samples = FEW_SAMPLES if len(centres_mm) <= FEW_LOOPS else MANY_SAMPLES
    step_mm = mm_per_pixel / samples
    rows, columns = size[0] * samples, size[1] * samples
    sprite = _sprite(patches, view, step_mm)
    depth = np.full(rows * columns, -np.inf)
    image = np.ones((rows * columns, 3), dtype=np.float32)
    for right, up, toward in np.pad(centres_mm, ((0, 0), (0, 1))) @ view.axes().T:
        row = sprite.row + round((up - corner_mm[1]) / step_mm)
        column = sprite.column + round((right - corner_mm[0]) / step_mm)
        inside = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
        place, nearer = row[inside] * columns + column[inside], sprite.depth[inside] + toward
        front = nearer > depth[place]
        depth[place[front]] = nearer[front]
        image[place[front]] = sprite.colour[inside][front]
    fine = image.reshape(size[0], samples, size[1], samples, 3)
    return fine.mean(axis=(1, 3), dtype=np.float64)[::-1]


def _sprite(patches: Sequence[AnyPatch], view: View, step_mm: float) -> _Sprite:
    """Sample the patches densely and keep the nearest sample of every pixel."""
    low, high = projected_bounds(patches, np.zeros((1, 2)), view)
    first = np.rint(low / step_mm).astype(np.int64) - 1
    columns, rows = np.rint(high / step_mm).astype(np.int64) - first + 2
    depth = np.full(rows * columns, -np.inf, dtype=np.float32)
    colour = np.zeros((rows * columns, 3), dtype=np.float32)
    for patch in patches:
        for sample in _samples(patch, view, step_mm):
            column, row = (np.rint(sample[:, k] / step_mm).astype(np.int64) for k in (0, 1))
            pixel = (row - first[1]) * columns + column - first[0]
            np.maximum.at(depth, pixel, sample[:, 2])
            front = np.flatnonzero(sample[:, 2] == depth[pixel])
            normal = _unit(sample[front, 3:])
            colour[pixel[front]] = _shade(normal, view.axes() @ _LIGHT, patch.colour)
    filled = np.flatnonzero(np.isfinite(depth))
    row, column = np.divmod(filled, columns)
    return _Sprite(row + first[1], column + first[0], depth[filled], colour[filled])


def _samples(patch: AnyPatch, view: View, step_mm: float) -> Iterator[Floats]:
    """Seen coordinates and normals (n, 6) of samples less than one step apart, band by band."""
    axes = view.axes()
    if isinstance(patch, TrianglePatch):
        yield from _triangle_samples(patch, axes, step_mm)
        return
    both = np.concatenate([patch.points @ axes.T, patch.normals @ axes.T], axis=2)
    both = both.astype(np.float32)
    # Bands, because the inner ones need fewer samples around, and to keep the memory small.
    for start in range(0, len(both) - 1, _BAND):
        band = both[start : start + _BAND + 1]
        yield _refined(_refined(band, step_mm).swapaxes(0, 1), step_mm).reshape(-1, 6)


def _triangle_samples(patch: TrianglePatch, axes: Vectors, step_mm: float) -> Iterator[Floats]:
    """Sample triangles in equal parts of their sides, those of a size together."""
    both = np.concatenate([patch.points @ axes.T, patch.normals @ axes.T], axis=1)
    corners = both.astype(np.float32)[patch.triangles]
    sides = np.roll(corners, -1, axis=1)[..., :2] - corners[..., :2]
    longest = np.hypot(sides[..., 0], sides[..., 1]).max(axis=1)
    pieces = np.maximum(1, np.ceil(1.2 * longest / step_mm).astype(np.int64))
    for count in np.unique(pieces):
        i, j = np.indices((count + 1, count + 1)).reshape(2, -1)
        i, j = i[i + j <= count], j[i + j <= count]
        shares = np.stack([i, j, count - i - j], axis=1).astype(np.float32) / np.float32(count)
        own = np.flatnonzero(pieces == count)
        for few in np.array_split(own, np.ceil(len(own) * len(shares) / _MOST_SAMPLES)):
            yield np.einsum("sc,tck->tsk", shares, corners[few]).reshape(-1, 6)


def _refined(grid: Floats, step_mm: float) -> Floats:
    """Interpolate along the first axis until steps as seen are shorter than asked for."""
    longest = np.hypot(*np.moveaxis(np.diff(grid[..., :2], axis=0), -1, 0)).max()
    pieces = max(1, int(np.ceil(1.2 * longest / step_mm)))
    share = (np.arange(pieces, dtype=np.float32) / pieces)[None, :, None, None]
    between = grid[:-1, None] * (1 - share) + grid[1:, None] * share
    return np.concatenate([between.reshape(-1, *grid.shape[1:]), grid[-1:]], dtype=np.float32)


def _shade(normal: Floats, light: Vectors, colour: Vectors) -> Floats:
    """Light matt colour and a soft gloss; both sides of the fabric are lit alike."""
    facing = normal * np.where(normal[:, 2:] < 0, -1.0, 1.0)
    matt = np.clip(facing @ light, 0, 1)[:, None]
    halfway = _unit(light + np.array([0.0, 0.0, 1.0]))
    gloss = _GLOSS * np.clip(facing @ halfway, 0, 1)[:, None] ** 24
    shaded = np.clip(colour * (_AMBIENT + (1 - _AMBIENT) * matt) + gloss, 0, 1)
    return shaded.astype(np.float32)


def _closed(grid: Vectors) -> Vectors:
    """Repeat the first row and column at the end."""
    return np.pad(grid, ((0, 1), (0, 1), (0, 0)), mode="wrap")


def _unit(vectors: NDArray[AnyFloat]) -> NDArray[AnyFloat]:
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
