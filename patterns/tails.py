"""The two tails of a wire: straight, or bent outward where there is no room beside the loop."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, sin

from patterns.loop import Loop
from patterns.path import Arc, Line, Piece


@dataclass(frozen=True, slots=True)
class Exit:
    """Where the tails of a wire leave a loop.

    Attributes
    ----------
    loop : int
        The loop.
    angle_rad : float
        Place on the loop: the direction of its outward normal there.
    bend_mm : float or None
        Radius with which both tails turn away from the loop, by a right angle; none when they stay
        on the tangent.
    """

    loop: int
    angle_rad: float
    bend_mm: float | None = None


def tail_pieces(
    loop: Loop, angle_rad: float, length_mm: float, bend_mm: float | None = None
) -> tuple[tuple[Piece, ...], tuple[Piece, ...]]:
    """Lay the tails on which a wire comes to a loop and leaves it, clockwise.

    Parameters
    ----------
    length_mm
        Length of the straight part of each.
    bend_mm
        As in `Exit`.
    """
    outward = (cos(angle_rad), sin(angle_rad))
    along = (outward[1], -outward[0])
    point = loop.point_mm(angle_rad)
    if bend_mm is None:
        before, after = _moved(point, along, -length_mm), _moved(point, along, length_mm)
        return (Line(*before, *point),), (Line(*point, *after),)
    centre = _moved(point, outward, bend_mm)
    comes, goes = _moved(centre, along, -bend_mm), _moved(centre, along, bend_mm)
    # seen from the centre of both bends the loop lies at the angle plus half a turn
    quarter, facing = pi / 2, angle_rad + pi
    return (
        (
            Line(*_moved(comes, outward, length_mm), *comes),
            Arc(*centre, bend_mm, facing - quarter, quarter),
        ),
        (
            Arc(*centre, bend_mm, facing, quarter),
            Line(*goes, *_moved(goes, outward, length_mm)),
        ),
    )


def _moved(
    point: tuple[float, float], way: tuple[float, float], by_mm: float
) -> tuple[float, float]:
    return point[0] + by_mm * way[0], point[1] + by_mm * way[1]
