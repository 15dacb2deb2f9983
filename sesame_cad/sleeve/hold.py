"""Whether hooks hold a compressed sleeve: they must reach its ties, and the beam must not."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, radians

import numpy as np

from sesame_cad.errors import InputError
from sesame_cad.specification import Specification
from solver.sleeve.couple import SleeveCouple
from solver.sleeve.segment import SegmentPrediction


@dataclass(frozen=True, slots=True)
class Hold:
    """Where the inner ends of ties lie on a compressed sleeve: there thread passes the beam's edge.

    Attributes
    ----------
    cold_mm, hot_mm : float
        Distance from the beam's axis with both sides cold, and with both hot; with one side hot it
        lies in between.
    reach_mm : float
        From the axis to the tips of the hooks.
    """

    cold_mm: float
    hot_mm: float
    reach_mm: float

    @property
    def hot_too(self) -> bool:
        """Whether the hooks reach the ties of sleeves with both sides hot."""
        return self.reach_mm >= self.hot_mm


def hold(spec: Specification, found: SegmentPrediction) -> Hold:
    """Find where the ties of the compressed sleeve lie.

    Raises
    ------
    InputError
        When the beam has no room between the ties, or its hooks end inside the loops, where they
        hold nothing.
    """
    beam = spec.beam
    held = Hold(_tie_mm(spec, found.cold), _tie_mm(spec, found.hot), beam.reach_mm)
    lie = f"the ties of the cold, compressed sleeve lie {held.cold_mm:.2f} mm from the beam's axis"
    if beam.width_mm > 2 * held.cold_mm:
        raise InputError(
            f"{spec.name}: beam.width_mm = {beam.width_mm:g}: must be at most "
            f"{2 * held.cold_mm:.2f}: {lie}"
        )
    if held.reach_mm < held.cold_mm:
        raise InputError(
            f"{spec.name}: beam.hook_height_mm = {beam.hook_height_mm:g}: must be at least "
            f"{held.cold_mm - beam.width_mm / 2:.2f}: {lie}, and hooks inside loops hold nothing"
        )
    return held


def _tie_mm(spec: Specification, couple: SleeveCouple) -> float:
    """Distance from the axis of the inner holes, which moved with the fabric of the loop."""
    radius = spec.layout.diameter_mm / 2
    inside = np.array([1 - spec.sleeve.tie_length_mm / 2 / radius])
    angle = np.array([pi / 2 - radians(spec.sleeve.tie_angle_deg)])
    return 1e3 * float(couple.pressed.points_m(inside, angle)[0, 1])
