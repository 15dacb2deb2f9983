"""Barbs on a beam's long edges that hold a compressed sleeve."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

from patterns.errors import PatternError
from patterns.positive import check_positive
from patterns.rivets import RivetHoles
from patterns.rounding import Corner


@dataclass(frozen=True, slots=True)
class Barb:
    """The shape of a barb; it stands on a long edge and faces the sleeve.

    It is added to the strip rather than cut into it: the strip keeps its width, and so its bending
    stiffness, and polycarbonate tears from notches.

    Attributes
    ----------
    height_mm : float
        Over the edge: three diameters of 0.5 mm wire, so that the end loop, its tie and the fabric
        lie below the tip.
    undercut_mm : float
        How far the tip leans over the sleeve's end: pushing then draws the loop down to the edge.
    land_mm : float
        From the foot back to where the ramp begins. With the ramp it is the root that carries
        the sleeve's push: 0.5 N (the paper's blocking force) on a tip 1.5 mm high bends a root of
        4 mm in 0.38 mm sheet with less than 1 MPa; polycarbonate yields at 66 MPa (ISO 527).
    ramp_mm : float
        Length of the sloping back, over which the sleeve is pushed on; twice the height is gentle
        enough for a loop to ride up.
    foot_radius_mm, tip_radius_mm : float
        Of the corner in which the loop comes to rest and of the barb's other corners.
    """

    height_mm: float = 1.5
    undercut_mm: float = 0.4
    land_mm: float = 1.0
    ramp_mm: float = 3.0
    foot_radius_mm: float = 0.4
    tip_radius_mm: float = 0.4

    def __post_init__(self) -> None:
        """Refuse what is no barb."""
        check_positive(
            "barb",
            height_mm=self.height_mm,
            undercut_mm=self.undercut_mm,
            land_mm=self.land_mm,
            ramp_mm=self.ramp_mm,
            foot_radius_mm=self.foot_radius_mm,
            tip_radius_mm=self.tip_radius_mm,
        )

    @property
    def root_mm(self) -> float:
        """Length along the edge on which the barb stands."""
        return self.land_mm + self.ramp_mm

    @property
    def reach_mm(self) -> float:
        """Length along the edge, from the foot, that its round corners can take up at most."""
        return self.root_mm + self.foot_radius_mm

    def corners(self, foot_mm: float, edge_mm: float, facing: int) -> tuple[Corner, ...]:
        """Give a barb's corners in rising x.

        Parameters
        ----------
        foot_mm : float
            Where the face that holds the sleeve meets the edge.
        edge_mm : float
            Height of the edge on which it stands.
        facing : int
            1 when the sleeve lies on its right, -1 when on its left.
        """
        away, top = -facing, edge_mm + self.height_mm
        corners = (
            Corner(foot_mm + away * self.root_mm, edge_mm, self.foot_radius_mm),
            Corner(foot_mm + away * self.land_mm, top, self.tip_radius_mm),
            Corner(foot_mm - away * self.undercut_mm, top, self.tip_radius_mm),
            Corner(foot_mm, edge_mm, self.foot_radius_mm),
        )
        return corners if facing > 0 else corners[::-1]


@dataclass(frozen=True, slots=True)
class SleevePlace:
    """Where a compressed sleeve lies on a strip.

    Attributes
    ----------
    start_mm : float
        Its left end, from the strip's left end.
    length_mm : float
        From foot to foot of the barbs that hold it.
    """

    start_mm: float
    length_mm: float

    def __post_init__(self) -> None:
        """Refuse what is no place."""
        check_positive("sleeve", length_mm=self.length_mm)
        if not isfinite(self.start_mm):
            raise PatternError(f"no sleeve that starts at {self.start_mm:g} mm")

    @property
    def end_mm(self) -> float:
        """Its right end."""
        return self.start_mm + self.length_mm


def sleeves_on_left_halves(rivets: RivetHoles, length_mm: float) -> tuple[SleevePlace, ...]:
    """Centre a sleeve of ``length_mm`` between each segment's first hole and its middle."""
    edge = rivets.diameter_mm / 2
    return tuple(
        SleevePlace((start + edge + (start + end) / 2 - length_mm) / 2, length_mm)
        for start, end in rivets.segments_mm
    )
