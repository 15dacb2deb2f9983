"""An array divided among parallel circuits, so that a supply can drive each."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, floor

import numpy as np

from patterns.errors import PatternError
from patterns.exits import exits
from patterns.groups import Group, part_layout, touching_groups
from patterns.layout import Layout
from patterns.tails import tail_pieces
from patterns.terminals import Side

_LINE_MM = 1e-3
"""Loops whose centres lie on one line to within this are of one row or column."""

_ROUND_OFF = 1e-9

Loops = tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Limits:
    """What a circuit may be.

    Attributes
    ----------
    longest_mm : float
        Longest wire, tails included, that can be driven.
    most : int
        Most circuits that can be driven at the same time.
    side : Side
        Where tails leave if they can.
    tail_length_mm, smallest_bend_mm : float
        Straight part of a tail, and the wire's smallest bend radius.
    """

    longest_mm: float
    most: int
    side: Side
    tail_length_mm: float
    smallest_bend_mm: float


def parallel_groups(layout: Layout, limits: Limits) -> tuple[Group, ...]:
    """Divide a layout into the fewest circuits of near-equal length that can be driven.

    Each piece of the layout is divided on its own: into bands of whole rows or whole columns, or
    into stretches of a serpentine; every circuit must hang together, and its tails must find a way
    out. Of equally many circuits those are taken whose longest wire is shortest.

    Raises
    ------
    PatternError
        When there are no such circuits; with the numbers.
    """
    pieces = touching_groups(layout)
    found: list[Loops] = []
    for piece in pieces:
        left = limits.most - len(found) - (len(pieces) - 1)
        found.extend(_divided(layout, piece, limits, max(left, 0)))
    return _groups(tuple(found), limits)


def _divided(layout: Layout, piece: Loops, limits: Limits, most: int) -> tuple[Loops, ...]:
    whole = _around_mm(layout, piece)
    room = limits.longest_mm - 2 * limits.tail_length_mm
    least = ceil(whole / room * (1 - _ROUND_OFF)) if room > 0 else len(piece) + 1
    for count in range(max(least, 1), min(most, len(piece)) + 1):
        rated = [
            (longest, circuits)
            for circuits in _divisions(layout, piece, count)
            if (longest := _longest_mm(layout, circuits, limits)) <= limits.longest_mm
        ]
        if rated:
            return min(rated)[1]
    raise PatternError(
        f"no parallel circuits can be driven: {len(piece)} loops of {whole:.0f} mm of wire need "
        f"{max(least, 1) if room > 0 else 'endlessly many'} circuits of at most "
        f"{limits.longest_mm:.0f} mm with both tails of {limits.tail_length_mm:g} mm, or more "
        f"where loops do not divide evenly; the supply's current is enough for {limits.most}"
    )


def _groups(circuits: tuple[Loops, ...], limits: Limits) -> tuple[Group, ...]:
    return tuple(
        Group(str(k), loops, limits.side, anywhere=True)
        for k, loops in enumerate(circuits, start=1)
    )


def _around_mm(layout: Layout, loops: Loops) -> float:
    return sum(layout.loops[k].around_mm for k in loops)


def _longest_mm(layout: Layout, circuits: tuple[Loops, ...], limits: Limits) -> float:
    """Length of the longest wire with its tails; infinite when tails find no way out."""
    groups = _groups(circuits, limits)
    bends = (limits.smallest_bend_mm,) * len(groups)
    try:
        places = exits(layout, groups, limits.tail_length_mm, bends)
    except PatternError:
        return float("inf")
    lengths: list[float] = []
    for loops, place in zip(circuits, places, strict=True):
        tail = (place.angle_rad, limits.tail_length_mm, place.bend_mm)
        both = tail_pieces(layout.loops[place.loop], *tail)
        tails = sum(piece.length_mm for pieces in both for piece in pieces)
        lengths.append(_around_mm(layout, loops) + tails)
    return max(lengths)


def _divisions(layout: Layout, piece: Loops, count: int) -> Iterator[tuple[Loops, ...]]:
    """Ways to divide loops that touch into circuits that hang together."""
    for units in _rows_of_units(layout, piece):
        if len(units) < count:
            continue
        circuits = _chunks(layout, units, count)
        if all(len(touching_groups(part_layout(layout, own))) == 1 for own in circuits):
            yield circuits


def _rows_of_units(layout: Layout, piece: Loops) -> Iterator[list[Loops]]:
    """Loops in an order, in units that stay together: whole rows or columns, or single loops."""
    place = np.array([(layout.loops[k].x_mm, layout.loops[k].y_mm) for k in piece])
    line = np.round(place / _LINE_MM).astype(np.int64)
    for across in (1, 0):
        along = 1 - across
        rows: list[Loops] = []
        serpentine: list[Loops] = []
        for turn, level in enumerate(np.unique(line[:, across])):
            own = np.flatnonzero(line[:, across] == level)
            own = own[np.argsort(place[own, along], kind="stable")]
            rows.append(tuple(piece[k] for k in own))
            serpentine.extend((piece[k],) for k in (own[::-1] if turn % 2 else own))
        yield rows
        yield serpentine


def _chunks(layout: Layout, units: list[Loops], count: int) -> tuple[Loops, ...]:
    """Cut a row of units where the lengths come nearest to equal shares."""
    length = np.array([_around_mm(layout, unit) for unit in units])
    reached = np.cumsum(length)
    cuts = [0]
    for k in range(1, count):
        share = reached[-1] * k / count
        cut = int(np.argmin(np.round(np.abs(reached - share), 6))) + 1
        cuts.append(min(max(cut, cuts[-1] + 1), len(units) - (count - k)))
    cuts.append(len(units))
    return tuple(
        tuple(sorted(loop for unit in units[a:b] for loop in unit)) for a, b in pairwise(cuts)
    )


def most_circuits(supply_current_A: float, current_A: float) -> int:  # noqa: N803
    """How many circuits a supply's current is enough for at the same time."""
    return floor(supply_current_A / current_A * (1 + _ROUND_OFF))
