"""Loops in rows: the square grid, bricks and hexagonal packing, with cells left out."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from enum import StrEnum
from math import pi, sqrt

from patterns.loop import Cell, Loop


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
    *,
    axis_ratio: float = 1.0,
    upright: bool = False,
) -> tuple[Loop, ...]:
    """Lay the loops of a lattice, without the missing ones, row by row, centred on the origin.

    A lattice of touching circles that is stretched along or across its rows is one of touching
    ellipses: that they touch does not depend on the stretch.

    Parameters
    ----------
    loop_diameter_mm
        Diameter of circles that are as long around.
    axis_ratio
        Length of the loops over their width.
    upright
        Whether they are longer across the rows than along them.
    """
    axis_rad = pi / 2 if upright and axis_ratio != 1 else 0.0
    shape = (loop_diameter_mm, axis_ratio, axis_rad)
    left_out = frozenset(missing)
    return centred(
        tuple(
            _loop(lattice, cell, (rows - 1) / 2, (columns - 1) / 2, shape)
            for cell in lattice_cells(lattice, rows, columns)
            if cell not in left_out
        )
    )


def row_loops(
    diameters_mm: Sequence[float],
    missing: Collection[Cell] = (),
    *,
    axis_ratio: float = 1.0,
    upright: bool = False,
) -> tuple[Loop, ...]:
    """Lay loops of any sizes in a row, each touching the next; else as `lattice_loops`."""
    axis_rad = pi / 2 if upright and axis_ratio != 1 else 0.0
    x_mm, loops = 0.0, list[Loop]()
    for column, diameter in enumerate(diameters_mm):
        loop = Loop(0.0, 0.0, diameter, axis_ratio, axis_rad, (0, column))
        x_mm += loop.reach_mm(0.0)
        loops.append(replace(loop, x_mm=x_mm))
        x_mm += loop.reach_mm(0.0)
    left_out = frozenset(missing)
    return centred(tuple(loop for loop in loops if loop.cell not in left_out))


def rows_apart(
    rows: int, columns: int, loop_diameter_mm: float, row_pitch_mm: float
) -> tuple[Loop, ...]:
    """Lay rows of touching circles, the rows at a pitch of their own; row by row from below."""
    return tuple(
        Loop(
            (column - (columns - 1) / 2) * loop_diameter_mm,
            (row - (rows - 1) / 2) * row_pitch_mm,
            loop_diameter_mm,
            cell=(row, column),
        )
        for row in range(rows)
        for column in range(columns)
    )


def centred(loops: tuple[Loop, ...]) -> tuple[Loop, ...]:
    """Move loops so that the middle of the box around them is the origin."""
    if not loops:
        return loops
    left, bottom, right, top = zip(*(loop.box_mm() for loop in loops), strict=True)
    x, y = (min(left) + max(right)) / 2, (min(bottom) + max(top)) / 2
    return tuple(replace(loop, x_mm=loop.x_mm - x, y_mm=loop.y_mm - y) for loop in loops)


def _loop(
    lattice: Lattice,
    cell: Cell,
    middle_row: float,
    middle_column: float,
    shape: tuple[float, float, float],
) -> Loop:
    up, along = cell[0] - middle_row, cell[1] - middle_column
    if lattice is not Lattice.GRID:
        up, along = up * sqrt(3) / 2, along + 0.5 * (cell[0] % 2)
    loop = Loop(0.0, 0.0, *shape, cell)
    return replace(loop, x_mm=along * 2 * loop.reach_mm(0.0), y_mm=up * 2 * loop.reach_mm(pi / 2))
