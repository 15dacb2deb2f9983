"""The wires of parallel rows of loops, whose tails leave along the rows."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import chain
from math import pi

from patterns.errors import PatternError
from patterns.exits import LEAST_BEND_MM
from patterns.groups import Group, touching_groups
from patterns.layout import Layout, check_spaced
from patterns.series import in_series
from patterns.tails import Exit
from patterns.terminals import Side
from patterns.wiring import Wiring, wires_from, wiring_of

_OUTWARD_RAD = {Side.LEFT: pi, Side.RIGHT: 0.0}


def row_wires(
    layout: Layout,
    name: str,
    side: Side,
    tail_length_mm: float,
    smallest_bend_mm: float,
    *,
    joined: int = 1,
) -> Wiring:
    """Run one wire through each row of touching loops, or through some neighbouring rows.

    At the end of its row each wire comes and goes on two tails that turn outward and run on along
    the row, so that the tails of all rows lie side by side, where crimps can reach them. Rows that
    are joined are in series: instead of leaving, the wire turns back into the next row.

    Parameters
    ----------
    layout
        Rows along x, apart from one another.
    name
        What the circuits are called, before their number.
    side
        Left or right: the end of the rows at which the tails leave.
    smallest_bend_mm
        Smallest bend radius of the wire.
    joined
        How many neighbouring rows share a wire; their number must be a multiple of it.

    Raises
    ------
    PatternError
        When loops of different rows touch or nearly do, the side is neither left nor right, or rows
        cannot be joined.
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
    single = wires_from(layout, _groups(name, side, rows), tuple(places), tail_length_mm)
    return single if joined == 1 else _in_series(single, name, side, joined, smallest_bend_mm)


def _groups(name: str, side: Side, rows: Iterable[tuple[int, ...]]) -> tuple[Group, ...]:
    return tuple(Group(f"{name} {k}", row, side) for k, row in enumerate(rows, start=1))


def _in_series(
    single: Wiring, name: str, side: Side, joined: int, smallest_bend_mm: float
) -> Wiring:
    layout, rows, count = single.layout, single.part_loops, len(single.parts)
    if joined < 1 or count % joined:
        raise PatternError(f"{count} rows cannot be joined by {joined}")
    # each wire leaves its row upward on the left, downward on the right
    way = 1 if side is Side.LEFT else -1
    parts = [range(k, k + joined)[::way] for k in range(0, count, joined)]
    circuits = tuple(
        in_series(
            layout, [single.parts[k] for k in part], [rows[k] for k in part], smallest_bend_mm
        )
        for part in parts
    )
    groups = _groups(
        name, side, (tuple(sorted(chain.from_iterable(rows[k] for k in part))) for part in parts)
    )
    return wiring_of(layout, groups, circuits)
