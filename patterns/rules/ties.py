"""Rules of ties that are sewn with beams and an upper layer in place."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from shapely import distance as distance_between
from shapely import points
from shapely.geometry.base import BaseGeometry

from patterns.layout import Loop
from patterns.path import Vectors
from patterns.plan import UNITS_PER_MM, BlockKind, StitchPlan
from patterns.sleeve_ties import TIES_PER_EDGE
from patterns.violation import Violation
from patterns.wire_index import WireIndex

_ROUNDOFF_MM = 1e-9


def check_ties(
    plan: StitchPlan,
    loops: tuple[Loop, ...],
    upper: WireIndex,
    beams: BaseGeometry,
    *,
    clear_of_wire_mm: float,
    clear_of_beams_mm: float,
) -> tuple[Violation, ...]:
    """Check the needle points of ties, as they will be sewn.

    Parameters
    ----------
    plan
        Of the lower layer; its own wire is another rule's matter.
    loops
        All loops, each of which must be held at both of its edges.
    upper
        The wire of the upper layer as it comes to lie.
    beams
        The beams as they come to lie, with all that holds them.
    clear_of_wire_mm
        Smallest distance of a needle point from the upper wire's centreline.
    clear_of_beams_mm
        Smallest distance of a needle point from beams: half the needle and the margin.
    """
    blocks = [k for k, block in enumerate(plan.blocks) if block.kind is BlockKind.TIES]
    if len(blocks) != 1:
        message = f"the layers are tied in {len(blocks)} blocks instead of one"
        return (Violation("ties", message, 0.0, 0.0),)
    block = blocks[0]
    runs = [run.needles / UNITS_PER_MM for run in plan.blocks[block].runs]
    needles = np.concatenate(runs)
    return (
        *_strikes(needles, block, upper, clear_of_wire_mm),
        *_through_beams(needles, block, beams, clear_of_beams_mm),
        *_loose(runs, loops),
    )


def check_in_hoop(beams: BaseGeometry, field_mm: tuple[float, float]) -> tuple[Violation, ...]:
    """Beams and their frame lie inside the field of the hoop, where the needle may pass."""
    left, bottom, right, top = beams.bounds
    width, height = field_mm
    beyond = max(-left - width / 2, right - width / 2, -bottom - height / 2, top - height / 2)
    if beyond <= _ROUNDOFF_MM:
        return ()
    message = "beams and frame do not fit into the hoop: they go beyond its field by"
    return (Violation("beams-hoop", message, left, bottom, actual=beyond, allowed=0.0),)


def _strikes(
    needles: Vectors, block: int, upper: WireIndex, clear_mm: float
) -> Iterator[Violation]:
    distance = upper.nearest(needles, clear_mm).distance_mm
    message = "the needle strikes wire of the upper layer: too near to its centreline"
    for k in np.flatnonzero(distance < clear_mm - _ROUNDOFF_MM).tolist():
        found = float(distance[k]), clear_mm
        yield _at(needles[k], "tie-on-wire", message, (block, k), found)


def _through_beams(
    needles: Vectors, block: int, beams: BaseGeometry, clear_mm: float
) -> Iterator[Violation]:
    distance = np.asarray(distance_between(points(needles), beams), dtype=float)
    message = "the needle comes too near to a beam or its frame"
    for k in np.flatnonzero(distance < clear_mm - _ROUNDOFF_MM).tolist():
        found = float(distance[k]), clear_mm
        yield _at(needles[k], "tie-on-beam", message, (block, k), found)


def _loose(runs: list[Vectors], loops: tuple[Loop, ...]) -> Iterator[Violation]:
    """Every edge of every loop has its ties, each of which crosses the wire."""
    middle = np.array([run.mean(axis=0) for run in runs])
    for loop in loops:
        centre = np.array([loop.x_mm, loop.y_mm])
        inside = [np.hypot(*(run - centre).T) < loop.radius_mm for run in runs]
        across = np.array([bool(np.any(own) and not np.all(own)) for own in inside])
        for side, way in (("lower", -1.0), ("upper", 1.0)):
            count = int(np.sum(across & (way * (middle[:, 1] - loop.y_mm) > 0)))
            if count != TIES_PER_EDGE:
                message = f"the {side} edge of a loop is not tied as it should be: ties"
                yield Violation(
                    "ties",
                    message,
                    loop.x_mm,
                    loop.y_mm + way * loop.radius_mm,
                    actual=float(count),
                    allowed=float(TIES_PER_EDGE),
                )


def _at(
    place: Vectors, rule: str, message: str, stitch: tuple[int, int], found: tuple[float, float]
) -> Violation:
    x, y = place.tolist()
    return Violation(rule, message, x, y, *stitch, *found)
