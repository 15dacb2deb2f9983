"""One wire through every loop: it changes from loop to loop in contacts, where they are tangent."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import accumulate, groupby, pairwise
from math import atan2, cos, pi, sin, tau

import networkx as nx
import numpy as np

from patterns.circuit import Circuit, Crossing, CrossingKind
from patterns.errors import PatternError
from patterns.grid import serpentine, square_grid
from patterns.layout import Contact, Layout, Loop
from patterns.path import Arc, Line, Vectors, WirePath

CLOCKWISE = -1

START = -1
"""Stands for the start point among the contacts of a loop."""

SAME_POINT_MM = 1e-3
"""Start point and point between the halves are at least this far from every contact."""


@dataclass(frozen=True, slots=True)
class _Stop:
    """A point of a loop in which the wire may change to another loop."""

    angle_rad: float
    contact: int


@dataclass(frozen=True, slots=True)
class _Step:
    """The wire along one loop, from one stop to the next."""

    loop: int
    start_rad: float
    sweep_rad: float
    reaches: int


def grid_circuit(
    rows: int, columns: int, loop_diameter_mm: float, tail_length_mm: float
) -> Circuit:
    """Run one wire through a square grid of loops, in a serpentine from the bottom left.

    The terminals are at 225° on that loop, from where both tails leave clear of all loops.
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
) -> Circuit:
    """Run one wire through every loop, with a straight tail at each end.

    Two circles that touch from outside run smoothly into one another when one is traversed
    clockwise and the other counter-clockwise. Changing circle in each contact of a spanning tree
    makes one closed curve that goes once around every loop. It is cut at the start point, and
    halved where every contact has been passed exactly once.

    Parameters
    ----------
    switches
        Contacts (indices into ``layout.contacts``) in which the wire changes loop: a spanning tree.
    start_loop, start_rad
        Loop and angle of the terminals; the wire sets out clockwise.
    tail_length_mm
        Length of each tail, tangent to the start loop.

    Raises
    ------
    PatternError
        When the switches are no spanning tree, the start point is a contact, there is no tail, or
        no point of the wire halves it so that each half passes every contact once.
    """
    if tail_length_mm <= 0:
        raise PatternError(f"the tails are {tail_length_mm:g} mm long: a crimp needs a tail")
    depth = _tree_depth(layout, switches, start_loop)
    steps = tuple(_walk(layout, frozenset(switches), depth, start_loop, start_rad))
    lengths = [layout.loops[s.loop].radius_mm * abs(s.sweep_rad) for s in steps]
    ends = [*accumulate(lengths)]
    passes = _passes(steps, ends)
    middle = _split(layout, passes, ends[-1])
    first, second = _halves(_arcs(layout, steps), middle)
    loop = layout.loops[start_loop]
    point, tangent = _on_circle(loop, start_rad, CLOCKWISE)
    tail = tail_length_mm * tangent
    crossings = (
        *(
            Crossing(CrossingKind.CONTACT, c.x_mm, c.y_mm, tail_length_mm + a, b - middle)
            for c, (a, b) in zip(layout.contacts, passes, strict=True)
        ),
        Crossing(
            CrossingKind.TERMINALS,
            float(point[0]),
            float(point[1]),
            float(tail_length_mm),
            ends[-1] - middle,
        ),
    )
    return Circuit(
        layout,
        switches,
        WirePath((_line(point - tail, point), *first)),
        WirePath((*second, _line(point, point + tail))),
        crossings,
    )


def _tree_depth(layout: Layout, switches: tuple[int, ...], root: int) -> dict[int, int]:
    """Count the switches from the start loop to every loop."""
    if not 0 <= root < len(layout.loops):
        raise PatternError(f"there is no loop {root} to start on: {len(layout.loops)} loops")
    if any(not 0 <= k < len(layout.contacts) for k in switches):
        raise PatternError(f"a switch names none of the {len(layout.contacts)} contacts")
    graph: nx.Graph[int] = nx.Graph()
    graph.add_nodes_from(range(len(layout.loops)))
    graph.add_edges_from((layout.contacts[k].first, layout.contacts[k].second) for k in switches)
    depth: dict[int, int] = dict(nx.single_source_shortest_path_length(graph, root))
    if len(depth) < len(layout.loops):
        raise PatternError(_missed(layout, frozenset(depth)))
    if len(switches) >= len(layout.loops):
        raise PatternError(
            f"{len(switches)} switches for {len(layout.loops)} loops close a ring of loops, or one "
            f"is named twice: a single wire changes loop {len(layout.loops) - 1} times"
        )
    return depth


def _missed(layout: Layout, reached: frozenset[int]) -> str:
    """Say which loops the wire does not reach, and how near the nearest of them is."""
    missed = [k for k in range(len(layout.loops)) if k not in reached]
    best, near, far = min(_nearest(layout, k, sorted(reached)) for k in missed)
    named = ", ".join(map(str, missed[:8])) + (", ..." if len(missed) > 8 else "")
    return (
        f"the switches do not lead to loops {named}; the nearest pair, {near} and {far}, is "
        f"{max(best, 0.0):.3f} mm apart"
    )


def _nearest(layout: Layout, k: int, others: list[int]) -> tuple[float, int, int]:
    """Gap between a loop and the nearest of others, that other, and the loop."""
    x, y, radius = np.array(
        [(a.x_mm, a.y_mm, a.radius_mm) for a in (layout.loops[n] for n in others)]
    ).T
    loop = layout.loops[k]
    gap = np.hypot(x - loop.x_mm, y - loop.y_mm) - radius - loop.radius_mm
    return float(gap.min()), others[int(np.argmin(gap))], k


def _walk(
    layout: Layout, switches: frozenset[int], depth: dict[int, int], loop: int, start_rad: float
) -> Iterator[_Step]:
    """Go once around every loop, from the start back to the start, contact by contact."""
    stops = _stops(layout, loop, start_rad)
    place = [{stop.contact: k for k, stop in enumerate(own)} for own in stops]
    reached = START
    while True:
        sense = CLOCKWISE if depth[loop] % 2 == 0 else -CLOCKWISE
        k, own = place[loop][reached], stops[loop]
        here, following = own[k], own[(k + sense) % len(own)]
        turn = (sense * (following.angle_rad - here.angle_rad)) % tau or tau
        yield _Step(loop, here.angle_rad, sense * turn, following.contact)
        reached = following.contact
        if reached == START:
            return
        if reached in switches:
            contact = layout.contacts[reached]
            loop = contact.second if loop == contact.first else contact.first


def _stops(layout: Layout, start_loop: int, start_rad: float) -> list[list[_Stop]]:
    """List the stops of every loop, counter-clockwise."""
    stops: list[list[_Stop]] = [[] for _ in layout.loops]
    for k, contact in enumerate(layout.contacts):
        for n in (contact.first, contact.second):
            stops[n].append(_Stop(_angle(layout.loops[n], contact), k))
    radius = layout.loops[start_loop].radius_mm
    for stop in stops[start_loop]:
        if abs((stop.angle_rad - start_rad + pi) % tau - pi) * radius < SAME_POINT_MM:
            raise PatternError(
                f"the start point on loop {start_loop} is the contact {stop.contact}: "
                f"the tails would cross another loop there; choose another angle"
            )
    stops[start_loop].append(_Stop(start_rad % tau, START))
    for own in stops:
        own.sort(key=lambda stop: stop.angle_rad)
    return stops


def _angle(loop: Loop, contact: Contact) -> float:
    return atan2(contact.y_mm - loop.y_mm, contact.x_mm - loop.x_mm) % tau


def _on_circle(loop: Loop, angle_rad: float, sense: int) -> tuple[Vectors, Vectors]:
    """Point and unit tangent, each (2,), at an angle of a loop."""
    outward = np.array([cos(angle_rad), sin(angle_rad)])
    tangent = sense * np.array([-outward[1], outward[0]])
    return np.array([loop.x_mm, loop.y_mm]) + loop.radius_mm * outward, tangent


def _line(start: Vectors, end: Vectors) -> Line:
    (x0, y0), (x1, y1) = start.tolist(), end.tolist()
    return Line(x0, y0, x1, y1)


def _passes(steps: tuple[_Step, ...], ends: list[float]) -> list[tuple[float, float]]:
    """Where along the closed curve each contact is passed: first time, second time."""
    found: dict[int, list[float]] = {}
    for step, end in zip(steps[:-1], ends[:-1], strict=True):
        found.setdefault(step.reaches, []).append(end)
    return [(found[k][0], found[k][1]) for k in sorted(found)]


def _split(layout: Layout, passes: list[tuple[float, float]], length_mm: float) -> float:
    """Where to halve the closed curve so that each half passes every contact once."""
    low = max(((a, k) for k, (a, _) in enumerate(passes)), default=(0.0, START))
    high = min(((b, k) for k, (_, b) in enumerate(passes)), default=(length_mm, START))
    if high[0] - low[0] < 2 * SAME_POINT_MM:
        late, early = (layout.contacts[k] for k in (low[1], high[1]))
        raise PatternError(
            f"the wire passes the contact of loops {early.first} and {early.second} for the second "
            f"time before it first comes to that of loops {late.first} and {late.second}: no point "
            f"halves it so that covers can insulate both; choose other switches or another start"
        )
    return (low[0] + high[0]) / 2


def _arcs(layout: Layout, steps: tuple[_Step, ...]) -> Iterator[Arc]:
    """One arc for every stretch on one loop."""
    for n, own in groupby(steps, key=lambda step: step.loop):
        stretch, loop = [*own], layout.loops[n]
        sweep = sum(step.sweep_rad for step in stretch)
        yield Arc(loop.x_mm, loop.y_mm, loop.radius_mm, stretch[0].start_rad, sweep)


def _halves(arcs: Iterator[Arc], middle_mm: float) -> tuple[list[Arc], list[Arc]]:
    """Cut a row of arcs in two at an arclength."""
    first: list[Arc] = []
    second: list[Arc] = []
    begin = 0.0
    for arc in arcs:
        end = begin + arc.length_mm
        if begin < middle_mm < end:
            before, after = _cut(arc, (middle_mm - begin) / arc.length_mm)
            first.append(before)
            second.append(after)
        else:
            (first if end <= middle_mm else second).append(arc)
        begin = end
    return first, second


def _cut(arc: Arc, part: float) -> tuple[Arc, Arc]:
    """Cut an arc at a part (0 to 1) of its length."""
    circle = (arc.centre_x_mm, arc.centre_y_mm, arc.radius_mm)
    sweep = arc.sweep_rad * part
    return (
        Arc(*circle, arc.start_rad, sweep),
        Arc(*circle, arc.start_rad + sweep, arc.sweep_rad - sweep),
    )
