"""The convection coefficient that one measured temperature tells."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from solver.actuation.heating import Heating
from solver.actuation.wire import MELTING_C, HeatedWire, Surroundings, at_rest
from solver.errors import SceneError

LARGEST_W_M2K = 1e5
"""Of boiling water and the like: no wire in a fabric is cooled better."""


@dataclass(frozen=True, slots=True)
class Measured:
    """A wire's temperature after a time at a current, from the temperature around it on.

    Raises
    ------
    SceneError
        When a number is out of its range.
    """

    current_A: float  # noqa: N815 - the unit's own spelling
    time_s: float
    temperature_C: float  # noqa: N815

    def __post_init__(self) -> None:
        for key in ("current_A", "time_s"):
            value = float(getattr(self, key))
            if not (value > 0 and math.isfinite(value)):
                raise SceneError(f"{key} = {value:g}: must be greater than 0 and finite")
        if not self.temperature_C < MELTING_C:
            raise SceneError(f"temperature_C = {self.temperature_C:g}: the wire would have melted")


def calibrated(wire: HeatedWire, ambient_C: float, measured: Measured) -> Surroundings:  # noqa: N803
    """Give the surroundings in which the wire has the measured temperature.

    Raises
    ------
    SceneError
        When the current cannot heat the wire so far even without any loss, or the wire is no
        warmer than with the largest loss.
    """

    def excess(convection: float) -> float:
        around = Surroundings(ambient_C, convection)
        heating = Heating(wire, around, at_rest(wire, ambient_C), measured.current_A)
        try:
            reached = heating.at(np.array([measured.time_s])).last.temperature_C
        except SceneError:  # it melts
            reached = MELTING_C
        return reached - measured.temperature_C

    if excess(0.0) < 0:
        raise SceneError(
            f"temperature_C = {measured.temperature_C:g}: {measured.current_A:g} A heat the wire "
            f"to no more than {excess(0.0) + measured.temperature_C:.4g} in {measured.time_s:g} s, "
            "even if it keeps all its heat; check the current, the time and the wire's diameter"
        )
    if excess(LARGEST_W_M2K) > 0:
        raise SceneError(
            f"temperature_C = {measured.temperature_C:g}: must be greater than "
            f"{excess(LARGEST_W_M2K) + measured.temperature_C:.4g}, which the wire has even if it "
            "is cooled by boiling water; check ambient_C"
        )
    return Surroundings(ambient_C, float(brentq(excess, 0.0, LARGEST_W_M2K, xtol=1e-9)))
