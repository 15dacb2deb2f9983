"""How near a solved mesh comes to itself, and where it passes through itself.

This needs no library: every answer on a mesh is looked at so.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property

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

_AT_A_TIME = 1000
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

    @cached_property
    def middles(self) -> Vectors:
        """Middle (m, 3) of each."""
        return self.now.mean(axis=1)

    @cached_property
    def radii(self) -> Vectors:
        """Radius (m,) of the smallest ball about its middle that holds each."""
        return np.linalg.norm(self.now - self.middles[:, None], axis=2).max(axis=1, initial=0.0)

    @cached_property
    def low(self) -> Vectors:
        """Lowest corner (m, 3) of the box about each."""
        return self.now.min(axis=1)

    @cached_property
    def high(self) -> Vectors:
        """Highest corner (m, 3) of the box about each."""
        return self.now.max(axis=1)


def _parts(vertices: Indices, mesh: Mesh, positions: Vectors) -> _Parts:
    flat = embedded(mesh.points)
    return _Parts(vertices, positions[vertices], flat[vertices])


def _pairs(one: _Parts, other: _Parts, within: float) -> Iterator[tuple[Indices, Indices]]:
    """Pairs that may be within a distance of each other, some thousand elements at a time.

    A rolled-up shape has tens of millions of pairs of balls that overlap: their boxes tell most of
    them apart, and no more than a part of them is ever in memory.
    """
    tree = cKDTree(other.middles)
    widest = float(other.radii.max(initial=0.0))
    for start in range(0, len(one.vertices), _AT_A_TIME):
        rows = slice(start, start + _AT_A_TIME)
        reach = within + widest + float(one.radii[rows].max(initial=0.0))
        near = cKDTree(one.middles[rows]).sparse_distance_matrix(tree, reach, output_type="ndarray")
        i, j = start + near["i"], near["j"]
        close = near["v"] <= within + one.radii[i] + other.radii[j]
        i, j = i[close], j[close]
        for axis in range(3):
            apart = np.maximum(
                one.low[i, axis] - other.high[j, axis], other.low[j, axis] - one.high[i, axis]
            )
            close = apart <= within
            i, j = i[close], j[close]
        yield i, j


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
    smallest = math.inf
    for i, j in _pairs(one, other, within):
        far = distance(one.flat[i], other.flat[j]) > near
        found = distance(one.now[i[far]], other.now[j[far]])
        smallest = min(smallest, float(found.min(initial=np.inf)))
    return smallest if smallest <= within else math.inf


def _wire_distance(one: Vectors, other: Vectors) -> Vectors:
    return segment_distance(one[:, 0], one[:, 1], other[:, 0], other[:, 1])


def _fabric_distance(wire: Vectors, triangles: Vectors) -> Vectors:
    return segment_triangle_distance(wire[:, 0], wire[:, 1], triangles)


def crossings(mesh: Mesh, positions: Vectors) -> int:
    """Number of pairs of an edge and a triangle of which one passes through the other."""
    edges = _parts(mesh_edges(mesh.triangles), mesh, positions)
    triangles = _parts(mesh.triangles, mesh, positions)
    start, end = edges.now[:, 0], edges.now[:, 1]
    count = 0
    for near in _pairs(edges, triangles, 0.0):
        apart = _apart(edges, near[0], triangles, near[1])
        i, j = near[0][apart], near[1][apart]
        through = on_both_sides(start[i], end[i], triangles.now[j])
        i, j = i[through], j[through]
        count += int(np.sum(pierces(start[i], end[i], triangles.now[j])))
    return count


def _half_width(mesh: Mesh) -> float:
    """Of the narrowest closed wire, twice its area over its length; of open wires, length / 2π."""
    lengths, widths = [], []
    for wire in mesh.wires:
        ends = mesh.points[wire.edges]
        lengths.append(float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum()))
        if wire.closed:
            widths.append(2 * abs(area(mesh.points, wire.vertices)) / lengths[-1])
    return min(widths) if widths else float(np.mean(lengths)) / (2 * math.pi)


def self_contact(
    mesh: Mesh, positions: Vectors, within: float = LOOKED, neighbours: float = 0.0
) -> SelfContact:
    """Measure how near a mesh at positions (n, 3) comes to itself, as far as ``within``.

    Parts that lie nearer than ``neighbours`` when flat, in units of R, are left out too.
    """
    near = max(neighbours, NEIGHBOURS * _half_width(mesh))
    wires = _parts(np.concatenate([wire.edges for wire in mesh.wires]), mesh, positions)
    triangles = _parts(mesh.triangles, mesh, positions)
    return SelfContact(
        wire_to_wire=_smallest(wires, wires, near, within, _wire_distance),
        wire_to_fabric=_smallest(wires, triangles, near, within, _fabric_distance),
        crossings=crossings(mesh, positions),
    )
