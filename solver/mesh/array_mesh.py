"""Mesh of a grid of loops that touch, with the fabric between them cut away or kept."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from solver.mesh.loop_mesh import SEGMENTS, loop_fan
from solver.mesh.triangulation import GAP, Mesh, RoundRegion, Wire, unrefined

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]


class Between(StrEnum):
    """What becomes of the cusped gaps that four loops enclose."""

    CUT = "cut"
    KEPT = "kept"


@dataclass(frozen=True, slots=True)
class Grid:
    """Loops in rows (along y) and columns (along x), row by row."""

    rows: int
    columns: int

    @property
    def cells(self) -> tuple[tuple[int, int], ...]:
        """Row and column of each loop."""
        return tuple((r, c) for r in range(self.rows) for c in range(self.columns))

    def number(self, row: int, column: int) -> int:
        """Number of the loop in a row and column."""
        return row * self.columns + column


def _sides(segments: int) -> tuple[int, int, int, int]:
    """Places along a fan's edge of its east, north, west and south."""
    quarter = segments // 4
    return 0, quarter, 2 * quarter, 3 * quarter


def _merged_vertices(grid: Grid, segments: int) -> tuple[Indices, int]:
    """Vertex (loops, 1 + segments) of each vertex of each loop's fan, and how many there are."""
    east, north, west, south = _sides(segments)
    out = np.empty((len(grid.cells), 1 + segments), dtype=np.int64)
    count = 0
    for row, column in grid.cells:
        shared: dict[int, int] = {}
        if column > 0:
            shared[1 + west] = int(out[grid.number(row, column - 1), 1 + east])
        if row > 0:
            shared[1 + south] = int(out[grid.number(row - 1, column), 1 + north])
        own = out[grid.number(row, column)]
        for k in range(1 + segments):
            own[k] = shared.get(k, count)
            count += k not in shared
    return out, count


def _gap_edges(grid: Grid, vertices: Indices) -> Indices:
    """Vertices (gaps, segments) round each gap, counterclockwise, from its southern cusp."""
    segments = vertices.shape[1] - 1
    _, north, west, south = _sides(segments)
    quarter = np.arange(segments // 4)
    # the gap runs along each loop's edge backwards, from the first named side on
    along = [(0, 1, west), (1, 1, south), (1, 0, segments), (0, 0, north)]
    gaps = [
        np.concatenate(
            [
                vertices[grid.number(r + i, c + j), 1 + (side - quarter) % segments]
                for i, j, side in along
            ]
        )
        for r in range(grid.rows - 1)
        for c in range(grid.columns - 1)
    ]
    return np.array(gaps, dtype=np.int64).reshape(-1, segments)


def array_fan(
    grid: Grid, between: Between, axis_ratio: float = 1.0, segments: int = SEGMENTS
) -> Mesh:
    """Coarsest mesh of a grid of equal loops at the pitch at which they touch.

    Loops that touch share a vertex. Gaps that are kept are fans about their middle, which conform
    with the loops' edges.
    """
    fan = loop_fan(axis_ratio, segments)
    pitch = 2 * np.array(fan.rounds[0].semi_axes)
    vertices, count = _merged_vertices(grid, segments)
    centres = np.array([(c, r) for r, c in grid.cells]) * pitch
    points = np.empty((count, 2))
    points[vertices] = fan.points + centres[:, None, :]
    triangles = vertices[:, fan.triangles].reshape(-1, 3)
    region = np.repeat(np.arange(len(centres)), segments)
    if between is Between.KEPT:
        edges = _gap_edges(grid, vertices)
        middles = count + np.arange(len(edges))
        points = np.concatenate([points, points[edges].mean(axis=1)])
        gap = np.stack(
            [np.repeat(middles, segments), edges.ravel(), np.roll(edges, -1, axis=1).ravel()],
            axis=1,
        )
        triangles = np.concatenate([triangles, gap])
        region = np.concatenate([region, np.full(len(gap), GAP)])
    x, y = fan.rounds[0].semi_axes
    rounds = tuple(RoundRegion((float(cx), float(cy)), (x, y)) for cx, cy in centres)
    wires = tuple(Wire(loop[1:]) for loop in vertices)
    return unrefined(points, triangles, region, rounds, wires)
