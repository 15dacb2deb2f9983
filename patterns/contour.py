"""A closed cut line of straight lines and circular arcs, kept exact."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, sin, tan

import numpy as np
from numpy.typing import NDArray

from patterns.errors import PatternError
from patterns.outline import CHORD_TOLERANCE_MM, Ring
from patterns.path import Arc, Line, Piece, WirePath


@dataclass(frozen=True, slots=True)
class Contour:
    """A closed line without kinks, each piece beginning where the one before it ends.

    The material lies on its left: an outside runs counter-clockwise, an opening clockwise.
    """

    pieces: tuple[Piece, ...]

    @property
    def path(self) -> WirePath:
        """The line as a path that ends where it began."""
        return WirePath(self.pieces)

    @property
    def area_mm2(self) -> float:
        """Enclosed area, exact; negative when the line runs clockwise."""
        return sum(_swept_mm2(piece) for piece in self.pieces)

    @property
    def sharpest_inner(self) -> Arc | None:
        """The arc of smallest radius that reaches into the material."""
        inner = [p for p in self.pieces if isinstance(p, Arc) and p.sweep_rad < 0]
        return min(inner, key=lambda arc: arc.radius_mm, default=None)

    def ring(self, tolerance_mm: float = CHORD_TOLERANCE_MM) -> Ring:
        """Give the corners of a polygon whose sides stay within ``tolerance_mm`` of the line."""
        return self.path.polyline(tolerance_mm)[:-1]

    def vertices(self) -> NDArray[np.float64]:
        """Give x, y and bulge of each vertex, (n, 3), exact.

        A bulge is the tangent of a quarter of the arc's angle, positive counter-clockwise
        (Autodesk, DXF reference, LWPOLYLINE, group code 42).
        """
        return np.array([(*_start_mm(piece), _bulge(piece)) for piece in self.pieces])

    def reversed(self) -> Contour:
        """Give the same line run the other way."""
        return Contour(tuple(_reversed(piece) for piece in reversed(self.pieces)))

    def moved(self, x_mm: float, y_mm: float) -> Contour:
        """Shift the line."""
        return Contour(tuple(_moved(piece, x_mm, y_mm) for piece in self.pieces))

    def quarter_turned(self) -> Contour:
        """Turn the line counter-clockwise by a right angle about the origin."""
        return Contour(tuple(_quarter_turned(piece) for piece in self.pieces))

    def from_longest_line(self) -> Contour:
        """Begin with the longest straight piece, where a blade's entry is hurt least."""
        lengths = [p.length_mm if isinstance(p, Line) else 0.0 for p in self.pieces]
        first = lengths.index(max(lengths))
        return Contour((*self.pieces[first:], *self.pieces[:first]))

    def offset(self, by_mm: float) -> Contour:
        """Move the line away from the material by ``by_mm``: exact, since it has no kinks.

        Raises
        ------
        PatternError
            When an inner corner's radius is not greater than that.
        """
        sharpest = self.sharpest_inner
        if sharpest and sharpest.radius_mm <= by_mm:
            raise PatternError(
                f"an inner corner of radius {sharpest.radius_mm:g} mm cannot be cut "
                f"{by_mm:g} mm beside the line: the radius must be greater than half the kerf"
            )
        return Contour(tuple(_offset(piece, by_mm) for piece in self.pieces))


def _swept_mm2(piece: Piece) -> float:
    """Integral of (x dy - y dx) / 2 along a piece (Green's theorem)."""
    if isinstance(piece, Line):
        return (piece.x0_mm * piece.y1_mm - piece.x1_mm * piece.y0_mm) / 2
    start, end = piece.start_rad, piece.start_rad + piece.sweep_rad
    across = piece.centre_x_mm * (sin(end) - sin(start))
    along = piece.centre_y_mm * (cos(end) - cos(start))
    return piece.radius_mm * (piece.radius_mm * piece.sweep_rad + across - along) / 2


def _start_mm(piece: Piece) -> tuple[float, float]:
    if isinstance(piece, Line):
        return piece.x0_mm, piece.y0_mm
    x_mm = piece.centre_x_mm + piece.radius_mm * cos(piece.start_rad)
    return x_mm, piece.centre_y_mm + piece.radius_mm * sin(piece.start_rad)


def _bulge(piece: Piece) -> float:
    return tan(piece.sweep_rad / 4) if isinstance(piece, Arc) else 0.0


def _reversed(piece: Piece) -> Piece:
    if isinstance(piece, Line):
        return Line(piece.x1_mm, piece.y1_mm, piece.x0_mm, piece.y0_mm)
    centre, radius = (piece.centre_x_mm, piece.centre_y_mm), piece.radius_mm
    return Arc(*centre, radius, piece.start_rad + piece.sweep_rad, -piece.sweep_rad)


def _moved(piece: Piece, x_mm: float, y_mm: float) -> Piece:
    if isinstance(piece, Line):
        start = piece.x0_mm + x_mm, piece.y0_mm + y_mm
        return Line(*start, piece.x1_mm + x_mm, piece.y1_mm + y_mm)
    centre = piece.centre_x_mm + x_mm, piece.centre_y_mm + y_mm
    return Arc(*centre, piece.radius_mm, piece.start_rad, piece.sweep_rad)


def _quarter_turned(piece: Piece) -> Piece:
    if isinstance(piece, Line):
        return Line(-piece.y0_mm, piece.x0_mm, -piece.y1_mm, piece.x1_mm)
    centre = -piece.centre_y_mm, piece.centre_x_mm
    return Arc(*centre, piece.radius_mm, piece.start_rad + pi / 2, piece.sweep_rad)


def _offset(piece: Piece, by_mm: float) -> Piece:
    if isinstance(piece, Line):
        along_x = (piece.x1_mm - piece.x0_mm) / piece.length_mm
        along_y = (piece.y1_mm - piece.y0_mm) / piece.length_mm
        return _moved(piece, by_mm * along_y, -by_mm * along_x)
    radius = piece.radius_mm + (by_mm if piece.sweep_rad > 0 else -by_mm)
    return Arc(piece.centre_x_mm, piece.centre_y_mm, radius, piece.start_rad, piece.sweep_rad)
