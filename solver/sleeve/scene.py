"""What a segment of beam with sleeves is made of."""

from __future__ import annotations

from dataclasses import dataclass, replace

from solver.errors import SceneError
from solver.sleeve.cell import SleeveCell
from solver.sleeve.couple import SleeveCouple
from solver.sleeve.seat import Seat
from solver.strip.scene import StripScene


@dataclass(frozen=True)
class BeamSegment:
    """What is riveted and hooked together, in SI units.

    Attributes
    ----------
    strip : StripScene
        The beam between its rivets and the shorter strip, without sleeves: no couples and no
        sleeves' stiffness. ``covered`` is where the sleeves are held.
    cell : SleeveCell
        A loop of the sleeves, cold.
    loops : int
        Number of loops of a sleeve, at least 1; they share the covered length evenly.
    hot_modulus_Pa : float
        Of the wire above its transition.
    fabric_thickness_m : float
    constraint_width_m, constraint_thickness_m : float
        Of the shorter strip; width of both rails together where it has a window. Sleeves pass
        through that window.
    sleeves_kg : float
        Mass of both sleeves, for what gravity would do.
    tie_angle_rad : float
        Direction from the valleys in which ties hold the two rows together, for what that would do.

    Raises
    ------
    SceneError
        When there is no loop, or a sleeve would not be compressed.
    """

    strip: StripScene
    cell: SleeveCell
    loops: int
    hot_modulus_Pa: float  # noqa: N815 - the unit's name
    fabric_thickness_m: float
    constraint_width_m: float
    constraint_thickness_m: float
    sleeves_kg: float = 0.0
    tie_angle_rad: float = 0.0

    def __post_init__(self) -> None:
        if self.loops < 1:
            raise SceneError(f"loops = {self.loops}: must be 1 or more")

    @property
    def pitch_m(self) -> float:
        """Distance of the loops' centres on the beam."""
        begin, end = self.strip.covered
        return (end - begin) * self.strip.length_m / self.loops

    @property
    def seat(self) -> Seat:
        """The beam under the sleeves."""
        return Seat(self.strip.width_m, self.strip.thickness_m, self.fabric_thickness_m)

    def loaded(self, bottom: SleeveCouple, top: SleeveCouple) -> StripScene:
        """Give the strip with its two sleeves."""
        stiffness = bottom.bending_stiffness_N_m2 + top.bending_stiffness_N_m2
        return replace(
            self.strip,
            couple_bottom_N_m=bottom.couple_N_m,
            couple_top_N_m=top.couple_N_m,
            sleeve_stiffness_N_m2=stiffness,
        )
