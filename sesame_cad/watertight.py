"""From a union of solids to a mesh that stays watertight in a file of 32-bit floats."""

from __future__ import annotations

import numpy as np
import trimesh
from manifold3d import Error, Manifold
from numpy.typing import NDArray
from trimesh.graph import connected_component_labels

from sesame_cad.errors import InputError

Vectors = NDArray[np.float64]
Triangles = NDArray[np.int64]

MESH_TOLERANCE_MM = 1e-3
"""Detail below this is merged: far under any printer, far over the spacing of float32 at 1 m."""

WELD_GRIDS_MM = tuple(2.0**-k for k in range(20, 11, -2))
"""Coordinates are rounded to the finest of these that leaves no two surfaces touching."""

SPECK_SHARE = 1e-4
"""Bodies with less than this share of the largest one's volume are left out."""

PART_MM = 2e-3
"""Surfaces that touch along an edge are drawn back from each other by this."""

MOST_PARTINGS = 6


def watertight(solid: Manifold) -> trimesh.Trimesh:
    """Give a solid as a mesh in which each edge has two faces, also in a file of 32-bit floats.

    Raises
    ------
    InputError
        When the solid is none, or cannot be freed from touching itself.
    """
    if solid.status() != Error.NoError:
        raise InputError(f"the surface does not close to a solid: {solid.status().name}")
    mesh = solid.simplify(MESH_TOLERANCE_MM).to_mesh64()
    points, faces = np.array(mesh.vert_properties[:, :3]), mesh.tri_verts.astype(np.int64)
    for _ in range(MOST_PARTINGS):
        for grid_mm in WELD_GRIDS_MM:
            welded, kept = _weld(points, faces, grid_mm)
            if _is_closed(kept):
                return _without_specks(welded, kept)
        points = _parted(points, faces)
    raise InputError("the solid touches itself along an edge: change the segments or the sides")


def _parted(points: Vectors, faces: Triangles) -> Vectors:
    """Draw surfaces back from each other where they share an edge but no face.

    There the solid's own vertices are distinct and lie in one place: each goes inward.
    """
    where = _row_numbers(_coarse(points, WELD_GRIDS_MM[0]))
    edges = np.sort(where[faces][:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    number = _row_numbers(edges)
    shared = np.unique(edges[np.bincount(number)[number] > 2])
    touching = np.isin(where, shared)
    moved = points.copy()
    moved[touching] -= PART_MM * vertex_normals(points, faces)[touching]
    return moved


def _without_specks(points: Vectors, faces: Triangles) -> trimesh.Trimesh:
    """Keep the bodies; crumbs and hollows where wires all but coincide have no size to speak of."""
    mesh = trimesh.Trimesh(points, faces, process=False)
    body = connected_component_labels(mesh.face_adjacency, node_count=len(faces))
    a, b, c = (points[faces[:, k]] for k in range(3))
    volume = np.bincount(body, weights=np.sum(a * np.cross(b, c), axis=1)) / 6
    kept = faces[(volume > SPECK_SHARE * volume.max())[body]]
    used = np.unique(kept)
    return trimesh.Trimesh(points[used], np.searchsorted(used, kept), process=False)


def _is_closed(faces: Triangles) -> bool:
    """Whether every edge belongs to two triangles."""
    edges = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    return bool(np.all(np.bincount(_row_numbers(edges)) == 2))


def _weld(points: Vectors, faces: Triangles, grid_mm: float) -> tuple[Vectors, Triangles]:
    """Merge the points that a file of 32-bit floats cannot tell apart."""
    coarse = _coarse(points, grid_mm)
    where = _row_numbers(coarse)
    welded = np.empty((where.max() + 1, 3))
    welded[where] = coarse
    faces = where[faces]
    a, b, c = faces.T
    return welded, _without_fins(faces[(a != b) & (b != c) & (c != a)])


def _coarse(points: Vectors, grid_mm: float) -> NDArray[np.float32]:
    # The grid keeps values next to zero, where floats lie dense, from being told apart either;
    # adding zero turns -0 into 0.
    return (np.round(points / grid_mm) * grid_mm + 0.0).astype(np.float32)


def _without_fins(faces: Triangles) -> Triangles:
    """Drop triangles that lie back to back: solid or gap without a thickness."""
    which = _row_numbers(np.sort(faces, axis=1))
    return faces[np.bincount(which)[which] == 1]


def _row_numbers(rows: NDArray[np.number]) -> Triangles:
    """Number the rows in rising order, equal rows alike: `numpy.unique` takes ten times as long."""
    order = np.lexsort(rows.T[::-1])
    risen = np.any(np.diff(rows[order], axis=0) != 0, axis=1)
    number = np.zeros(len(rows), dtype=np.int64)
    number[order[1:]] = np.cumsum(risen)
    return number


def vertex_normals(points: Vectors, faces: Triangles) -> Vectors:
    """Unit normals (n, 3) of vertices, the mean of their faces' weighted by area."""
    a, b, c = (points[faces[:, k]] for k in range(3))
    weighted = np.cross(b - a, c - a)
    normal = np.zeros_like(points)
    for k in range(3):
        np.add.at(normal, faces[:, k], weighted)
    return normal / np.linalg.norm(normal, axis=1, keepdims=True)
