"""Triangulated fabric with wires along chains of its edges, and its red refinement."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from solver.errors import SceneError
from solver.mesh.curve import rotation
from solver.mesh.wire import Wire, interleaved

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]

GAP = -1
"""Region of triangles that lie in no loop."""


@dataclass(frozen=True)
class RoundRegion:
    """A flat loop: an ellipse, its first axis turned from x by an angle in radians.

    Refinement keeps the image of every vertex in the unit disc at the mean radius of the two it
    lies between, so that the edge's vertices stay on the ellipse.
    """

    centre: tuple[float, float] = (0.0, 0.0)
    semi_axes: tuple[float, float] = (1.0, 1.0)
    angle: float = 0.0

    def between(self, one: Vectors, other: Vectors) -> Vectors:
        """Points (n, 2) between two rows of points (n, 2)."""
        back, forth = rotation(-self.angle), rotation(self.angle)
        a, b = ((p - self.centre) @ back / self.semi_axes for p in (one, other))
        middle = (a + b) / 2
        length = np.linalg.norm(middle, axis=1)
        wanted = (np.linalg.norm(a, axis=1) + np.linalg.norm(b, axis=1)) / 2
        scale = np.where(length > 1e-12, wanted / np.maximum(length, 1e-12), 1.0)
        return self.centre + middle * scale[:, None] * self.semi_axes @ forth


@dataclass(frozen=True)
class Mesh:
    """Fabric and wires as they lie flat and stretched, lengths in units of R.

    Attributes
    ----------
    points : array (n, 2)
    triangles : array (m, 3)
        Vertices, counterclockwise.
    region : array (m,)
        Index into ``rounds`` of the loop in which a triangle lies, or `GAP`, where new vertices
        are put straight between the old.
    rounds : tuple of RoundRegion
    wires : tuple of Wire
    parents : array (n, 2)
        Vertices of the mesh this one was refined from, between which each vertex was put; twice the
        same for a vertex that was there before. A mesh that was not refined is its own parent.
    borders : tuple of Wire
        Chains along curves that bound fabric without a wire.
    """

    points: Vectors
    triangles: Indices
    region: Indices
    rounds: tuple[RoundRegion, ...]
    wires: tuple[Wire, ...]
    parents: Indices
    borders: tuple[Wire, ...] = ()

    @property
    def chains(self) -> tuple[Wire, ...]:
        """Wires and borders."""
        return (*self.wires, *self.borders)

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

    @cached_property
    def vertex_weights(self) -> Vectors:
        """Share (n,) of the fabric; of wire without fabric beside it, half its length times 1.

        A bare ring of radius 1 weighs as much as the disc it bounds.
        """
        shares = self.vertex_areas.copy()
        bare = shares == 0
        for wire in self.wires:
            ends = wire.edges
            half = np.linalg.norm(self.points[ends[:, 1]] - self.points[ends[:, 0]], axis=1) / 4
            for vertices in ends.T:
                on = bare[vertices]
                np.add.at(shares, vertices[on], half[on])
        return shares


def embedded(points: Vectors) -> Vectors:
    """Flat points (n, 2) as positions (n, 3) with z = 0."""
    return np.concatenate([points, np.zeros((len(points), 1))], axis=1)


def unrefined(
    points: Vectors,
    triangles: Indices,
    region: Indices,
    rounds: tuple[RoundRegion, ...],
    wires: tuple[Wire, ...],
    *,
    borders: tuple[Wire, ...] = (),
) -> Mesh:
    """Make a mesh that is its own parent.

    Raises
    ------
    SceneError
        When a triangle is degenerate or runs clockwise.
    """
    itself = np.repeat(np.arange(len(points))[:, None], 2, axis=1)
    mesh = Mesh(points, triangles, region, rounds, wires, itself, borders)
    if (mesh.areas <= 0).any():
        raise SceneError("a triangle of the mesh has no area or runs clockwise")
    return mesh


class _Midpoints:
    """Numbers for the midpoints of a mesh's edges."""

    def __init__(self, mesh: Mesh) -> None:
        t = mesh.triangles
        sides = np.stack([t, np.roll(t, -1, axis=1)], axis=2).reshape(-1, 2)
        count = len(mesh.points)
        self._count = count
        of_chains = [chain.edges for chain in mesh.chains]  # some have no fabric beside them
        sides = np.concatenate([sides, *of_chains])
        self._keys, position, of_side = np.unique(
            _edge_keys(sides, count), return_index=True, return_inverse=True
        )
        self.ends = np.sort(sides[position], axis=1)
        of_side = of_side[: t.size]
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
    for chain in mesh.chains:
        if chain.track is not None:
            on = midpoints.of(chain.edges) - len(mesh.points)
            placed[on] = chain.track.curve.at(chain.track.between)
    return placed


def _refined_wire(wire: Wire, midpoints: _Midpoints) -> Wire:
    track = wire.track.refined() if wire.track is not None else None
    return Wire(interleaved(wire.vertices, midpoints.of(wire.edges)), wire.closed, track)


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
        borders=tuple(_refined_wire(border, midpoints) for border in mesh.borders),
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
