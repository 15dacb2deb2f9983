"""Where the wires of several circuits leave without crossing other wire."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi

import numpy as np
from shapely import LineString, STRtree, points

from patterns.errors import PatternError
from patterns.groups import Group
from patterns.layout import Layout
from patterns.path import Vectors, WirePath
from patterns.tails import Exit, tail_pieces
from patterns.terminals import DIRECTIONS, FACING_RAD, LEAST_ALIGNMENT, TAIL_CLEAR_MM

LEAST_BEND_MM = 4.0
"""Tails bend no tighter, however thin the wire: two of them and their stitches need the room."""

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

    A tail keeps `TAIL_CLEAR_MM` from every loop but its own and from the tails before it. Tails
    that stay on the tangent are taken where there is room, and those that turn outward elsewhere;
    when a straight one is in the way of a later circuit, all that can turn outward do.

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
    for turned_first in (False, True):
        found = _chosen(layout, groups, tail_length_mm, smallest_bends_mm, turned_first)
        if len(found) == len(groups):
            return tuple(found)
    group = groups[len(found)]
    where = "anywhere" if group.anywhere else f"at the {group.side.value}"
    raise PatternError(
        f"circuit {group.name}: its tails cannot leave {where}: every way out comes nearer than "
        f"{TAIL_CLEAR_MM:g} mm to other wire; choose another side, shorter tails or other circuits"
    )


def _chosen(
    layout: Layout,
    groups: tuple[Group, ...],
    tail_length_mm: float,
    smallest_bends_mm: tuple[float, ...],
    turned_first: bool,
) -> list[Exit]:
    """Take the first place with room for each circuit; as many as there are such."""
    room = _Room(layout)
    found: list[Exit] = []
    for group, smallest in zip(groups, smallest_bends_mm, strict=True):
        bend = max(smallest, LEAST_BEND_MM)
        bends = (bend, None) if turned_first else (None, bend)
        places = _places(layout, group, bends)
        chosen = next((one for one in places if room.holds(one, tail_length_mm)), None)
        if chosen is None:
            break
        room.take(chosen, tail_length_mm)
        found.append(chosen)
    return found


class _Room:
    """The loops, and the tails that are laid already."""

    def __init__(self, layout: Layout) -> None:
        self._layout = layout
        self._centre = np.array([(loop.x_mm, loop.y_mm) for loop in layout.loops])
        self._radius = np.array([loop.radius_mm for loop in layout.loops])
        self._tree = STRtree(np.asarray(points(self._centre), dtype=np.object_))
        self._tails: list[LineString] = []

    def holds(self, place: Exit, tail_length_mm: float) -> bool:
        """Whether both tails are clear of loops and tails."""
        return all(
            self._clear_of_loops(tail, place.loop)
            and all(tail.distance(other) >= TAIL_CLEAR_MM for other in self._tails)
            for tail in self._lines(place, tail_length_mm)
        )

    def take(self, place: Exit, tail_length_mm: float) -> None:
        """Lay both tails."""
        self._tails.extend(self._lines(place, tail_length_mm))

    def _lines(self, place: Exit, tail_length_mm: float) -> list[LineString]:
        loop = self._layout.loops[place.loop]
        both = tail_pieces(loop, place.angle_rad, tail_length_mm, place.bend_mm)
        return [WirePath(pieces).line_string(_CHORD_MM) for pieces in both]

    def _clear_of_loops(self, tail: LineString, own: int) -> bool:
        reach = TAIL_CLEAR_MM + _CHORD_MM
        near = self._tree.query(tail, predicate="dwithin", distance=reach + self._radius.max())
        near = near[near != own]
        if not near.size:
            return True
        gap = np.array([tail.distance(point) for point in self._tree.geometries[near]])
        return bool(np.all(gap - self._radius[near] >= reach))


def _places(layout: Layout, group: Group, bends_mm: tuple[float | None, ...]) -> Iterator[Exit]:
    """Outermost loops of a group: all of its side, bend by bend, before those elsewhere."""
    angle = 2 * pi * np.arange(DIRECTIONS) / DIRECTIONS
    alignment = np.round(np.cos(angle - FACING_RAD[group.side]), 9)
    least = _ANY_ALIGNMENT if group.anywhere else LEAST_ALIGNMENT
    order = [k for k in np.argsort(-alignment, kind="stable") if alignment[k] >= least]
    rows = [(one.x_mm, one.y_mm, one.radius_mm) for one in (layout.loops[k] for k in group.loops)]
    place = np.array(rows)
    on_side = [k for k in order if alignment[k] >= LEAST_ALIGNMENT]
    elsewhere = order[len(on_side) :]
    for directions in (on_side, elsewhere):
        for bend in bends_mm:
            for k in directions:
                yield from _outermost(group, place, float(angle[k]), bend)


def _outermost(
    group: Group, place: Vectors, angle_rad: float, bend_mm: float | None
) -> Iterator[Exit]:
    reach = place[:, :2] @ np.array([np.cos(angle_rad), np.sin(angle_rad)]) + place[:, 2]
    for loop in np.flatnonzero(reach > reach.max() - _SAME_MM):
        yield Exit(group.loops[int(loop)], angle_rad, bend_mm)
