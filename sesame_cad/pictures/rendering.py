"""A small renderer for equal loops: one is drawn with its depths, and copied to every centre."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sesame_cad.solids import Surface, tube_mesh

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]

SAMPLES_PER_PIXEL = 3
"""Along each axis; the picture is averaged down at the end, which smooths its edges."""

_LIGHT = np.array([-0.35, -0.30, 0.89])
_AMBIENT, _GLOSS = 0.42, 0.18
_RINGS, _SPOKES, _SIDES = 33, 193, 12


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
class _Sprite:
    """Samples of one loop: row (up), column, depth in mm, colour."""

    row: Indices
    column: Indices
    depth: Vectors
    colour: Vectors


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
    points, _ = tube_mesh(
        lambda angle: surface(np.ones_like(angle), angle), wire_diameter_mm, _SPOKES - 1, _SIDES
    )
    grid = points.reshape(_SPOKES - 1, _SIDES, 3)
    normals = _unit(grid - grid.mean(axis=1, keepdims=True))
    return Patch(_closed(grid), _closed(normals), colour)


def projected_bounds(
    patches: list[Patch], centres_mm: Vectors, view: View
) -> tuple[Vectors, Vectors]:
    """Lowest and highest (right, up) coordinates in mm over all copies of a loop."""
    flat = np.concatenate([patch.points.reshape(-1, 3) for patch in patches]) @ view.axes()[:2].T
    moved = centres_mm @ view.axes()[:2, :2].T
    return flat.min(axis=0) + moved.min(axis=0), flat.max(axis=0) + moved.max(axis=0)


def render(
    patches: list[Patch],
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
    step_mm = mm_per_pixel / SAMPLES_PER_PIXEL
    rows, columns = size[0] * SAMPLES_PER_PIXEL, size[1] * SAMPLES_PER_PIXEL
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
    fine = image.reshape(size[0], SAMPLES_PER_PIXEL, size[1], SAMPLES_PER_PIXEL, 3)
    return fine.mean(axis=(1, 3), dtype=np.float64)[::-1]


def _sprite(patches: list[Patch], view: View, step_mm: float) -> _Sprite:
    """Sample the patches densely and keep the nearest sample of every place."""
    parts = [_samples(patch, view, step_mm) for patch in patches]
    place = np.concatenate([np.rint(seen[:, :2] / step_mm).astype(np.int64) for seen, _ in parts])
    depth = np.concatenate([seen[:, 2] for seen, _ in parts])
    colour = np.concatenate([colour for _, colour in parts])
    low = place.min(axis=0)
    columns = int(np.ptp(place[:, 0])) + 1
    key = (place[:, 1] - low[1]) * columns + place[:, 0] - low[0]
    nearest = np.full(int(key.max()) + 1, -np.inf)
    np.maximum.at(nearest, key, depth)
    kept = np.flatnonzero(depth == nearest[key])
    return _Sprite(place[kept, 1], place[kept, 0], depth[kept], colour[kept])


def _samples(patch: Patch, view: View, step_mm: float) -> tuple[Vectors, Vectors]:
    """Seen coordinates (n, 3) and colours (n, 3) of samples less than one step apart."""
    axes = view.axes()
    both = np.concatenate([patch.points @ axes.T, patch.normals @ axes.T], axis=2)
    fine = _refined(_refined(both, step_mm).swapaxes(0, 1), step_mm).reshape(-1, 6)
    return fine[:, :3], _shade(_unit(fine[:, 3:]), axes @ _LIGHT, patch.colour)


def _refined(grid: Vectors, step_mm: float) -> Vectors:
    """Interpolate along the first axis until steps as seen are shorter than asked for."""
    longest = np.hypot(*np.moveaxis(np.diff(grid[..., :2], axis=0), -1, 0)).max()
    pieces = max(1, int(np.ceil(1.3 * longest / step_mm)))
    share = np.arange(pieces)[None, :, None, None] / pieces
    between = grid[:-1, None] * (1 - share) + grid[1:, None] * share
    return np.concatenate([between.reshape(-1, *grid.shape[1:]), grid[-1:]])


def _shade(normal: Vectors, light: Vectors, colour: Vectors) -> Vectors:
    """Light matt colour and a soft gloss; both sides of the fabric are lit alike."""
    facing = normal * np.where(normal[:, 2:] < 0, -1.0, 1.0)
    matt = np.clip(facing @ light, 0, 1)[:, None]
    halfway = _unit(light + np.array([0.0, 0.0, 1.0]))
    gloss = _GLOSS * np.clip(facing @ halfway, 0, 1)[:, None] ** 24
    return np.clip(colour * (_AMBIENT + (1 - _AMBIENT) * matt) + gloss, 0, 1)


def _closed(grid: Vectors) -> Vectors:
    """Repeat the first row and column at the end."""
    return np.pad(grid, ((0, 1), (0, 1), (0, 0)), mode="wrap")


def _unit(vectors: Vectors) -> Vectors:
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
