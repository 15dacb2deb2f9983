"""The regions into which a plane drawing of straight edges divides the plane."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]

_INWARD = 1e-3
"""How far from the middle of an edge a face is looked for, over the edge's length."""


@dataclass(frozen=True)
class Face:
    """A bounded region.

    Attributes
    ----------
    outline : array (n,)
        Vertices round it, counterclockwise; a vertex comes again where an edge ends within.
    holes : tuple of array
        Vertices round what lies in it without being joined to its outline.
    """

    outline: Indices
    holes: tuple[Indices, ...] = ()

    @property
    def edges(self) -> Indices:
        """Vertices (e, 2) of the edges round it, with the region to their left."""
        cycles = (self.outline, *self.holes)
        return np.concatenate([np.stack([c, np.roll(c, -1)], axis=1) for c in cycles])


def contains(points: Vectors, edges: Indices, where: Vectors) -> NDArray[np.bool_]:
    """Whether closed chains of edges (e, 2) go round each of some points (m, 2), by parity."""
    a, b = points[edges[:, 0]], points[edges[:, 1]]
    x, y = where[:, 0, None], where[:, 1, None]
    spans = (a[:, 1] > y) != (b[:, 1] > y)
    rise = np.where(b[:, 1] == a[:, 1], 1.0, b[:, 1] - a[:, 1])
    crossing = a[:, 0] + (y - a[:, 1]) * ((b[:, 0] - a[:, 0]) / rise)
    return np.sum(spans & (x < crossing), axis=1) % 2 == 1


def area(points: Vectors, cycle: Indices) -> float:
    """Area inside a cycle of vertices, greater than 0 when it runs counterclockwise."""
    (x, y), (u, v) = points[cycle].T, points[np.roll(cycle, -1)].T
    return float(np.sum(x * v - u * y) / 2)


def _successors(points: Vectors, half: Indices) -> Indices:
    """Half-edge after each of (h, 2), with the same region to the left."""
    count = len(half)
    along = points[half[:, 1]] - points[half[:, 0]]
    order = np.lexsort((np.arctan2(along[:, 1], along[:, 0]), half[:, 0]))
    # next clockwise about the vertex they come from
    clockwise = np.empty(count, dtype=np.int64)
    origin = half[order, 0]
    starts = np.flatnonzero(np.diff(origin, prepend=-1))
    previous = np.roll(order, 1)
    ends = np.append(starts[1:], count) - 1
    previous[starts] = order[ends]
    clockwise[order] = previous
    twin = (np.arange(count) + count // 2) % count
    return clockwise[twin]


def _cycles(points: Vectors, edges: Indices) -> list[Indices]:
    half = np.concatenate([edges, edges[:, ::-1]])
    following = _successors(points, half).tolist()
    seen = np.zeros(len(half), dtype=bool)
    cycles: list[Indices] = []
    for first in range(len(half)):
        at, cycle = first, list[int]()
        while not seen[at]:
            seen[at] = True
            cycle.append(at)
            at = following[at]
        if cycle:
            cycles.append(half[cycle, 0])
    return cycles


def faces(points: Vectors, edges: Indices) -> tuple[Face, ...]:
    """Bounded regions of a plane drawing with straight edges (e, 2) that meet at their ends only.

    Regions are found by walking round each with it to the left; what is walked round clockwise is
    the outside of a connected part, a hole in the smallest region that contains it.
    """
    cycles = _cycles(points, edges)
    areas = [area(points, cycle) for cycle in cycles]
    outlines = [cycle for cycle, size in zip(cycles, areas, strict=True) if size > 0]
    outlines.sort(key=lambda cycle: area(points, cycle))
    holes: list[list[Indices]] = [[] for _ in outlines]
    rims = [Face(outline).edges for outline in outlines]
    for cycle, size in zip(cycles, areas, strict=True):
        if size > 0:
            continue
        for k, outline in enumerate(outlines):
            apart = not np.isin(cycle, outline).any()
            if apart and contains(points, rims[k], points[cycle[:1]])[0]:
                holes[k].append(cycle)
                break
    return tuple(
        Face(outline, tuple(within)) for outline, within in zip(outlines, holes, strict=True)
    )


def inner_point(points: Vectors, face: Face) -> Vectors:
    """Give a point (1, 2) in a face, next to the middle of its longest edge."""
    edges = face.edges
    a, b = points[edges[:, 0]], points[edges[:, 1]]
    longest = int(np.argmax(np.linalg.norm(b - a, axis=1)))
    along = (b - a)[longest]
    inward = np.array([-along[1], along[0]])
    return ((a + b)[longest] / 2 + _INWARD * inward)[None]
