"""Where the loops lie on the stretched fabric, and which of them touch."""

from __future__ import annotations

from dataclasses import dataclass

import networkx as nx
import numpy as np
import shapely
from numpy.typing import NDArray

from patterns.errors import PatternError
from patterns.loop import Loop
from patterns.loop_gap import LoopGaps

Indices = NDArray[np.intp]

TANGENCY_TOLERANCE_MM = 1e-6
"""Two loops touch when they are apart, or overlap, by no more than this."""

ROUNDED_MM = 9e-4
"""The same for loops given with three or four decimals; the wire's joints stay as small."""

NEARLY_MM = 1.0
"""Loops nearer than this that do not touch are a mistake: wires so near may short or chafe."""


@dataclass(frozen=True, slots=True)
class Contact:
    """A point in which two loops touch from outside.

    Attributes
    ----------
    first, second : int
        Indices into `Layout.loops`, ``first < second``.
    x_mm, y_mm : float
        The touching point.
    """

    first: int
    second: int
    x_mm: float
    y_mm: float


@dataclass(frozen=True, slots=True)
class Layout:
    """Loops and the points in which they touch; made by `tangent_layout`."""

    loops: tuple[Loop, ...]
    contacts: tuple[Contact, ...]


def tangent_layout(loops: tuple[Loop, ...], tolerance_mm: float = TANGENCY_TOLERANCE_MM) -> Layout:
    """Find the contacts of a set of loops.

    Parameters
    ----------
    tolerance_mm
        Loops touch when they overlap by less, or are apart by less: `ROUNDED_MM` for circles that
        somebody typed in.

    Raises
    ------
    PatternError
        When two loops overlap; the message names the pair, the distance of their centres and by how
        much they overlap.
    """
    gaps = LoopGaps(loops)
    i, j = _neighbours(loops, tolerance_mm)
    gap, point = gaps.of(i, j)
    if np.any(gap < -tolerance_mm):
        k = int(np.argmin(gap))
        raise PatternError(_overlap_text(loops, int(i[k]), int(j[k]), -float(gap[k])))
    near = gap <= tolerance_mm
    return Layout(
        loops,
        tuple(
            Contact(int(a), int(b), float(x), float(y))
            for a, b, (x, y) in zip(i[near], j[near], point[near], strict=True)
        ),
    )


def check_tangent(layout: Layout) -> None:
    """Refuse loops that nearly touch, and loops that no row of touching loops leads to.

    Raises
    ------
    PatternError
        The message names the pair of loops and how far apart they are.
    """
    check_spaced(layout)
    reached = _reached(layout)
    missed = [k for k in range(len(layout.loops)) if k not in reached]
    if missed:
        raise PatternError(
            f"one wire cannot run through all loops: {len(missed)} of {len(layout.loops)} are "
            f"apart from loop 0; {nearest_pair_text(layout.loops, sorted(reached), missed)}; let "
            'them touch, or give each group of touching loops its own wire: wiring.split = "groups"'
        )


def check_spaced(layout: Layout) -> None:
    """Refuse loops that nearly touch.

    Raises
    ------
    PatternError
        The message names the pair of loops and how far apart they are.
    """
    touching = {(contact.first, contact.second) for contact in layout.contacts}
    i, j = _neighbours(layout.loops, NEARLY_MM)
    gaps, _ = LoopGaps(layout.loops).of(i, j)
    for first, second, gap in zip(i.tolist(), j.tolist(), gaps.tolist(), strict=True):
        if gap < NEARLY_MM and (first, second) not in touching:
            raise PatternError(
                f"loops {_named(layout.loops, first)} and {_named(layout.loops, second)} do not "
                f"touch, but are only {gap:.4f} mm apart: let them touch, or move them at least "
                f"{NEARLY_MM:g} mm apart"
            )


def nearest_pair_text(loops: tuple[Loop, ...], some: list[int], others: list[int]) -> str:
    """Say which pair of some and other loops is nearest, and how far apart it is."""
    gaps = LoopGaps(loops)
    best, near, far = np.inf, 0, 0
    for k in others:
        beyond = np.full(len(some), k)
        nearer = np.flatnonzero(gaps.at_least_mm(np.array(some), beyond) < best)
        gap, _ = gaps.of(np.array(some)[nearer], beyond[nearer])
        if gap.min(initial=np.inf) < best:
            best, near, far = float(gap.min()), some[int(nearer[np.argmin(gap)])], k
    places = f"{loops[near].place} and {loops[far].place}"
    return f"the nearest pair, {near} and {far}, is {max(best, 0.0):.3f} mm apart ({places})"


def _reached(layout: Layout) -> set[int]:
    """Loops to which touching loops lead from the first."""
    graph: nx.Graph[int] = nx.Graph()
    graph.add_nodes_from(range(len(layout.loops)))
    graph.add_edges_from((contact.first, contact.second) for contact in layout.contacts)
    return set(nx.node_connected_component(graph, 0)) if layout.loops else set()


def _overlap_text(loops: tuple[Loop, ...], first: int, second: int, by_mm: float) -> str:
    one, other = loops[first], loops[second]
    distance = np.hypot(other.x_mm - one.x_mm, other.y_mm - one.y_mm)
    return (
        f"loops {first} and {second} overlap: their centres, {one.place} and {other.place}, are "
        f"{distance:.6g} mm apart; move one by at least {by_mm:.6g} mm"
    )


def _named(loops: tuple[Loop, ...], k: int) -> str:
    return f"{k} {loops[k].place}"


def _neighbours(loops: tuple[Loop, ...], reach_mm: float) -> tuple[Indices, Indices]:
    """Pairs of loops (first < second, in order) that may be as near as a reach."""
    corners = np.array([loop.box_mm() for loop in loops]).reshape(-1, 4)
    boxes = shapely.box(*(corners + reach_mm * np.array([-1, -1, 1, 1])).T)
    i, j = shapely.STRtree(boxes).query(boxes)
    i, j = i[i < j], j[i < j]
    order = np.lexsort((j, i))
    return i[order], j[order]
