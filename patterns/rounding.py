"""Polygons with round corners: sharp ones tear polycarbonate, and a blade cannot turn on them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import atan2, copysign, hypot, pi, tan

from patterns.contour import Contour
from patterns.errors import PatternError
from patterns.path import Arc, Line, Piece

_ROUNDOFF_MM = 1e-9


@dataclass(frozen=True, slots=True)
class Corner:
    """A corner before it is rounded, and the radius that rounds it."""

    x_mm: float
    y_mm: float
    radius_mm: float


@dataclass(frozen=True, slots=True)
class _Fillet:
    """The arc that rounds a corner, from ``enters_mm`` to ``leaves_mm``; none where it is flat."""

    enters_mm: tuple[float, float]
    leaves_mm: tuple[float, float]
    arc: Arc | None
    cut_back_mm: float


def rounded(corners: Sequence[Corner]) -> Contour:
    """Round every corner of a polygon by an arc that touches both of its sides.

    Parameters
    ----------
    corners : sequence of Corner
        Three or more, in order; the line is closed from the last to the first.

    Raises
    ------
    PatternError
        When a radius is not positive, or a side is too short for the arcs at its two ends.
    """
    for corner in corners:
        if not corner.radius_mm > 0:
            raise PatternError(
                f"the corner at ({corner.x_mm:g}, {corner.y_mm:g}) mm has a radius of "
                f"{corner.radius_mm:g} mm: sharp corners tear, it must be greater than 0"
            )
    count = len(corners)
    fillets = [
        _fillet(corners[k - 1], corner, corners[(k + 1) % count])
        for k, corner in enumerate(corners)
    ]
    pieces: list[Piece] = []
    for k, fillet in enumerate(fillets):
        _check_side(corners[k - 1], corners[k], fillets[k - 1], fillet)
        pieces += _side(fillets[k - 1].leaves_mm, fillet.enters_mm)
        pieces += [fillet.arc] if fillet.arc else []
    return Contour(tuple(pieces))


def _fillet(before: Corner, corner: Corner, after: Corner) -> _Fillet:
    in_x, in_y = _direction(before, corner)
    out_x, out_y = _direction(corner, after)
    turn = atan2(in_x * out_y - in_y * out_x, in_x * out_x + in_y * out_y)
    back = corner.radius_mm * tan(abs(turn) / 2)
    enters = corner.x_mm - back * in_x, corner.y_mm - back * in_y
    leaves = corner.x_mm + back * out_x, corner.y_mm + back * out_y
    if turn == 0:
        return _Fillet(enters, leaves, None, back)
    to_centre = copysign(corner.radius_mm, turn)
    centre = enters[0] - to_centre * in_y, enters[1] + to_centre * in_x
    start = atan2(in_y, in_x) - copysign(pi / 2, turn)
    return _Fillet(enters, leaves, Arc(*centre, corner.radius_mm, start, turn), back)


def _direction(start: Corner, end: Corner) -> tuple[float, float]:
    length = _side_mm(start, end)
    if length <= _ROUNDOFF_MM:
        raise PatternError(f"two corners lie on one another at ({end.x_mm:g}, {end.y_mm:g}) mm")
    return (end.x_mm - start.x_mm) / length, (end.y_mm - start.y_mm) / length


def _side_mm(start: Corner, end: Corner) -> float:
    return hypot(end.x_mm - start.x_mm, end.y_mm - start.y_mm)


def _check_side(start: Corner, end: Corner, before: _Fillet, after: _Fillet) -> None:
    needed, side = before.cut_back_mm + after.cut_back_mm, _side_mm(start, end)
    if not needed <= side + _ROUNDOFF_MM:
        raise PatternError(
            f"the side from ({start.x_mm:g}, {start.y_mm:g}) to ({end.x_mm:g}, {end.y_mm:g}) mm is "
            f"{side:.3f} mm long: its corners, of radius {start.radius_mm:g} and "
            f"{end.radius_mm:g} mm, need {needed:.3f} mm"
        )


def _side(start_mm: tuple[float, float], end_mm: tuple[float, float]) -> list[Piece]:
    line = Line(*start_mm, *end_mm)
    return [line] if line.length_mm > _ROUNDOFF_MM else []
