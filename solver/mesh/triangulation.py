"""Triangulated fabric with wires along chains of its edges, and its red refinement."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from solver.errors import SceneError

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]

GAP = -1
"""Region of triangles that lie in no loop."""


@dataclass(frozen=True)
class Wire:
    """A wire along the edges from each vertex to the next, back to the first when closed."""

    vertices: Indices
    closed: bool = True

    @property
    def edges(self) -> Indices:
        """Vertices (e, 2) at the ends of each edge, in the wire's order."""
        following = np.roll(self.vertices, -1)
        edges = np.stack([self.vertices, following], axis=1)
        return edges if self.closed else edges[:-1]

    @property
    def corners(self) -> Indices:
        """Vertices (c, 3) before, at and after each vertex at which the wire can bend."""
        before, after = np.roll(self.vertices, 1), np.roll(self.vertices, -1)
        corners = np.stack([before, self.vertices, after], axis=1)
        return corners if self.closed else corners[1:-1]

    def midway(self, values: Vectors) -> Vectors:
        """Values (e, d) in the middle of each edge from those at all vertices, by cubics.

        A wire's bending would feel the kinks of a linear interpolation.
        """
        along = values[self.vertices]
        if self.closed:
            before, after = np.roll(along, 1, axis=0), np.roll(along, -1, axis=0)
            return (9 * (along + after) - before - np.roll(along, -2, axis=0)) / 16
        if len(along) < 4:
            return (along[:-1] + along[1:]) / 2
        inner = (9 * (along[1:-2] + along[2:-1]) - along[:-3] - along[3:]) / 16
        first = (5 * along[:1] + 15 * along[1:2] - 5 * along[2:3] + along[3:4]) / 16
        last = (5 * along[-1:] + 15 * along[-2:-1] - 5 * along[-3:-2] + along[-4:-3]) / 16
        return np.concatenate([first, inner, last])


@dataclass(frozen=True)
class RoundRegion:
    """A flat loop: an ellipse with its axes along x and y.

    Refinement keeps the image of every vertex in the unit disc at the mean radius of the two it
    lies between, so that the edge's vertices stay on the ellipse.
    """

    centre: tuple[float, float] = (0.0, 0.0)
    semi_axes: tuple[float, float] = (1.0, 1.0)

    def between(self, one: Vectors, other: Vectors) -> Vectors:
        """Points (n, 2) between two rows of points (n, 2)."""
        a, b = (one - self.centre) / self.semi_axes, (other - self.centre) / self.semi_axes
        middle = (a + b) / 2
        length = np.linalg.norm(middle, axis=1)
        wanted = (np.linalg.norm(a, axis=1) + np.linalg.norm(b, axis=1)) / 2
        scale = np.where(length > 1e-12, wanted / np.maximum(length, 1e-12), 1.0)
        return self.centre + middle * scale[:, None] * self.semi_axes


@dataclass(frozen=True)
class Mesh:
    """Fabric and wires as they lie flat and stretched, lengths in units of R.

    Attributes
    ----------
    points : array (n, 2)
    triangles : array (m, 3)
        Vertices, counterclockwise.
    region : array (m,)
        Index into ``rounds`` of the loop in which a triangle lies, or `GAP`.
    rounds : tuple of RoundRegion
    wires : tuple of Wire
    parents : array (n, 2)
        Vertices of the mesh this one was refined from, between which each vertex was put; twice the
        same for a vertex that was there before. A mesh that was not refined is its own parent.
    """

    points: Vectors
    triangles: Indices
    region: Indices
    rounds: tuple[RoundRegion, ...]
    wires: tuple[Wire, ...]
    parents: Indices

    @cached_property
    def areas(self) -> Vectors:
        """Flat area (m,) of each triangle."""
        one, other = (self.points[self.triangles[:, k]] - self.corner for k in (1, 2))
        return (one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]) / 2

    @property
    def corner(self) -> Vectors:
        """First point (m, 2) of each triangle."""
        return self.points[self.triangles[:, 0]]

    @cached_property
    def vertex_areas(self) -> Vectors:
        """Share (n,) of the fabric that belongs to each vertex: a third of each triangle."""
        share = np.repeat(self.areas / 3, 3)
        total = np.bincount(self.triangles.ravel(), share, minlength=len(self.points))
        return total.astype(np.float64, copy=False)


def embedded(points: Vectors) -> Vectors:
    """Flat points (n, 2) as positions (n, 3) with z = 0."""
    return np.concatenate([points, np.zeros((len(points), 1))], axis=1)


def unrefined(
    points: Vectors,
    triangles: Indices,
    region: Indices,
    rounds: tuple[RoundRegion, ...],
    wires: tuple[Wire, ...],
) -> Mesh:
    """Make a mesh that is its own parent.

    Raises
    ------
    SceneError
        When a triangle is degenerate or runs clockwise.
    """
    itself = np.repeat(np.arange(len(points))[:, None], 2, axis=1)
    mesh = Mesh(points, triangles, region, rounds, wires, itself)
    if mesh.areas.min() <= 0:
        raise SceneError("a triangle of the mesh has no area or runs clockwise")
    return mesh


class _Midpoints:
    """Numbers for the midpoints of a mesh's edges."""

    def __init__(self, mesh: Mesh) -> None:
        t = mesh.triangles
        sides = np.stack([t, np.roll(t, -1, axis=1)], axis=2).reshape(-1, 2)
        count = len(mesh.points)
        self._count = count
        self._keys, position, of_side = np.unique(
            _edge_keys(sides, count), return_index=True, return_inverse=True
        )
        self.ends = np.sort(sides[position], axis=1)
        self.of_triangle = count + of_side.reshape(-1, 3)
        # an edge between a loop and a gap belongs to the loop
        self.region = np.full(len(self.ends), GAP, dtype=np.int64)
        np.maximum.at(self.region, of_side, np.repeat(mesh.region, 3))

    def of(self, edges: Indices) -> Indices:
        """Number of the midpoint of each edge (e, 2)."""
        return self._count + np.searchsorted(self._keys, _edge_keys(edges, self._count))


def _edge_keys(edges: Indices, count: int) -> Indices:
    return edges.min(axis=1) * count + edges.max(axis=1)


def _placed(mesh: Mesh, midpoints: _Midpoints) -> Vectors:
    """Flat position (e, 2) of each midpoint."""
    one, other = (mesh.points[midpoints.ends[:, k]] for k in (0, 1))
    placed = (one + other) / 2
    for k, region in enumerate(mesh.rounds):
        inside = midpoints.region == k
        placed[inside] = region.between(one[inside], other[inside])
    return placed


def _refined_wire(wire: Wire, midpoints: _Midpoints) -> Wire:
    between = midpoints.of(wire.edges)
    if wire.closed:
        return Wire(np.stack([wire.vertices, between], axis=1).ravel())
    chain = np.empty(2 * len(wire.vertices) - 1, dtype=np.int64)
    chain[::2], chain[1::2] = wire.vertices, between
    return Wire(chain, closed=False)


def refined(mesh: Mesh) -> Mesh:
    """Split every triangle in four; the coarse vertices keep their numbers."""
    midpoints = _Midpoints(mesh)
    i, j, k = mesh.triangles.T
    ij, jk, ki = midpoints.of_triangle.T
    corners = [(i, ij, ki), (ij, j, jk), (ki, jk, k), (ij, jk, ki)]
    triangles = np.stack([np.stack(c, axis=1) for c in corners], axis=1).reshape(-1, 3)
    itself = np.repeat(np.arange(len(mesh.points))[:, None], 2, axis=1)
    return Mesh(
        points=np.concatenate([mesh.points, _placed(mesh, midpoints)]),
        triangles=triangles,
        region=np.repeat(mesh.region, 4),
        rounds=mesh.rounds,
        wires=tuple(_refined_wire(wire, midpoints) for wire in mesh.wires),
        parents=np.concatenate([itself, midpoints.ends]),
    )


def prolonged(coarse: Mesh, fine: Mesh, positions: Vectors) -> Vectors:
    """Positions (N, 3) of a refined mesh's vertices from those (n, 3) of the mesh before it.

    Displacements are interpolated, not positions, so that flat loops stay round: linearly, and
    along the wires by cubics.
    """
    moved = positions - embedded(coarse.points)
    between = moved[fine.parents].mean(axis=1)
    for wire, refined_wire in zip(coarse.wires, fine.wires, strict=True):
        between[refined_wire.vertices[1::2]] = wire.midway(moved)
    return embedded(fine.points) + between


def refinements(coarsest: Mesh, times: int) -> tuple[Mesh, ...]:
    """The mesh and its successive refinements, coarsest first."""
    meshes = [coarsest]
    for _ in range(times):
        meshes.append(refined(meshes[-1]))
    return tuple(meshes)
