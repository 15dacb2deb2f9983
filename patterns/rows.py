"""The wires of parallel rows of loops, each a circuit whose tails leave along the row."""

from __future__ import annotations

from math import pi

from patterns.errors import PatternError
from patterns.exits import LEAST_BEND_MM
from patterns.groups import Group, touching_groups
from patterns.layout import Layout, check_spaced
from patterns.tails import Exit
from patterns.terminals import Side
from patterns.wiring import Wiring, wires_from

_OUTWARD_RAD = {Side.LEFT: pi, Side.RIGHT: 0.0}


def row_wires(
    layout: Layout, name: str, side: Side, tail_length_mm: float, smallest_bend_mm: float
) -> Wiring:
    """Run one wire through each row of touching loops.

    At the end of its row each wire comes and goes on two tails that turn outward and run on along
    the row, so that the tails of all rows lie side by side, where crimps can reach them.

    Parameters
    ----------
    layout
        Rows along x, apart from one another.
    name
        What the circuits are called, before the number of their row.
    side
        Left or right: the end of the rows at which the tails leave.
    smallest_bend_mm
        Smallest bend radius of the wire.

    Raises
    ------
    PatternError
        When loops of different rows touch or nearly do, or the side is neither left nor right.
    """
    if side not in _OUTWARD_RAD:
        raise PatternError(f"the tails of rows leave on the left or right, not at the {side.value}")
    check_spaced(layout)
    rows = touching_groups(layout)
    outward, bend = _OUTWARD_RAD[side], max(smallest_bend_mm, LEAST_BEND_MM)
    last = max if side is Side.RIGHT else min
    places = (
        Exit(last(row, key=lambda loop: layout.loops[loop].x_mm), outward, bend) for row in rows
    )
    groups = (Group(f"{name} {k}", row, side) for k, row in enumerate(rows, start=1))
    return wires_from(layout, tuple(groups), tuple(places), tail_length_mm)
