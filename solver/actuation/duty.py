"""Current that is switched on and off, and what the wire goes through."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.actuation.heating import Course, Heating
from solver.actuation.wire import HeatedWire, Surroundings, WireState
from solver.errors import SceneError

Values = NDArray[np.float64]

MOST_CYCLES = 1000


@dataclass(frozen=True, slots=True)
class Interval:
    """A current for a time, in A and s."""

    current_A: float  # noqa: N815 - the unit's own spelling
    duration_s: float


@dataclass(frozen=True, slots=True)
class Duty:
    """Cycles of heating and cooling.

    Attributes
    ----------
    current_A : float
        While it heats; at least 0.
    heating_s, cooling_s : float
        Greater than 0, and at least 0.
    cycles : int
        From 1 to 1000.

    Raises
    ------
    SceneError
        When a number is out of its range.
    """

    current_A: float  # noqa: N815
    heating_s: float
    cooling_s: float
    cycles: int = 1

    def __post_init__(self) -> None:
        if not (self.current_A >= 0 and math.isfinite(self.current_A)):
            raise SceneError(f"current_A = {self.current_A:g}: must be at least 0 and finite")
        if not (self.heating_s > 0 and math.isfinite(self.heating_s)):
            raise SceneError(f"heating_s = {self.heating_s:g}: must be greater than 0 and finite")
        if not (self.cooling_s >= 0 and math.isfinite(self.cooling_s)):
            raise SceneError(f"cooling_s = {self.cooling_s:g}: must be at least 0 and finite")
        if not 1 <= self.cycles <= MOST_CYCLES:
            raise SceneError(f"cycles = {self.cycles:g}: must be from 1 to {MOST_CYCLES}")

    @property
    def intervals(self) -> tuple[Interval, ...]:
        """Heating and cooling in turn."""
        on, off = Interval(self.current_A, self.heating_s), Interval(0.0, self.cooling_s)
        return ((on, off) if self.cooling_s > 0 else (on,)) * self.cycles


@dataclass(frozen=True, eq=False)
class History:
    """A wire's course through several intervals; ``current_A`` (n,) goes with each time.

    The states at a switch stand twice, with the current before and after it.
    """

    course: Course
    current_A: Values  # noqa: N815


def follow(
    wire: HeatedWire,
    surroundings: Surroundings,
    start: WireState,
    intervals: Sequence[Interval],
    *,
    samples: int = 101,
) -> History:
    """Heat and cool a wire, from one interval to the next.

    Parameters
    ----------
    samples : int
        Times per interval, evenly spaced with both ends.

    Raises
    ------
    SceneError
        When the wire would melt.
    """
    courses = list(_courses(wire, surroundings, start, intervals, samples))
    current = np.repeat([one.current_A for one in intervals], samples)
    names = ("time_s", "temperature_C", "fraction", "joule_J_m", "loss_J_m")
    whole = Course(*(np.concatenate([getattr(one, name) for one in courses]) for name in names))
    return History(whole, current)


def _courses(
    wire: HeatedWire,
    surroundings: Surroundings,
    start: WireState,
    intervals: Sequence[Interval],
    samples: int,
) -> Iterator[Course]:
    state, time, joule, loss = start, 0.0, 0.0, 0.0
    for one in intervals:
        heating = Heating(wire, surroundings, state, one.current_A)
        own = heating.at(np.linspace(0.0, one.duration_s, samples))
        yield Course(
            own.time_s + time,
            own.temperature_C,
            own.fraction,
            own.joule_J_m + joule,
            own.loss_J_m + loss,
        )
        state, time = own.last, time + one.duration_s
        joule, loss = joule + float(own.joule_J_m[-1]), loss + float(own.loss_J_m[-1])
