"""Mesh of a grid of loops that touch, with the fabric between them cut away or kept."""

from __future__ import annotations

from dataclasses import dataclass

from solver.ellipse import semi_axes
from solver.mesh.curve import Ellipse
from solver.mesh.drawing import Drawing, Knot
from solver.mesh.face_mesh import MOST_SPOKES
from solver.mesh.loop_mesh import SEGMENTS, check_segments
from solver.mesh.plane_mesh import Between, FabricRegions, plane_mesh
from solver.mesh.triangulation import Mesh


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


def grid_curves(grid: Grid, axis_ratio: float) -> tuple[Ellipse, ...]:
    """Give the loops: equal ellipses of perimeter 2π at the pitch at which they touch."""
    a, b = semi_axes(axis_ratio)
    return tuple(Ellipse((2 * a * column, 2 * b * row), (a, b)) for row, column in grid.cells)


def grid_knots(grid: Grid, axis_ratio: float) -> tuple[Knot, ...]:
    """Give the points in which loops touch their neighbours along x, then along y."""
    a, b = semi_axes(axis_ratio)
    along = [
        Knot((grid.number(r, c), grid.number(r, c + 1)), (2 * a * c + a, 2 * b * r))
        for r, c in grid.cells
        if c + 1 < grid.columns
    ]
    across = [
        Knot((grid.number(r, c), grid.number(r + 1, c)), (2 * a * c, 2 * b * r + b))
        for r, c in grid.cells
        if r + 1 < grid.rows
    ]
    return (*along, *across)


def array_fan(
    grid: Grid, between: Between, axis_ratio: float = 1.0, segments: int = SEGMENTS
) -> Mesh:
    """Coarsest mesh of a grid of equal loops at the pitch at which they touch.

    Loops are fans about their middles; those that touch share a vertex. The triangles of gaps that
    are kept conform with the loops' edges.
    """
    check_segments(segments)
    drawing = Drawing(grid_curves(grid, axis_ratio), grid_knots(grid, axis_ratio))
    regions = FabricRegions((True,) * len(grid.cells), between)
    return plane_mesh(drawing, regions, segments, spokes=max(MOST_SPOKES, segments))
