"""Loops in rows: the square grid, bricks and hexagonal packing, with cells left out."""

from __future__ import annotations

from collections.abc import Collection
from enum import StrEnum
from math import sqrt

from patterns.layout import Loop

Cell = tuple[int, int]
"""Row, counted from the bottom, and column, counted from the left; both from 0."""


class Lattice(StrEnum):
    """How the rows lie on each other.

    Loops of a row touch in all of them. ``GRID`` sets the rows straight on each other. In the other
    two every second row is shifted by half a loop and rests in the hollows of the one below: all
    touching circles that are shifted so are packed hexagonally. They differ in the ends of rows:
    ``BRICK`` shifts rows that are all of one length, to the right; ``HEXAGONAL`` clips the packing
    to the width of the first row, so that every second row has one loop less.
    """

    GRID = "grid"
    BRICK = "brick"
    HEXAGONAL = "hexagonal"


def lattice_cells(lattice: Lattice, rows: int, columns: int) -> tuple[Cell, ...]:
    """List the cells of a lattice, row by row."""
    clipped = lattice is Lattice.HEXAGONAL
    return tuple((r, c) for r in range(rows) for c in range(columns - (r % 2 if clipped else 0)))


def lattice_loops(
    lattice: Lattice,
    rows: int,
    columns: int,
    loop_diameter_mm: float,
    missing: Collection[Cell] = (),
) -> tuple[Loop, ...]:
    """Lay the loops of a lattice, without the missing ones, row by row, centred on the origin."""
    left_out = frozenset(missing)
    return centred(
        tuple(
            _loop(lattice, cell, (rows - 1) / 2, (columns - 1) / 2, loop_diameter_mm)
            for cell in lattice_cells(lattice, rows, columns)
            if cell not in left_out
        )
    )


def centred(loops: tuple[Loop, ...]) -> tuple[Loop, ...]:
    """Move loops so that the middle of the box around them is the origin."""
    if not loops:
        return loops
    x = _middle([(loop.x_mm - loop.radius_mm, loop.x_mm + loop.radius_mm) for loop in loops])
    y = _middle([(loop.y_mm - loop.radius_mm, loop.y_mm + loop.radius_mm) for loop in loops])
    return tuple(Loop(loop.x_mm - x, loop.y_mm - y, loop.diameter_mm) for loop in loops)


def _loop(
    lattice: Lattice, cell: Cell, middle_row: float, middle_column: float, diameter_mm: float
) -> Loop:
    up, along = cell[0] - middle_row, cell[1] - middle_column
    if lattice is not Lattice.GRID:
        up, along = up * sqrt(3) / 2, along + 0.5 * (cell[0] % 2)
    return Loop(along * diameter_mm, up * diameter_mm, diameter_mm)


def _middle(spans: list[tuple[float, float]]) -> float:
    return (min(low for low, _ in spans) + max(high for _, high in spans)) / 2
