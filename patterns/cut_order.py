"""In which order lines are cut, and how far past its start each is cut again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import dist, isfinite, pi

from patterns.contour import Contour
from patterns.cut_piece import CutPiece, Hole
from patterns.errors import PatternError
from patterns.kerf import compensated
from patterns.outline import CHORD_TOLERANCE_MM
from patterns.path import Arc, Line, Piece, Vectors, WirePath


@dataclass(frozen=True, slots=True)
class Cut:
    """A closed line that the machine cuts.

    Attributes
    ----------
    piece : str
        Name of the piece to which it belongs.
    line : Contour or Hole
        Where the middle of the blade runs.
    inner : bool
        Whether it is a hole or an opening; these come before the outside frees the piece.
    overcut_mm : float
        How far past its start it goes on, so that the ends of the cut meet.
    """

    piece: str
    line: Contour | Hole
    inner: bool
    overcut_mm: float

    @property
    def start_mm(self) -> tuple[float, float]:
        """Where the blade goes in, and (but for the overcut) comes out."""
        x, y, _ = self._contour.vertices()[0].tolist()
        return x, y

    def polyline(self, tolerance_mm: float = CHORD_TOLERANCE_MM) -> Vectors:
        """Give the blade's way (n, 2), once round and on through the overcut."""
        return self.way.polyline(tolerance_mm)

    @property
    def way(self) -> WirePath:
        """The blade's way in lines and arcs, once round and on through the overcut."""
        pieces = self._contour.pieces
        return WirePath((*pieces, *_beginning(pieces, self.overcut_mm)))

    @property
    def _contour(self) -> Contour:
        if isinstance(self.line, Contour):
            return self.line
        hole = self.line
        # clockwise: the material lies on the left
        return Contour((Arc(hole.x_mm, hole.y_mm, hole.diameter_mm / 2, 0.0, -2 * pi),))


def cuts_in_order(pieces: Sequence[CutPiece], kerf_mm: float, overcut_mm: float) -> tuple[Cut, ...]:
    """Order all cuts of a sheet: piece after piece, inner lines first, always the nearest next.

    A piece is finished before the next is begun, so that none shifts while others are cut.

    Parameters
    ----------
    pieces : sequence of CutPiece
        On the sheet, as they shall come out.
    kerf_mm : float
        Width of the cut; as in `patterns.kerf.compensated`.
    overcut_mm : float
        1 to 2 mm for drag knives, 0 for lasers.

    Raises
    ------
    PatternError
        When the overcut is negative, or the kerf is too wide for a line.
    """
    if not (isfinite(overcut_mm) and overcut_mm >= 0):
        raise PatternError(f"the overcut is {overcut_mm:g} mm; it must not be negative")
    waiting = [_cuts(compensated(piece, kerf_mm), overcut_mm) for piece in pieces]
    done: list[Cut] = []
    head = (0.0, 0.0)
    while waiting:
        inner, outside = waiting.pop(_nearest(head, [_entries(one) for one in waiting]))
        while inner:
            done.append(inner.pop(_nearest(head, [[cut.start_mm] for cut in inner])))
            head = done[-1].start_mm
        done.append(outside)
        head = outside.start_mm
    return tuple(done)


def travel_mm(cuts: Sequence[Cut]) -> float:
    """Length of the head's way between cuts, from the sheet's origin."""
    places = [(0.0, 0.0), *(cut.start_mm for cut in cuts)]
    return sum(dist(here, there) for here, there in pairwise(places))


_Waiting = tuple[list[Cut], Cut]
"""What is left to cut of a piece: its inner lines, and its outside."""


def _cuts(piece: CutPiece, overcut_mm: float) -> _Waiting:
    lines = [*piece.holes, *(one.from_longest_line() for one in piece.openings)]
    inner = [Cut(piece.name, line, True, overcut_mm) for line in lines]
    return inner, Cut(piece.name, piece.outside.from_longest_line(), False, overcut_mm)


def _entries(waiting: _Waiting) -> list[tuple[float, float]]:
    inner, outside = waiting
    return [cut.start_mm for cut in inner or [outside]]


def _nearest(head: tuple[float, float], places: list[list[tuple[float, float]]]) -> int:
    """Index of the list with the nearest place; the first of equals."""
    away = [min(dist(head, place) for place in some) for some in places]
    return away.index(min(away))


def _beginning(pieces: tuple[Piece, ...], length_mm: float) -> list[Piece]:
    """Pieces up to a length along a line, at most once round."""
    result: list[Piece] = []
    for piece in pieces:
        if length_mm <= 0:
            break
        share = min(1.0, length_mm / piece.length_mm)
        result.append(_shortened(piece, share))
        length_mm -= piece.length_mm
    return result


def _shortened(piece: Piece, share: float) -> Piece:
    if isinstance(piece, Line):
        x_mm = piece.x0_mm + share * (piece.x1_mm - piece.x0_mm)
        return Line(
            piece.x0_mm, piece.y0_mm, x_mm, piece.y0_mm + share * (piece.y1_mm - piece.y0_mm)
        )
    centre = piece.centre_x_mm, piece.centre_y_mm
    return Arc(*centre, piece.radius_mm, piece.start_rad, share * piece.sweep_rad)
