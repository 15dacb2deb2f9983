"""Where the loops lie on the stretched fabric, and which of them touch."""

from __future__ import annotations

from dataclasses import dataclass

import networkx as nx
import numpy as np
import shapely
from numpy.typing import NDArray

from patterns.errors import PatternError

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

TANGENCY_TOLERANCE_MM = 1e-6
"""Two loops touch when the distance of their centres is the sum of their radii to within this."""

ROUNDED_MM = 9e-4
"""The same for circles given with three or four decimals; the wire's joints stay as small."""

NEARLY_MM = 1.0
"""Loops nearer than this that do not touch are a mistake: wires so near may short or chafe."""


@dataclass(frozen=True, slots=True)
class Loop:
    """One circle of wire, in the stretched plane.

    Attributes
    ----------
    x_mm, y_mm : float
        Centre; y points away from the operator.
    diameter_mm : float
        Diameter of the wire's centreline.
    """

    x_mm: float
    y_mm: float
    diameter_mm: float

    @property
    def radius_mm(self) -> float:
        """Radius of the wire's centreline."""
        return self.diameter_mm / 2


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
        When two loops overlap; the message names the pair and the distance of their centres.
    """
    centre = np.array([(loop.x_mm, loop.y_mm) for loop in loops]).reshape(-1, 2)
    radius = np.array([loop.radius_mm for loop in loops])
    i, j, gap = _neighbours(centre, radius, tolerance_mm)
    distance = np.hypot(*(centre[j] - centre[i]).T)
    if np.any(gap < -tolerance_mm):
        k = int(np.argmin(gap))
        raise PatternError(
            f"loops {i[k]} and {j[k]} overlap: their centres are {distance[k]:.6g} mm apart, "
            f"and their radii add up to {radius[i[k]] + radius[j[k]]:.6g} mm"
        )
    near = gap <= tolerance_mm
    i, j = i[near], j[near]
    point = centre[i] + (centre[j] - centre[i]) * (radius[i] / (radius[i] + radius[j]))[:, None]
    return Layout(
        loops,
        tuple(
            Contact(int(a), int(b), float(x), float(y))
            for a, b, (x, y) in zip(i, j, point, strict=True)
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
    centre = np.array([(loop.x_mm, loop.y_mm) for loop in layout.loops]).reshape(-1, 2)
    radius = np.array([loop.radius_mm for loop in layout.loops])
    touching = {(contact.first, contact.second) for contact in layout.contacts}
    for i, j, gap in zip(*_neighbours(centre, radius, NEARLY_MM), strict=True):
        if gap < NEARLY_MM and (i, j) not in touching:
            raise PatternError(
                f"loops {_named(layout.loops, i)} and {_named(layout.loops, j)} do not touch, but "
                f"are only {gap:.4f} mm apart: let them touch, or move them at least "
                f"{NEARLY_MM:g} mm apart"
            )


def nearest_pair_text(loops: tuple[Loop, ...], some: list[int], others: list[int]) -> str:
    """Say which pair of some and other loops is nearest, and how far apart it is."""
    x, y, radius = np.array([(loops[n].x_mm, loops[n].y_mm, loops[n].radius_mm) for n in some]).T
    best, near, far = np.inf, 0, 0
    for k in others:
        gap = np.hypot(x - loops[k].x_mm, y - loops[k].y_mm) - radius - loops[k].radius_mm
        if gap.min() < best:
            best, near, far = float(gap.min()), some[int(np.argmin(gap))], k
    return f"the nearest pair, {near} and {far}, is {max(best, 0.0):.3f} mm apart"


def _reached(layout: Layout) -> set[int]:
    """Loops to which touching loops lead from the first."""
    graph: nx.Graph[int] = nx.Graph()
    graph.add_nodes_from(range(len(layout.loops)))
    graph.add_edges_from((contact.first, contact.second) for contact in layout.contacts)
    return set(nx.node_connected_component(graph, 0)) if layout.loops else set()


def _named(loops: tuple[Loop, ...], k: int) -> str:
    return f"{k} at ({loops[k].x_mm:g}, {loops[k].y_mm:g}) mm"


def _neighbours(centre: Floats, radius: Floats, reach_mm: float) -> tuple[Indices, Indices, Floats]:
    """Pairs of loops (first < second, in order) that may be as near as a reach, and their gaps."""
    half = (radius + reach_mm)[:, None]
    boxes = shapely.box(*(centre - half).T, *(centre + half).T)
    i, j = shapely.STRtree(boxes).query(boxes)
    i, j = i[i < j], j[i < j]
    order = np.lexsort((j, i))
    i, j = i[order], j[order]
    return i, j, np.hypot(*(centre[j] - centre[i]).T) - radius[i] - radius[j]
