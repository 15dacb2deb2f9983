"""A mesh's fabric as a Surface Evolver datafile says it: edges, faces and their rest shape."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.mesh.triangulation import Mesh

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True)
class Sides:
    """Edges (e, 2) of a mesh, and the signed numbers (m, 3), from 1, of each triangle's sides."""

    edges: Indices
    of_triangle: Indices


def mesh_sides(mesh: Mesh) -> Sides:
    """Number a mesh's edges, and those of its wires beside which there is no fabric."""
    corners = mesh.triangles
    around = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2)
    ends = np.concatenate([around, *(wire.edges for wire in mesh.wires)])
    edges, number = np.unique(np.sort(ends, axis=1), axis=0, return_inverse=True)
    forwards = np.where(around[:, 0] < around[:, 1], 1, -1)
    of_triangle = forwards * (1 + number.reshape(-1)[: len(around)])
    return Sides(edges, of_triangle.reshape(-1, 3))


def inner_vertices(mesh: Mesh) -> set[int]:
    """Vertices with fabric all round."""
    sides = mesh_sides(mesh)
    beside = np.abs(sides.of_triangle).ravel() - 1
    border = sides.edges[np.bincount(beside, minlength=len(sides.edges)) == 1]
    return set(mesh.triangles.ravel().tolist()) - set(border.ravel().tolist())


def form_factors(mesh: Mesh, strain: float) -> Vectors:
    """Products (m, 3) u·u, u·v, v·v of the sides u, v of each unstretched triangle at its corner.

    The unstretched state is the flat one, smaller by 1/(1+ε).
    """
    u, v = ((mesh.points[mesh.triangles[:, k]] - mesh.corner) / (1 + strain) for k in (1, 2))
    return np.stack([np.sum(a * b, axis=1) for a, b in ((u, u), (u, v), (v, v))], axis=1)
