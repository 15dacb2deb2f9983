"""Where the wires of several circuits leave without crossing other wire."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from math import pi

import numpy as np
from shapely import LineString, Polygon, STRtree, points

from patterns.couching import FREE_TAIL_MM
from patterns.errors import PatternError
from patterns.groups import Group
from patterns.layout import Layout
from patterns.loop import Loop
from patterns.loop_ring import CHORD_MM, ring_around
from patterns.path import WirePath
from patterns.tails import Exit, tail_pieces
from patterns.terminals import (
    CRIMP_APART_MM,
    DIRECTIONS,
    FACING_RAD,
    LEAST_ALIGNMENT,
    TAIL_CLEAR_MM,
)
from patterns.wire_index import Indices

LEAST_BEND_MM = 4.0
"""Tails bend no tighter, however thin the wire: two of them and their stitches need the room."""

ROOMY_MM = 10.0
"""Distance from the loops of other circuits that tails keep when they can: the fabric that is left
along a tail then does not join that of another array."""

_ANY_ALIGNMENT = -2.0
_SAME_MM = 1e-6
_CHORD_MM = 0.05


def exits(
    layout: Layout,
    groups: tuple[Group, ...],
    tail_length_mm: float,
    smallest_bends_mm: tuple[float, ...],
) -> tuple[Exit, ...]:
    """Choose loop, angle and bend of the tails of each circuit, one after the other.

    A tail keeps `TAIL_CLEAR_MM` from every loop but its own and from the tails before it, and its
    free end `CRIMP_APART_MM` from the free ends of those. Tails
    that stay on the tangent are taken where there is room, and those that turn outward elsewhere;
    when a straight one is in the way of a later circuit, all that can turn outward do. From other
    circuits' loops they keep `ROOMY_MM` when all can.

    Parameters
    ----------
    smallest_bends_mm
        For each group the smallest bend radius of its wire.

    Returns
    -------
    tuple of Exit
        One a group; loops are indices into ``layout.loops``.

    Raises
    ------
    PatternError
        When there is no such place on the side that is asked for.
    """
    bends = [max(smallest, LEAST_BEND_MM) for smallest in smallest_bends_mm]
    found: list[Exit] = []
    for clear_mm, turned_first in product((ROOMY_MM, TAIL_CLEAR_MM), (False, True)):
        ways = [_ways(layout, *one, turned_first) for one in zip(groups, bends, strict=True)]
        found = _chosen(_Room(layout, tail_length_mm, clear_mm), groups, ways)
        if len(found) == len(groups):
            return tuple(found)
    group = groups[len(found)]
    where = "anywhere" if group.anywhere else f"at the {group.side.value}"
    raise PatternError(
        f"circuit {group.name}: its tails cannot leave {where}: every way out comes nearer than "
        f"{TAIL_CLEAR_MM:g} mm to other wire, or {CRIMP_APART_MM:g} mm to the free end of another "
        "tail; choose another side, shorter tails or other circuits"
    )


def _chosen(room: _Room, groups: tuple[Group, ...], ways: list[Iterator[Exit]]) -> list[Exit]:
    """Take the first place with room for each circuit; as many as there are such."""
    found: list[Exit] = []
    for group, places in zip(groups, ways, strict=True):
        own = np.array(group.loops)
        chosen = next((one for one in places if room.holds(one, own)), None)
        if chosen is None:
            break
        room.take(chosen)
        found.append(chosen)
    return found


class _Room:
    """The loops, and the tails that are laid already."""

    def __init__(self, layout: Layout, tail_length_mm: float, clear_mm: float) -> None:
        self._layout = layout
        self._tail_length_mm = tail_length_mm
        self._clear_mm = clear_mm
        self._longest_mm = max(loop.semi_axes_mm[0] for loop in layout.loops)
        centres = points(np.array([(loop.x_mm, loop.y_mm) for loop in layout.loops]))
        self._tree = STRtree(np.asarray(centres, dtype=np.object_))
        self._tails: list[LineString] = []
        self._ends: list[LineString] = []

    def holds(self, place: Exit, own: Indices) -> bool:
        """Whether both tails are clear of loops and tails."""
        return all(
            self._clear_of_loops(tail, place.loop, own)
            and all(tail.distance(other) >= TAIL_CLEAR_MM for other in self._tails)
            for tail in self._lines(place)
        ) and all(
            end.distance(other) >= CRIMP_APART_MM
            for end in self._free_ends(place)
            for other in self._ends
        )

    def take(self, place: Exit) -> None:
        """Lay both tails."""
        self._tails.extend(self._lines(place))
        self._ends.extend(self._free_ends(place))

    def _lines(self, place: Exit) -> list[LineString]:
        loop = self._layout.loops[place.loop]
        both = tail_pieces(loop, place.angle_rad, self._tail_length_mm, place.bend_mm)
        return [WirePath(pieces).line_string(_CHORD_MM) for pieces in both]

    def _free_ends(self, place: Exit) -> list[LineString]:
        """The parts of both tails that no stitch holds: the first of one, the last of the other."""
        comes, goes = self._lines(place)
        free = min(FREE_TAIL_MM, self._tail_length_mm)
        first = comes.interpolate([0.0, free])
        last = goes.interpolate([goes.length - free, goes.length])
        return [LineString(first), LineString(last)]

    def _clear_of_loops(self, tail: LineString, start: int, own: Indices) -> bool:
        reach = self._clear_mm + _CHORD_MM + self._longest_mm
        near = self._tree.query(tail, predicate="dwithin", distance=reach)
        near = near[near != start]
        if not near.size:
            return True
        rings = [Polygon(ring_around(self._layout.loops[k])) for k in near.tolist()]
        gap = np.array([tail.distance(ring) for ring in rings]) + CHORD_MM
        clear = np.where(np.isin(near, own), TAIL_CLEAR_MM, self._clear_mm)
        return bool(np.all(gap >= clear + _CHORD_MM))


def _ways(layout: Layout, group: Group, bend_mm: float, turned_first: bool) -> Iterator[Exit]:
    """Outermost loops of a group: all of its side, bend by bend, before those elsewhere."""
    angle = 2 * pi * np.arange(DIRECTIONS) / DIRECTIONS
    alignment = np.round(np.cos(angle - FACING_RAD[group.side]), 9)
    least = _ANY_ALIGNMENT if group.anywhere else LEAST_ALIGNMENT
    order = [k for k in np.argsort(-alignment, kind="stable") if alignment[k] >= least]
    own = [layout.loops[k] for k in group.loops]
    on_side = [k for k in order if alignment[k] >= LEAST_ALIGNMENT]
    elsewhere = order[len(on_side) :]
    for directions in (on_side, elsewhere):
        for bend in (bend_mm, None) if turned_first else (None, bend_mm):
            for k in directions:
                yield from _outermost(group, own, float(angle[k]), bend)


def _outermost(
    group: Group, own: list[Loop], angle_rad: float, bend_mm: float | None
) -> Iterator[Exit]:
    x, y, out = np.array([(one.x_mm, one.y_mm, one.reach_mm(angle_rad)) for one in own]).T
    reach = x * np.cos(angle_rad) + y * np.sin(angle_rad) + out
    for loop in np.flatnonzero(reach > reach.max() - _SAME_MM):
        yield Exit(group.loops[int(loop)], angle_rad, bend_mm)
