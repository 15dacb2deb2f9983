"""How near a solved mesh comes to itself, and where it passes through itself.

This needs no library: every answer on a mesh is looked at so.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from solver.mesh.faces import area
from solver.mesh.segments import on_both_sides, pierces, segment_distance, segment_triangle_distance
from solver.mesh.triangulation import Mesh, embedded

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]
Flags = NDArray[np.bool_]

NEIGHBOURS = 0.3
"""Parts that are nearer than this when flat, over the half-width of the narrowest loop, are no
measure of how near the shape comes to itself."""

LOOKED = 0.1
"""How far is looked for the nearest pair, in units of R."""


@dataclass(frozen=True, slots=True)
class SelfContact:
    """How near a shape comes to itself, in units of R.

    Attributes
    ----------
    wire_to_wire : float
        Smallest distance of centrelines, neighbours when flat left out; infinite when it is further
        than was looked.
    wire_to_fabric : float
        The same of wires and fabric; 0 where a wire passes through.
    crossings : int
        Pairs of an edge and a triangle, neighbours or not, of which one passes through the other.
    """

    wire_to_wire: float
    wire_to_fabric: float
    crossings: int


@dataclass(frozen=True)
class _Parts:
    """Elements given by their vertices (m, a), as they are now and as they lie flat."""

    vertices: Indices
    now: Vectors
    flat: Vectors

    @property
    def middles(self) -> Vectors:
        return self.now.mean(axis=1)

    @property
    def radius(self) -> float:
        """Of the smallest ball about its middle that holds any of them."""
        arms = self.now - self.middles[:, None]
        return float(np.linalg.norm(arms, axis=2).max(initial=0.0))


def _parts(vertices: Indices, mesh: Mesh, positions: Vectors) -> _Parts:
    flat = embedded(mesh.points)
    return _Parts(vertices, positions[vertices], flat[vertices])


def _pairs(one: _Parts, other: _Parts, within: float) -> tuple[Indices, Indices]:
    """Pairs that may be within a distance of each other."""
    reach = within + one.radius + other.radius
    near = cKDTree(one.middles).sparse_distance_matrix(
        cKDTree(other.middles), reach, output_type="ndarray"
    )
    return near["i"], near["j"]


def _apart(one: _Parts, i: Indices, other: _Parts, j: Indices) -> Flags:
    """Whether pairs share no vertex."""
    return (one.vertices[i][:, :, None] != other.vertices[j][:, None, :]).all(axis=(1, 2))


def mesh_edges(triangles: Indices) -> Indices:
    """Vertices (e, 2) at the ends of each side of triangles, once each."""
    sides = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    return np.unique(np.sort(sides, axis=1), axis=0)


def _smallest(
    one: _Parts,
    other: _Parts,
    near: float,
    within: float,
    distance: Callable[[Vectors, Vectors], Vectors],
) -> float:
    """Smallest distance of pairs that lie further apart than ``near`` when flat."""
    i, j = _pairs(one, other, within)
    far = distance(one.flat[i], other.flat[j]) > near
    found = distance(one.now[i[far]], other.now[j[far]])
    smallest = float(found.min(initial=np.inf))
    return smallest if smallest <= within else math.inf


def _wire_distance(one: Vectors, other: Vectors) -> Vectors:
    return segment_distance(one[:, 0], one[:, 1], other[:, 0], other[:, 1])


def _fabric_distance(wire: Vectors, triangles: Vectors) -> Vectors:
    return segment_triangle_distance(wire[:, 0], wire[:, 1], triangles)


def crossings(mesh: Mesh, positions: Vectors) -> int:
    """Number of pairs of an edge and a triangle of which one passes through the other."""
    edges = _parts(mesh_edges(mesh.triangles), mesh, positions)
    triangles = _parts(mesh.triangles, mesh, positions)
    i, j = _pairs(edges, triangles, 0.0)
    start, end = edges.now[:, 0], edges.now[:, 1]
    through = on_both_sides(start[i], end[i], triangles.now[j])
    i, j = i[through], j[through]
    apart = _apart(edges, i, triangles, j)
    i, j = i[apart], j[apart]
    return int(np.sum(pierces(start[i], end[i], triangles.now[j])))


def _half_width(mesh: Mesh) -> float:
    """Of the narrowest closed wire, twice its area over its length; of open wires, length / 2π."""
    lengths, widths = [], []
    for wire in mesh.wires:
        ends = mesh.points[wire.edges]
        lengths.append(float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum()))
        if wire.closed:
            widths.append(2 * abs(area(mesh.points, wire.vertices)) / lengths[-1])
    return min(widths) if widths else float(np.mean(lengths)) / (2 * math.pi)


def self_contact(mesh: Mesh, positions: Vectors, within: float = LOOKED) -> SelfContact:
    """Measure how near a mesh at positions (n, 3) comes to itself, as far as ``within``."""
    near = NEIGHBOURS * _half_width(mesh)
    wires = _parts(np.concatenate([wire.edges for wire in mesh.wires]), mesh, positions)
    triangles = _parts(mesh.triangles, mesh, positions)
    return SelfContact(
        wire_to_wire=_smallest(wires, wires, near, within, _wire_distance),
        wire_to_fabric=_smallest(wires, triangles, near, within, _fabric_distance),
        crossings=crossings(mesh, positions),
    )
