"""The cut lines are sound, spare the wire and spare the stitches."""

from __future__ import annotations

import numpy as np
from shapely import (
    LineString,
    MultiPolygon,
    Polygon,
    STRtree,
    contains_properly,
    contains_xy,
    linestrings,
    points,
    prepare,
)
from shapely import distance as distance_between

from patterns.circuit import Circuit, Diameters
from patterns.edge_clearance import edge_clearance_mm
from patterns.loop_ring import Ring
from patterns.outline import Outline
from patterns.path import Vectors
from patterns.plan import UNITS_PER_MM, BlockKind, StitchPlan
from patterns.violation import Violation
from patterns.wire_index import Numbers, WireIndex

LEAST_TO_STITCH_MM = 0.3
"""A needle point nearer to a cut line than this tears out."""

_ROUNDOFF_MM = 1e-9


def check_outline(
    outline: Outline,
    circuit: Circuit,
    wire_diameter_mm: Diameters,
    margin_mm: float,
    plan: StitchPlan | None,
) -> tuple[Violation, ...]:
    """Check cut lines: sound rings, clear of the wire, and (given a plan) of the stitches.

    Registration marks may lie outside the fabric. What depends on rings is checked only when they
    are sound.

    Returns
    -------
    tuple of Violation
        Empty when the fabric can be cut; a block and a stitch are named only for needle points.
    """
    faults = [fault for ring in outline.rings for fault in _check_ring(ring)]
    faults = faults or [*_check_senses(outline), *_check_overlap(outline)]
    if faults:
        return tuple(faults)
    fabric = outline.fabric()
    prepare(fabric)
    faults = _check_margin(
        outline, fabric, circuit, max(circuit.of_stages(wire_diameter_mm)), margin_mm
    )
    if plan is not None:
        faults += _check_stitches(outline, fabric, plan)
    return tuple(faults)


def _check_ring(ring: Ring) -> list[Violation]:
    if len(ring) < 3 or not np.all(np.isfinite(ring)):
        return [Violation("cut-ring", "a cut line is no ring of three points or more", 0.0, 0.0)]
    step = np.hypot(*(np.roll(ring, -1, axis=0) - ring).T)
    if np.any(step <= _ROUNDOFF_MM):
        return [_at(ring[int(np.argmin(step))], "cut-ring", "a cut line has a point twice")]
    if not Polygon(ring).is_valid:
        return [_at(ring[0], "cut-ring", "a cut line crosses or touches itself; it starts")]
    return []


def _check_senses(outline: Outline) -> list[Violation]:
    message = "a cut line runs the wrong way round"
    return [
        _at(ring[0], "cut-ring", message)
        for k, ring in enumerate(outline.rings)
        if Polygon(ring).exterior.is_ccw != (k < len(outline.outsides))
    ]


def _check_overlap(outline: Outline) -> list[Violation]:
    """Openings lie inside an outside line, apart from it and from one another, as do outsides."""
    pieces = [Polygon(ring) for ring in outline.outsides]
    openings = [Polygon(ring) for ring in outline.openings]
    first, second = STRtree(pieces).query(pieces, predicate="intersects")
    across = sorted({int(j) for i, j in zip(first, second, strict=True) if i < j})
    apart = "the outside line of one piece of fabric meets that of another"
    faults = [_at(outline.outsides[k][0], "cut-overlap", apart) for k in across]
    if not openings or faults:
        return faults
    inside, _ = STRtree(pieces).query(openings, predicate="within")
    prepare(pieces)
    within = np.any([contains_properly(one, openings) for one in pieces], axis=0)
    held = [k for k in inside.tolist() if within[k]]
    loose = sorted(set(range(len(openings))) - set(held))
    first, second = STRtree(openings).query(openings, predicate="intersects")
    again = sorted({int(j) for i, j in zip(first, second, strict=True) if i < j})
    beyond, twice = "an opening reaches the outside line", "an opening overlaps another one"
    return [
        *(_at(outline.openings[k][0], "cut-overlap", beyond) for k in loose),
        *(_at(outline.openings[k][0], "cut-overlap", twice) for k in again),
    ]


def _check_margin(
    outline: Outline,
    fabric: MultiPolygon,
    circuit: Circuit,
    wire_diameter_mm: float,
    margin_mm: float,
) -> list[Violation]:
    start, end = outline.edges_mm()
    reach = wire_diameter_mm / 2 + margin_mm
    faults: list[Violation] = []
    for stage in circuit.stages:
        faults.extend(_check_crossed(fabric, stage.line_string()))
    distance = edge_clearance_mm(start, end, WireIndex(circuit.wire), reach) - wire_diameter_mm / 2
    message = "a cut line is too near to the wire's surface"
    for i in np.flatnonzero(distance < margin_mm - _ROUNDOFF_MM):
        middle = (start[i] + end[i]) / 2
        faults.append(_at(middle, "cut-margin", message, float(distance[i]), margin_mm))
    return faults


def _check_crossed(fabric: MultiPolygon, wire: LineString) -> list[Violation]:
    if fabric.contains(wire):
        return []
    place = np.array(wire.difference(fabric).representative_point().coords[0])
    return [_at(place, "cut-margin", "the wire does not lie on the fabric: a cut goes through it")]


def _check_stitches(outline: Outline, fabric: MultiPolygon, plan: StitchPlan) -> list[Violation]:
    edges = np.asarray(linestrings(np.stack(outline.edges_mm(), axis=1)), dtype=np.object_)
    tree = STRtree(edges)
    faults: list[Violation] = []
    for k, block in enumerate(plan.blocks):
        if block.kind is not BlockKind.MARKS and block.runs:
            needles = np.concatenate([run.needles for run in block.runs]) / UNITS_PER_MM
            faults.extend(_check_block(tree, fabric, k, needles))
    return faults


def _check_block(
    tree: STRtree, fabric: MultiPolygon, block: int, needles: Vectors
) -> list[Violation]:
    on_fabric = contains_xy(fabric, needles)
    distance = np.where(on_fabric, _to_cut_mm(tree, needles), 0.0)
    faults: list[Violation] = []
    for i in np.flatnonzero(distance < LEAST_TO_STITCH_MM - _ROUNDOFF_MM):
        near = "a needle point is too near to a cut line"
        message = near if on_fabric[i] else "a needle point is where the fabric is cut away"
        x, y = (float(value) for value in needles[i])
        found = float(distance[i]), LEAST_TO_STITCH_MM
        faults.append(Violation("cut-stitches", message, x, y, block, int(i), *found))
    return faults


def _to_cut_mm(tree: STRtree, needles_mm: Vectors) -> Numbers:
    """Distance (n,) to the nearest cut line, infinite when it does not matter."""
    places = np.asarray(points(needles_mm), dtype=np.object_)
    found = tree.query(places, predicate="dwithin", distance=LEAST_TO_STITCH_MM)
    result = np.full(len(needles_mm), np.inf)
    np.minimum.at(result, found[0], distance_between(places[found[0]], tree.geometries[found[1]]))
    return result


def _at(
    place_mm: Vectors,
    rule: str,
    message: str,
    actual: float | None = None,
    allowed: float | None = None,
) -> Violation:
    return Violation(
        rule, message, float(place_mm[0]), float(place_mm[1]), actual=actual, allowed=allowed
    )
