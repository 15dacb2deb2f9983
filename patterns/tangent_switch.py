"""One wire through every loop: it changes from loop to loop in contacts, where they are tangent."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import accumulate, chain, groupby, pairwise
from math import pi, tau

import networkx as nx
import numpy as np

from patterns.circuit import Circuit, Crossing, CrossingKind
from patterns.errors import PatternError
from patterns.grid import serpentine, square_grid
from patterns.layout import NEARLY_MM, Layout, nearest_pair_text
from patterns.loop_arcs import loop_arcs
from patterns.path import Arc, Piece, Vectors, WirePath
from patterns.splits import Passes, split_points_mm
from patterns.tails import tail_pieces
from patterns.touching import CLOCKWISE, Touching, check_start, touching
from patterns.wire_index import WireIndex

START = -1
"""Stands for the start point among the contacts of a loop."""


@dataclass(frozen=True, slots=True)
class _Step:
    """The wire along one loop, from one contact to the next."""

    loop: int
    start_rad: float
    sweep_rad: float
    reaches: int


def grid_circuit(
    rows: int, columns: int, loop_diameter_mm: float, tail_length_mm: float
) -> Circuit:
    """Run one wire through a square grid of loops, in a serpentine from the bottom left.

    The terminals are at 225° on that loop, from where both tails leave clear of all loops. Two
    stages do.
    """
    layout = square_grid(rows, columns, loop_diameter_mm)
    index = {(c.first, c.second): k for k, c in enumerate(layout.contacts)}
    switches = tuple(index[min(a, b), max(a, b)] for a, b in pairwise(serpentine(rows, columns)))
    return single_circuit(layout, switches, 0, 5 * pi / 4, tail_length_mm)


def single_circuit(
    layout: Layout,
    switches: tuple[int, ...],
    start_loop: int,
    start_rad: float,
    tail_length_mm: float,
    *,
    bend_mm: float | None = None,
    further_mm: Sequence[tuple[float, float]] = (),
) -> Circuit:
    """Run one wire through every loop, with a straight tail at each end.

    Two loops that touch from outside run smoothly into one another when one is traversed clockwise
    and the other counter-clockwise. Changing loop in each contact of a spanning tree
    makes one closed curve that goes once around every loop. It is cut at the start point, and
    split into the fewest stages that pass no contact twice.

    Parameters
    ----------
    switches
        Contacts (indices into ``layout.contacts``) in which the wire changes loop: a spanning tree.
    start_loop, start_rad
        Loop, and direction of its outward normal, at the terminals; the wire sets out clockwise.
    tail_length_mm
        Length of the straight part of each tail.
    further_mm
        Points (x, y) in which loops touch those of other circuits: no stage ends there.
    bend_mm
        Radius with which the tails turn outward from the tangent; none leaves them on it.

    Raises
    ------
    PatternError
        When the switches are no spanning tree, the start point is a contact, or there is no tail.
    """
    if tail_length_mm <= 0:
        raise PatternError(f"the tails are {tail_length_mm:g} mm long: a crimp needs a tail")
    _check_tree(layout, switches, start_loop)
    graph = touching(layout)
    check_start(graph, start_loop, start_rad)
    steps = tuple(_walk(graph, frozenset(switches), start_loop, start_rad))
    ways = [loop_arcs(layout.loops[s.loop], s.start_rad, s.sweep_rad) for s in steps]
    ends = [*accumulate(sum(arc.length_mm for arc in way) for way in ways)]
    passes = _passes(steps, ends)
    comes, goes = tail_pieces(layout.loops[start_loop], start_rad, tail_length_mm, bend_mm)
    curve = [*_merged(chain.from_iterable(ways))]
    stages = _stages(curve, split_points_mm(passes, ends[-1], _stations(curve, further_mm)))
    stages[0][:0] = comes
    stages[-1].extend(goes)
    point, _ = goes[0].at(np.zeros(1))
    tail_mm = sum(piece.length_mm for piece in goes)
    return Circuit(
        layout,
        switches,
        tuple(WirePath(tuple(stage)) for stage in stages),
        tuple(_crossings(layout, passes, point[0], ends[-1], tail_mm)),
        len(goes),
    )


def _stations(curve: Sequence[Arc], points_mm: Sequence[tuple[float, float]]) -> list[float]:
    """Where along a curve points on it lie."""
    if not points_mm:
        return []
    nearest = WireIndex(WirePath(tuple(curve))).nearest(np.array(points_mm), NEARLY_MM)
    return nearest.station_mm.tolist()


def _crossings(
    layout: Layout, passes: Passes, start: Vectors, length_mm: float, tail_mm: float
) -> Iterator[Crossing]:
    for contact, (a, b) in zip(layout.contacts, passes, strict=True):
        yield Crossing(CrossingKind.CONTACT, contact.x_mm, contact.y_mm, tail_mm + a, tail_mm + b)
    x, y = start.tolist()
    yield Crossing(CrossingKind.TERMINALS, x, y, float(tail_mm), tail_mm + length_mm)


def _check_tree(layout: Layout, switches: tuple[int, ...], root: int) -> None:
    """Refuse what is no spanning tree."""
    if not 0 <= root < len(layout.loops):
        raise PatternError(f"there is no loop {root} to start on: {len(layout.loops)} loops")
    if any(not 0 <= k < len(layout.contacts) for k in switches):
        raise PatternError(f"a switch names none of the {len(layout.contacts)} contacts")
    graph: nx.Graph[int] = nx.Graph()
    graph.add_nodes_from(range(len(layout.loops)))
    graph.add_edges_from((layout.contacts[k].first, layout.contacts[k].second) for k in switches)
    reached: set[int] = set(nx.node_connected_component(graph, root))
    if len(reached) < len(layout.loops):
        missed = [k for k in range(len(layout.loops)) if k not in reached]
        named = ", ".join(map(str, missed[:8])) + (", ..." if len(missed) > 8 else "")
        raise PatternError(
            f"the switches do not lead to loops {named}; "
            f"{nearest_pair_text(layout.loops, sorted(reached), missed)}"
        )
    if len(switches) >= len(layout.loops):
        raise PatternError(
            f"{len(switches)} switches for {len(layout.loops)} loops close a ring of loops, or one "
            f"is named twice: a single wire changes loop {len(layout.loops) - 1} times"
        )


def _walk(
    graph: Touching, switches: frozenset[int], loop: int, start_rad: float
) -> Iterator[_Step]:
    """Go once around every loop, from the start back to the start, contact by contact."""
    sense, start = CLOCKWISE, start_rad % tau
    here = start
    for contact in (*graph.tour(switches, loop, start), START):
        following = start if contact == START else graph.angle_rad[loop][contact]
        turn = (sense * (following - here)) % tau or tau
        yield _Step(loop, here, sense * turn, contact)
        here = following
        if contact in switches:
            loop, sense = graph.beyond[loop][contact], -sense
            here = graph.angle_rad[loop][contact]


def _passes(steps: tuple[_Step, ...], ends: list[float]) -> list[tuple[float, float]]:
    """Where along the closed curve each contact is passed: first time, second time."""
    found: dict[int, list[float]] = {}
    for step, end in zip(steps[:-1], ends[:-1], strict=True):
        found.setdefault(step.reaches, []).append(end)
    return [(found[k][0], found[k][1]) for k in sorted(found)]


def _merged(arcs: Iterable[Arc]) -> Iterator[Arc]:
    """One arc for every stretch on one circle."""
    for circle, own in groupby(arcs, key=_circle):
        stretch = [*own]
        yield Arc(*circle, stretch[0].start_rad, sum(arc.sweep_rad for arc in stretch))


def _stages(arcs: Iterable[Arc], splits_mm: Sequence[float]) -> list[list[Piece]]:
    """Cut a row of arcs at arclengths."""
    stages: list[list[Piece]] = [[]]
    begin = 0.0
    for whole in arcs:
        arc, end = whole, begin + whole.length_mm
        while len(stages) <= len(splits_mm) and splits_mm[len(stages) - 1] < end:
            split = splits_mm[len(stages) - 1]
            before, arc = _cut(arc, (split - begin) / arc.length_mm)
            stages[-1].append(before)
            stages.append([])
            begin = split
        stages[-1].append(arc)
        begin = end
    return stages


def _cut(arc: Arc, part: float) -> tuple[Arc, Arc]:
    """Cut an arc at a part (0 to 1) of its length."""
    circle = _circle(arc)
    sweep = arc.sweep_rad * part
    return (
        Arc(*circle, arc.start_rad, sweep),
        Arc(*circle, arc.start_rad + sweep, arc.sweep_rad - sweep),
    )


def _circle(arc: Arc) -> tuple[float, float, float]:
    return arc.centre_x_mm, arc.centre_y_mm, arc.radius_mm
