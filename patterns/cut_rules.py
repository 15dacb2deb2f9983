"""Rules that every piece cut from polycarbonate keeps to."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations
from math import hypot

import numpy as np
from shapely import Polygon, contains_xy, is_valid_reason, shortest_line

from patterns.contour import Contour
from patterns.cut_piece import CutPiece, Hole
from patterns.violation import Violation
from patterns.wire_index import WireIndex

_CHORD_MM = 0.0005
_UNTOLD_MM = 0.001
"""Distances are not known better where arcs stand as chords, and no blade is as exact."""


@dataclass(frozen=True, slots=True)
class CutLimits:
    """What a piece must keep to.

    Attributes
    ----------
    hole_edge_diameters : float
        Least distance from a hole's *edge* to the edge of the piece, in diameters of the hole.
        Guides to drilling polycarbonate give 1.5 to 2 and measure from the hole's edge (Highline
        Polycarbonate, Drilling holes in polycarbonate sheet), which is also the stricter reading.
    web_mm : float
        Least material between two holes, or between openings; a strip narrower than about twice
        its thickness tears when the blade turns (an assumption, to be tried on a coupon).
    inner_radius_mm : float
        Smallest radius of inner corners and holes that the blade can follow (an assumption).
    """

    hole_edge_diameters: float = 1.5
    web_mm: float = 0.8
    inner_radius_mm: float = 0.25


def check_piece(piece: CutPiece, limits: CutLimits) -> tuple[Violation, ...]:
    """Check a piece: sound lines, holes on it and away from edges, webs, inner radii.

    Returns
    -------
    tuple of Violation
        Empty when it can be cut; places are in the piece's coordinates.
    """
    material = _material(piece)
    if not material.is_valid:
        x, y, _ = piece.outside.vertices()[0]
        reason = is_valid_reason(material)
        message = f"{piece.name}: its lines meet or cross ({reason}); the piece starts"
        return (Violation("cut-shape", message, x, y),)
    room = [(hole, _room_mm(piece, material, hole)) for hole in piece.holes]
    return (
        *_check_hole_edges(piece, room, limits),
        *_check_hole_webs(piece, limits),
        *_check_line_webs(piece, limits),
        *_check_radii(piece, limits),
    )


def _contours(piece: CutPiece) -> tuple[Contour, ...]:
    return (piece.outside, *piece.openings)


def _material(piece: CutPiece) -> Polygon:
    """The piece without its holes."""
    openings = [one.ring(_CHORD_MM) for one in piece.openings]
    return Polygon(piece.outside.ring(_CHORD_MM), openings)


def _room_mm(piece: CutPiece, material: Polygon, hole: Hole) -> float:
    """Material beside a hole's edge; negative when the hole is not all on the piece."""
    away = _to_lines_mm(piece, hole)
    on_it = contains_xy(material, hole.x_mm, hole.y_mm)
    return (away if on_it else -away) - hole.diameter_mm / 2


def _to_lines_mm(piece: CutPiece, hole: Hole) -> float:
    """Distance from a hole's centre to the nearest line, exact."""
    centre, reach = np.array([[hole.x_mm, hole.y_mm]]), 1e6
    return min(
        float(WireIndex(one.path).nearest(centre, reach).distance_mm[0]) for one in _contours(piece)
    )


def _check_hole_edges(
    piece: CutPiece, room: list[tuple[Hole, float]], limits: CutLimits
) -> Iterator[Violation]:
    for hole, left in room:
        allowed = limits.hole_edge_diameters * hole.diameter_mm
        if left <= 0:
            message = "is not all on the piece; the material beside it is"
            yield _at_hole(piece, hole, "hole-off", message, (left, allowed))
        elif left < allowed - _UNTOLD_MM:
            message = f"has less than {limits.hole_edge_diameters:g} diameters beside it"
            yield _at_hole(piece, hole, "hole-edge", message, (left, allowed))


def _check_hole_webs(piece: CutPiece, limits: CutLimits) -> Iterator[Violation]:
    for one, other in combinations(piece.holes, 2):
        apart = hypot(one.x_mm - other.x_mm, one.y_mm - other.y_mm)
        left = apart - (one.diameter_mm + other.diameter_mm) / 2
        if left < limits.web_mm - _UNTOLD_MM:
            message = "leaves too thin a web to another hole"
            yield _at_hole(piece, one, "web", message, (left, limits.web_mm))


def _check_line_webs(piece: CutPiece, limits: CutLimits) -> Iterator[Violation]:
    rings = [Polygon(one.ring(_CHORD_MM)).exterior for one in _contours(piece)]
    for one, other in combinations(rings, 2):
        web = shortest_line(one, other)
        if web.length < limits.web_mm - _UNTOLD_MM:
            x, y = web.interpolate(0.5, normalized=True).coords[0]
            message = f"{piece.name}: the web between two lines is too thin"
            yield Violation("web", message, x, y, actual=web.length, allowed=limits.web_mm)


def _check_radii(piece: CutPiece, limits: CutLimits) -> Iterator[Violation]:
    least = limits.inner_radius_mm
    for sharpest in (one.sharpest_inner for one in _contours(piece)):
        if sharpest and sharpest.radius_mm < least - _UNTOLD_MM:
            x, y, radius = sharpest.centre_x_mm, sharpest.centre_y_mm, sharpest.radius_mm
            message = f"{piece.name}: an inner corner's radius is too small for the blade"
            yield Violation("inner-radius", message, x, y, actual=radius, allowed=least)
    for hole in piece.holes:
        if hole.diameter_mm / 2 < least - _UNTOLD_MM:
            message = "has too small a radius for the blade"
            yield _at_hole(piece, hole, "inner-radius", message, (hole.diameter_mm / 2, least))


def _at_hole(
    piece: CutPiece, hole: Hole, rule: str, message: str, found: tuple[float, float]
) -> Violation:
    """Give a fault of a hole, with what was found and what is allowed."""
    what = f"{piece.name}: the hole of {hole.diameter_mm:g} mm {message}"
    return Violation(rule, what, hole.x_mm, hole.y_mm, actual=found[0], allowed=found[1])
