"""Polycarbonate strips: the beams inside the sleeves, and the shorter ones that buckle them."""

from __future__ import annotations

from dataclasses import dataclass, field

from patterns.contour import Contour
from patterns.cut_piece import CutPiece
from patterns.errors import PatternError
from patterns.hooks import Barb, SleevePlace
from patterns.positive import check_positive
from patterns.rivets import RivetHoles
from patterns.rounding import Corner, rounded


@dataclass(frozen=True, slots=True)
class Beam:
    """A strip with rivet holes, and barbs that hold sleeves on it.

    Attributes
    ----------
    length_mm, width_mm : float
        Of the strip, without barbs.
    rivets : RivetHoles
        At the ends and where segments join.
    corner_radius_mm : float
        Of the strip's four corners.
    sleeves : tuple of SleevePlace
        Where compressed sleeves are held, from left to right.
    barb : Barb
        The shape of all barbs.
    """

    length_mm: float
    width_mm: float
    rivets: RivetHoles
    corner_radius_mm: float = 2.0
    sleeves: tuple[SleevePlace, ...] = ()
    barb: Barb = field(default_factory=Barb)

    def __post_init__(self) -> None:
        """Refuse what is no strip."""
        _check_strip(self)

    @property
    def hook_height_mm(self) -> float:
        """How far barbs stand out on each side."""
        return self.barb.height_mm if self.sleeves else 0.0

    def edge_corners(self) -> tuple[Corner, ...]:
        """Corners of the upper edge from left to right; the beam's centre is the origin."""
        left, edge = -self.length_mm / 2, self.width_mm / 2
        corners = [Corner(left, edge, self.corner_radius_mm)]
        for sleeve in self.sleeves:
            corners += self.barb.corners(left + sleeve.start_mm, edge, 1)
            corners += self.barb.corners(left + sleeve.end_mm, edge, -1)
        return (*corners, Corner(-left, edge, self.corner_radius_mm))

    def piece(self, name: str = "beam") -> CutPiece:
        """Give the piece to cut, its centre at the origin and its axis along x.

        Raises
        ------
        PatternError
            When rounded corners have no room; `patterns.beam_rules.check_beam` says what else is
            wrong.
        """
        upper = self.edge_corners()
        outside = rounded((*below(upper), *reversed(upper)))
        return CutPiece(name, outside, self.rivets.holes(self.length_mm))


@dataclass(frozen=True, slots=True)
class ConstraintStrip:
    """A strip riveted to both ends of a segment that is longer, so that the segment buckles.

    It is riveted to one face of the beam, which in its other state arches to the other side: beam
    and sleeves then pass through the strip's window, between two rails.

    Attributes
    ----------
    length_mm, width_mm : float
        Of the strip, with its rails.
    rivets : RivetHoles
        Two holes.
    corner_radius_mm : float
        Of its four corners, and of the window's.
    window_mm : float
        Width of the window, which ends as far from the holes' centres as the strip does; 0 is a
        strip without.
    """

    length_mm: float
    width_mm: float
    rivets: RivetHoles
    corner_radius_mm: float = 2.0
    window_mm: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what is no strip."""
        _check_strip(self)
        if not 0 <= self.window_mm < self.width_mm:
            raise PatternError(
                f"no window of {self.window_mm:g} mm in a strip of {self.width_mm:g} mm: it must "
                "be narrower"
            )

    @property
    def hole_distance_mm(self) -> float:
        """From its first hole to its last: the chord that it forces on a segment."""
        return self.rivets.positions_mm[-1] - self.rivets.positions_mm[0]

    def piece(self, name: str = "constraint") -> CutPiece:
        """Give the piece to cut, its centre at the origin and its axis along x.

        Raises
        ------
        PatternError
            When rounded corners have no room.
        """
        outside = self._box(self.length_mm / 2, self.width_mm / 2)
        beside_hole = (self.length_mm - self.hole_distance_mm) / 2
        inner = self.hole_distance_mm / 2 - beside_hole, self.window_mm / 2
        openings = (self._box(*inner).reversed(),) if self.window_mm else ()
        return CutPiece(name, outside, self.rivets.holes(self.length_mm), openings)

    def _box(self, x_mm: float, y_mm: float) -> Contour:
        """Draw the round box of half a length and half a width."""
        if x_mm <= 0:
            raise PatternError("the strip's two ends leave no room for a window between them")
        upper = tuple(Corner(x, y_mm, self.corner_radius_mm) for x in (-x_mm, x_mm))
        return rounded((*below(upper), *reversed(upper)))


def below(corners: tuple[Corner, ...]) -> tuple[Corner, ...]:
    """Mirror an upper edge into the lower one, still from left to right."""
    return tuple(Corner(corner.x_mm, -corner.y_mm, corner.radius_mm) for corner in corners)


def _check_strip(strip: Beam | ConstraintStrip) -> None:
    check_positive(
        "strip",
        length_mm=strip.length_mm,
        width_mm=strip.width_mm,
        corner_radius_mm=strip.corner_radius_mm,
        hole_diameter_mm=strip.rivets.diameter_mm,
    )
