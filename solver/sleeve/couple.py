"""The couple with which a sleeve bends its beam.

Neighbouring loops press on each other at their crests alone, which are hinges about the direction
across the beam: the row's push F runs through the crests, at a height o over the beam's middle.
What holds the loops to the beam between their crests pushes across the beam, and the beam carries
the opposite pull, so that every section between the ends feels the couple F o. On a beam whose
curvature κ lengthens the sleeve the crests stand at p' = p (1 + κ o(p')). With U(p) the energy of a
loop the sleeve has the energy U(p')/p per length of beam; its couple is what that falls by,

    M(κ) = -(1/p) dU(p')/dκ = F(p') o(p') / (1 - p κ o'(p')),          M(0) = F o,
    -dM/dκ = p (K o² - 2 F o o') at κ = 0,  K = -dF/dp,  o' = do/dp.

The second line is a bending stiffness that the sleeve adds to the beam's.
"""

from __future__ import annotations

from dataclasses import dataclass

from solver.sleeve.cell import SleeveCell
from solver.sleeve.pressed import PressedLoop, press
from solver.sleeve.seat import Seat

SHARE = 0.02
"""Of the pitch, to both sides, over which slopes by the pitch are taken."""

_FIXED_POINT_STEPS = 8
_FIXED = 1e-5
"""Relative; each step brings the pitch nearer by the factor p κ o', a few hundredths."""


@dataclass(frozen=True)
class SleeveCouple:
    """A sleeve at its pitch on the straight beam.

    Attributes
    ----------
    pressed : PressedLoop
    arm_m : float
        o, height of the crests over the beam's middle.
    tip_height_m : float
        Height of the wire's outermost point over the beam's face.
    pitch_stiffness_N_m : float
        K = −dF/dp.
    arm_slope : float
        o' = do/dp.
    """

    pressed: PressedLoop
    arm_m: float
    tip_height_m: float
    pitch_stiffness_N_m: float  # noqa: N815 - the units' own names
    arm_slope: float

    @property
    def force_N(self) -> float:  # noqa: N802
        """F, push of the row along the beam."""
        return self.pressed.force_N

    @property
    def couple_N_m(self) -> float:  # noqa: N802
        """F o, bending moment on the beam along the sleeve."""
        return self.force_N * self.arm_m

    @property
    def bending_stiffness_N_m2(self) -> float:  # noqa: N802
        """What the sleeve adds to the beam's bending stiffness, p (K o² − 2 F o o').

        That of docs/theory.md, eq. (19).
        """
        slope = self.pitch_stiffness_N_m * self.arm_m - 2 * self.force_N * self.arm_slope
        return self.pressed.pitch_m * self.arm_m * slope


def sleeve_couple(
    cell: SleeveCell, seat: Seat, pitch_m: float, *, start: PressedLoop | None = None
) -> SleeveCouple:
    """Hold a sleeve at a pitch on a straight beam.

    Slopes are centred differences over ± `SHARE` of the pitch: 0.4 % of them by the pitch's own
    square, where the forces' curve bends within about a diameter.

    Raises
    ------
    SceneError
        When the pitch is out of range or the beam too wide.
    NotConvergedError
        When there is no shape to rely on.
    """
    here = press(cell, pitch_m, start=start)
    step = SHARE * pitch_m
    below, above = (press(cell, pitch_m + side * step, start=here) for side in (-1, 1))
    return SleeveCouple(
        pressed=here,
        arm_m=seat.crest_m(here),
        tip_height_m=seat.tip_m(here),
        pitch_stiffness_N_m=(below.force_N - above.force_N) / (2 * step),
        arm_slope=(seat.crest_m(above) - seat.crest_m(below)) / (2 * step),
    )


def couple_on_curve(flat: SleeveCouple, seat: Seat, curvature_per_m: float) -> float:
    """Couple M(κ) in N m of a sleeve on a bent beam, without small curvatures assumed.

    That of docs/theory.md, eq. (18). A sleeve that is lengthened past its free pitch comes off its
    hooks, and has no couple.

    Parameters
    ----------
    curvature_per_m : float
        κ, greater than 0 where it lengthens the sleeve.

    Raises
    ------
    SceneError, NotConvergedError
        As `sleeve_couple`.
    """
    pitch, cell = flat.pressed.pitch_m, flat.pressed.cell
    stretched, arm, own = pitch, flat.arm_m, flat.pressed
    for _ in range(_FIXED_POINT_STEPS):
        last, stretched = stretched, pitch * (1 + curvature_per_m * arm)
        if abs(stretched - last) < _FIXED * pitch:
            break
        own = press(cell, stretched, start=own)
        arm = seat.crest_m(own)
    bent = sleeve_couple(cell, seat, stretched, start=own)
    return max(0.0, bent.couple_N_m) / (1 - pitch * curvature_per_m * bent.arm_slope)
