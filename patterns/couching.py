"""Zigzag that ties a wire down without ever meeting wire."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from patterns.errors import NoRoomError, PatternError
from patterns.laid_wire import LaidWire
from patterns.locks import sides_with_locks, with_locks
from patterns.machine import Machine
from patterns.path import Vectors, WirePath
from patterns.stations import Pace, Stations, even_stations, pace
from patterns.stitching import Stitching

FREE_TAIL_MM = 10.0
"""Wire at the end of each tail that no stitch holds, for the crimp."""

LARGEST_OFFSET = 4.0
"""Farthest needle point from its wire, in clearances: past one earlier wire, and no farther."""

SHARES_OF_INTERVAL = (1.0, 0.8, 0.65, 0.5, 0.4)
"""Spacings that are tried, in couching intervals: closer stitches have room to make way."""

PLAY_STEPS = (0.0, 0.5, -0.5, 1.0, -1.0, 0.25, -0.25, 0.75, -0.75)
"""How a stitch without a place for the needle is moved along the wire, in units of its play."""

CLEAR_TOLERANCE_MM = 1e-6

LEFT = 1.0
RIGHT = -1.0

Lengths = NDArray[np.float64]
Sides = NDArray[np.float64]


def needle_clearance_mm(wire_diameter_mm: float, machine: Machine, stitching: Stitching) -> float:
    """Distance of planned needle points from the centreline of wire.

    Half the wire, half the needle and the margin that rounding may use up.
    """
    return (wire_diameter_mm + machine.needle_diameter_mm) / 2 + stitching.needle_margin_mm


def couching(
    path: WirePath,
    span_mm: tuple[float, float],
    first_side: float,
    laid: LaidWire,
    *,
    clear_mm: float,
    stitching: Stitching,
    junctions_mm: Lengths | None = None,
) -> Vectors:
    """Tie down a stretch of wire in one run, locked at both ends.

    Parameters
    ----------
    path
        The wire.
    span_mm
        Where along it the run begins and ends.
    first_side
        `LEFT` or `RIGHT`: the side of the wire on which it begins.
    laid
        Wire that the needle must miss, this one included.
    clear_mm
        Smallest distance of the needle from a centreline.
    junctions_mm
        Where along the wire a stitch crosses it square, as far as there is a place for the needle
        on both sides.

    Returns
    -------
    Vectors
        Needle points (n, 2) in mm, on alternate sides of the wire but for the locks.

    Raises
    ------
    PatternError
        When the span holds no stitch.
    NoRoomError
        As `needle_points`.
    """
    check_span(span_mm, stitching)
    measure = pace(path, stitching)
    begin, end = measure.of(np.array(span_mm))
    crossed = np.empty(0) if junctions_mm is None else junctions_mm
    junctions = measure.of(_roomy(path, crossed, laid, clear_mm))
    stations, sides = np.empty(0), np.empty(0)
    for share in SHARES_OF_INTERVAL:
        spaced = even_stations(begin, end, junctions, share)
        sides = alternate_sides(len(spaced.at), first_side)
        stations = _out_of_the_way(path, spaced, sides, laid, measure=measure, clear_mm=clear_mm)
        stations = with_locks(stations, stitching.lock_length_mm)
        sides = sides_with_locks(sides)
        if not np.any(np.isnan(_offsets(path, stations, sides, laid, clear_mm))):
            break
    return needle_points(path, stations, sides, laid, clear_mm)


def check_span(span_mm: tuple[float, float], stitching: Stitching) -> None:
    """Refuse a stretch of wire in which no lock has room."""
    begin, end = span_mm
    if end - begin < stitching.lock_length_mm:
        raise PatternError(f"there are only {end - begin:.2f} mm of wire to stitch down")


def _roomy(path: WirePath, at_mm: Lengths, laid: LaidWire, clear_mm: float) -> Lengths:
    """Give the places at which the needle has room on both sides of the wire."""
    clear = [
        ~np.isnan(_offsets(path, at_mm, np.full(len(at_mm), side), laid, clear_mm))
        for side in (LEFT, RIGHT)
    ]
    return at_mm[clear[0] & clear[1]]


def _out_of_the_way(
    path: WirePath,
    spaced: Stations,
    sides: Sides,
    laid: LaidWire,
    *,
    measure: Pace,
    clear_mm: float,
) -> Lengths:
    """Stations in mm; those that find no place for the needle are moved within their play."""
    stations = measure.back(spaced.at)
    for share in PLAY_STEPS:
        stuck = np.isnan(_offsets(path, stations, sides, laid, clear_mm)) & (spaced.play > 0)
        if not stuck.any():
            break
        stations[stuck] = measure.back(spaced.at + share * spaced.play)[stuck]
    return stations


def alternate_sides(count: int, first_side: float = LEFT) -> Sides:
    """Sides (n,) of the wire: the first side, the other, and so on."""
    return first_side * np.where(np.arange(count) % 2 == 0, 1.0, -1.0)


def needle_points(
    path: WirePath,
    stations_mm: Lengths,
    sides: Sides,
    laid: LaidWire,
    clear_mm: float,
    *,
    wider_mm: float | Lengths = 0.0,
) -> Vectors:
    """Place the needle beside the wire, or beyond an earlier wire that runs next to it.

    Every point goes outward along its normal to the smallest offset, at least ``clear_mm`` and
    what it is to be wider, at which no wire is nearer than ``clear_mm``. A point with a wire at
    distance d < clear must move by at least clear - d: stepping so can never pass over the smallest
    offset.

    Parameters
    ----------
    stations_mm, sides
        Where along the path (n,), and on which side, `LEFT` or `RIGHT` (n,).
    laid
        All wire that the needle must miss.
    clear_mm
        Smallest distance from a centreline.
    wider_mm
        How much farther from its own wire the needle goes at least, of all points or each (n,).

    Raises
    ------
    NoRoomError
        When a point is still not clear at `LARGEST_OFFSET` clearances; the message says where.
    """
    offset = _offsets(path, stations_mm, sides, laid, clear_mm, wider_mm=wider_mm)
    point, outward = _normals(path, stations_mm, sides)
    stuck = np.flatnonzero(np.isnan(offset))
    if stuck.size:
        raise _no_place(point[stuck[0]], clear_mm)
    return point + offset[:, None] * outward


def _normals(path: WirePath, stations_mm: Lengths, sides: Sides) -> tuple[Vectors, Vectors]:
    """Points of the wire, and unit normals toward the needle's side."""
    point, tangent = path.at(stations_mm)
    return point, sides[:, None] * np.stack([-tangent[:, 1], tangent[:, 0]], axis=1)


def _offsets(
    path: WirePath,
    stations_mm: Lengths,
    sides: Sides,
    laid: LaidWire,
    clear_mm: float,
    *,
    wider_mm: float | Lengths = 0.0,
) -> Lengths:
    """Smallest clear offsets (n,) along the normals; NaN where none is small enough."""
    point, outward = _normals(path, stations_mm, sides)
    offset = np.full(len(point), clear_mm) + wider_mm
    farthest = LARGEST_OFFSET * clear_mm + wider_mm + np.zeros(len(point))
    moving = np.arange(len(point))
    while moving.size:
        needle = point[moving] + offset[moving, None] * outward[moving]
        lacking = clear_mm - laid.distance_mm(needle, clear_mm)
        blocked = lacking > CLEAR_TOLERANCE_MM
        moving = moving[blocked]
        offset[moving] += lacking[blocked]
        offset[moving[offset[moving] > farthest[moving]]] = np.nan
        moving = moving[~np.isnan(offset[moving])]
    return offset


def _no_place(point_mm: Vectors, clear_mm: float) -> NoRoomError:
    x, y = point_mm
    return NoRoomError(
        f"no place for the needle beside the wire at ({x:.2f}, {y:.2f}) mm: within "
        f"{LARGEST_OFFSET * clear_mm:.2f} mm of it every point is nearer than {clear_mm:.2f} mm to "
        f"a wire; larger loops, a thinner needle or a smaller margin would make room"
    )
