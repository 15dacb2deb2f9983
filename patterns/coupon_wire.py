"""The wire of a coupon: three straight lines to and fro, and back over the third in waves."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt

from patterns.circuit import Circuit, Crossing, CrossingKind
from patterns.couching import FREE_TAIL_MM
from patterns.layout import Layout
from patterns.path import Arc, Line, Piece, WirePath

END_MM = 22.0
"""Straight wire at the end of the waves: the free tail, and some that is tied down."""

LABEL_ROOM_MM = 9.0
"""Room above the first line for its labels."""

LOCK_ROOM_MM = 4.0

Stretch = tuple[float, float, tuple[str, int]]
"""Begin and end along the first stage, and the cell: its row and number; 0 for what is none."""


@dataclass(frozen=True)
class CouponWire:
    """A coupon's wire.

    Attributes
    ----------
    circuit : Circuit
        In two stages, without loops; its crossings are those of the waves with the third line, in
        the order of the cells.
    steps : int
        Cells in a row.
    radius_mm : float
        Of every bend.
    left_mm, right_mm : float
        Where the lines begin and end.
    line_mm : tuple of float
        Height of the three lines.
    """

    circuit: Circuit
    steps: int
    radius_mm: float
    left_mm: float
    right_mm: float
    line_mm: tuple[float, float, float]

    @property
    def width_mm(self) -> float:
        """Width of the whole coupon."""
        return 2 * (self.right_mm + self.radius_mm) + 4.0

    @property
    def height_mm(self) -> float:
        """Height of the whole coupon."""
        return 2 * (self.line_mm[0] + LABEL_ROOM_MM)

    @property
    def wave_mm(self) -> float:
        """How far the waves go above the third line."""
        return self.radius_mm * (1 - sqrt(0.5))

    def cell_mm(self, row: str, number: int) -> tuple[float, float]:
        """Middle of a cell."""
        if row == "cover":
            crossing = self.circuit.crossings[number - 1]
            return crossing.x_mm, crossing.y_mm
        share = (number - 0.5) / self.steps
        line = self.line_mm[0 if row == "width" else 1]
        return self.left_mm + share * (self.right_mm - self.left_mm), line

    @property
    def stretches(self) -> tuple[Stretch, ...]:
        """How the first stage is divided, from the end of its free tail to its own end."""
        length, turn = self.right_mm - self.left_mm, pi * self.radius_mm
        cell = length / self.steps
        begin = FREE_TAIL_MM + LOCK_ROOM_MM
        second = begin + length + turn
        third = second + length + turn
        numbers = range(1, self.steps + 1)
        widths = [(begin + (k - 1) * cell, begin + k * cell, ("width", k)) for k in numbers]
        # the second line runs to the left
        back = [
            (
                second + (self.steps - k) * cell,
                second + (self.steps - k + 1) * cell,
                ("interval", k),
            )
            for k in reversed(numbers)
        ]
        return (
            (FREE_TAIL_MM, begin, ("", 0)),
            *widths,
            (begin + length, second, ("", 0)),
            *back,
            (second + length, third, ("", 0)),
            (third, third + length, ("", 0)),
        )


def coupon_wire(radius_mm: float, steps: int) -> CouponWire:
    """Lay the wire of a coupon about the origin.

    Parameters
    ----------
    radius_mm
        Of every bend.
    steps
        Cells in a row; an even number, so that the wire ends away from the other lines.
    """
    wave = sqrt(2) * radius_mm
    rise = (1 + sqrt(0.5)) * radius_mm
    length = sqrt(0.5) * radius_mm + rise + (steps - 1) * wave + sqrt(0.5) * END_MM
    left, right = -length / 2, length / 2
    top, middle, bottom = 3 * radius_mm, radius_mm, -radius_mm
    first = WirePath(
        (
            Line(left - FREE_TAIL_MM - LOCK_ROOM_MM, top, right, top),
            Arc(right, top - radius_mm, radius_mm, pi / 2, -pi),
            Line(right, middle, left, middle),
            Arc(left, middle - radius_mm, radius_mm, pi / 2, pi),
            Line(left, bottom, right, bottom),
        )
    )
    start = right - sqrt(0.5) * radius_mm - rise
    places = [start - k * wave for k in range(steps)]
    second = WirePath(
        (
            Arc(right, bottom - radius_mm, radius_mm, pi / 2, -5 * pi / 4),
            Line(start + rise, bottom - rise, start, bottom),
            *(_wave(x, bottom, radius_mm, k) for k, x in enumerate(places[:-1])),
            _end(places[-1], bottom),
        )
    )
    along = second.pieces[0].length_mm + second.pieces[1].length_mm
    crossings = tuple(
        Crossing(
            CrossingKind.CONTACT,
            x,
            bottom,
            first.length_mm - (right - x),
            first.length_mm + along + k * radius_mm * pi / 2,
        )
        for k, x in enumerate(places)
    )
    circuit = Circuit(Layout((), ()), (), (first, second), crossings[::-1])
    return CouponWire(circuit, steps, radius_mm, left, right, (top, middle, bottom))


def _wave(x_mm: float, y_mm: float, radius_mm: float, k: int) -> Piece:
    """One wave to the left, from a crossing to the next: above the line, then below, in turn."""
    half = sqrt(0.5) * radius_mm
    if k % 2 == 0:
        return Arc(x_mm - half, y_mm - half, radius_mm, pi / 4, pi / 2)
    return Arc(x_mm - half, y_mm + half, radius_mm, -pi / 4, -pi / 2)


def _end(x_mm: float, y_mm: float) -> Piece:
    slant = sqrt(0.5) * END_MM
    return Line(x_mm, y_mm, x_mm - slant, y_mm - slant)
