"""From values of triangles to values at the vertices of a mesh."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.mesh.triangulation import Mesh

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]


def at_vertices(mesh: Mesh, values: Vectors) -> Vectors:
    """Fit a plane to the values (m,) of the triangles around each vertex, and read it there, (n,).

    Strains jump from triangle to triangle, and are best in the middle of each; a mean of them would
    be wrong at an edge, where all lie to one side (Zienkiewicz and Zhu, Int. J. Numer. Methods Eng.
    33 (1992) 1331). Two rings of triangles count, so that there are enough at the edge, but none
    beyond a wire; on a wire between two pieces of fabric the value is the mean of theirs. Vertices
    without fabric get 0.
    """
    total, count = np.zeros(len(mesh.points)), np.zeros(len(mesh.points))
    for region in np.unique(mesh.region):
        own = mesh.region == region
        used, local = np.unique(mesh.triangles[own], return_inverse=True)
        fitted = _fitted(mesh.points[used], local.reshape(-1, 3), mesh.areas[own], values[own])
        total[used] += fitted
        count[used] += 1
    return total / np.maximum(count, 1)


def _fitted(points: Vectors, triangles: Indices, areas: Vectors, values: Vectors) -> Vectors:
    middle = points[triangles].mean(axis=1)
    terms = np.column_stack([np.ones(len(middle)), middle])
    moments = areas[:, None, None] * terms[:, :, None] * terms[:, None, :]
    sums = np.concatenate([moments.reshape(-1, 9), (areas * values)[:, None] * terms], axis=1)
    near = _summed(len(points), triangles, sums)
    around = _summed(len(points), triangles, near[triangles].sum(axis=1))
    left, right = around[:, :9].reshape(-1, 3, 3), around[:, 9:]
    plane = (np.linalg.pinv(left, rcond=1e-10, hermitian=True) @ right[..., None])[..., 0]
    return np.sum(plane * np.column_stack([np.ones(len(points)), points]), axis=1)


def _summed(count: int, triangles: Indices, values: Vectors) -> Vectors:
    """Sum values (m, k) of triangles at their vertices, (count, k)."""
    out = np.zeros((count, values.shape[1]))
    np.add.at(out, triangles.ravel(), np.repeat(values, 3, axis=0))
    return out
