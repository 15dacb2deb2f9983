"""Thread satin on laid wire, where the wire of the next stage comes near it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from patterns.circuit import Circuit
from patterns.couching import LEFT, RIGHT, alternate_sides, needle_points
from patterns.laid_wire import LaidWire, laid_wire
from patterns.locks import POINTS_PER_LOCK, sides_with_locks, with_locks
from patterns.path import Vectors, WirePath
from patterns.stitching import Stitching

EDGE_TOLERANCE_MM = 0.005

UNDERLAY_STITCH_MM = 2.0
"""Longest stitch along the wire of the underlay of a cover."""

Lengths = NDArray[np.float64]


def covers(
    circuit: Circuit,
    stage: int,
    laid: LaidWire,
    *,
    clear_mm: float,
    wire_diameter_mm: float,
    stitching: Stitching,
    part: int = 0,
) -> list[Vectors]:
    """Cover every crossing that a stage passes second on the wire of one circuit, backward.

    Parameters
    ----------
    stage
        The stage that is laid next, 1 or later.
    laid
        The wire of all stages before it, which the needle must miss.
    clear_mm
        Smallest distance of the needle from the centreline that is covered.
    wire_diameter_mm
        Distance of the centrelines of the two wires where they touch.
    part
        Which circuit's wire is covered.

    Returns
    -------
    list of Vectors
        For each crossing the needle points (n, 2) in mm, on alternate sides of the laid wire but
        for the underlay and the locks at both ends. No needle goes in below the middle of a cover:
        there the wire is, so an underlay runs along its edges.

    Raises
    ------
    PatternError
        As `patterns.couching.needle_points`.
    """
    spans = cover_spans_mm(circuit, stage, wire_diameter_mm, stitching, part).tolist()
    if not spans:
        return []
    spans.sort(reverse=True)
    sewn = [_cover_needles(begin, end, stitching) for begin, end in spans]
    wire = circuit.laid_before(stage)
    stations, sides, wider = (np.concatenate(part) for part in zip(*sewn, strict=True))
    points = needle_points(wire, stations, sides, laid, clear_mm, wider_mm=wider)
    return np.split(points, np.cumsum([len(own) for own, _, _ in sewn])[:-1])


def cover_spans_mm(
    circuit: Circuit, stage: int, wire_diameter_mm: float, stitching: Stitching, part: int = 0
) -> Lengths:
    """Where along the laid wire each cover begins and ends (n, 2), in the order of the crossings.

    A cover reaches ``cover_overlap_mm`` and one stitch past the last point at which the surface of
    the wire of the stage, that is laid next, is nearer than ``cover_reach_mm``, or to an end of
    the wire that it covers.
    """
    near_mm = wire_diameter_mm + stitching.cover_reach_mm
    crossing = np.array([c.first_mm for c in circuit.crossings_of(stage, part)], dtype=float)
    begin, end = circuit.span_mm(part)
    laid = (begin, min(end, circuit.starts_mm[stage]))
    wire = circuit.laid_before(stage)
    edge = _edges(
        wire,
        laid_wire(circuit.stages[stage]),
        np.repeat(crossing, 2),
        np.tile([-stitching.cover_spacing_mm, stitching.cover_spacing_mm], len(crossing)),
        near_mm,
        ends_mm=laid,
    ).reshape(-1, 2)
    past = stitching.cover_overlap_mm + stitching.cover_spacing_mm
    return np.clip(edge + np.array([-past, past]), *laid)


def _cover_needles(
    begin_mm: float, end_mm: float, stitching: Stitching
) -> tuple[Lengths, Lengths, Lengths]:
    """Stations, sides and widening of a cover: an underlay there and back, if any, then satin."""
    satin = _stations(begin_mm, end_mm, stitching.cover_spacing_mm)
    sides = alternate_sides(len(satin))
    wider = np.full(len(satin), stitching.wider_by_mm)
    if stitching.cover_underlay == "edge":
        there = _stations(begin_mm, end_mm, UNDERLAY_STITCH_MM)
        satin = np.concatenate([there, there[::-1], satin])
        sides = np.concatenate([np.repeat([LEFT, RIGHT], len(there)), sides])
        wider = np.concatenate([np.zeros(2 * len(there)), wider])
    return (
        with_locks(satin, stitching.lock_length_mm),
        sides_with_locks(sides),
        np.pad(wider, POINTS_PER_LOCK, mode="edge"),
    )


def _stations(begin_mm: float, end_mm: float, spacing_mm: float) -> Lengths:
    """Needle stations, evenly, at most a spacing apart."""
    return np.linspace(begin_mm, end_mm, int(np.ceil((end_mm - begin_mm) / spacing_mm)) + 1)


def _edges(
    path: WirePath,
    other: LaidWire,
    start_mm: Lengths,
    step_mm: Lengths,
    near_mm: float,
    *,
    ends_mm: tuple[float, float],
) -> Lengths:
    """March from each start until the other wire is no longer near, then close in on the edge."""
    begin, end = ends_mm
    inside, outside = start_mm.copy(), start_mm.copy()
    marching = np.arange(len(start_mm))
    while marching.size:
        inside[marching] = outside[marching]
        outside[marching] = np.clip(inside[marching] + step_mm[marching], begin, end)
        within = (outside[marching] > begin) & (outside[marching] < end)
        marching = marching[within & _is_near(path, other, outside[marching], near_mm)]
    while np.any(np.abs(outside - inside) > EDGE_TOLERANCE_MM):
        middle = (inside + outside) / 2
        near = _is_near(path, other, middle, near_mm)
        inside, outside = np.where(near, middle, inside), np.where(near, outside, middle)
    return outside


def _is_near(path: WirePath, other: LaidWire, at_mm: Lengths, near_mm: float) -> NDArray[np.bool_]:
    return other.distance_mm(path.at(at_mm)[0], near_mm) < near_mm
