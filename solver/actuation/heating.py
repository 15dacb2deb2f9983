"""A wire at constant current: an exact time for every temperature on its way.

Its heat balance per metre is

    ρ A (cp + L dξ/dT) dT/dt = I² r(ξ(T)) − h π d (T − T_a) = q(T),

in which nothing depends on time. So the temperature moves one way, towards the next zero X of q, ξ
is a known function of T, and time is an integral over temperature. With T = X − (X − T0) exp(−s)
its integrand is smooth between the transformation temperatures, and does not blow up at X.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray
from scipy.optimize import brentq

from solver.actuation.wire import MELTING_C, HeatedWire, Surroundings, WireState
from solver.errors import SceneError

Values = NDArray[np.float64]
Places = NDArray[np.intp]

GAUSS_POINTS = 3
PANEL = 0.1
"""Longest panel of the quadrature, in units of s."""

_FEWEST_PANELS = 12
"""Between two transformation temperatures, where the integrand bends most."""

_NEAR_ENOUGH = math.log(1e9)
"""The wire is taken to stand still this near, in s, to the temperature at which it does."""

_SAMPLES = 200
_NEWTON_STEPS = 30


@dataclass(frozen=True, eq=False)
class Course:
    """What a wire went through; arrays (n,), energies in J per metre since the beginning."""

    time_s: Values
    temperature_C: Values  # noqa: N815
    fraction: Values
    joule_J_m: Values  # noqa: N815
    loss_J_m: Values  # noqa: N815

    @property
    def last(self) -> WireState:
        """State at the end."""
        return WireState(float(self.temperature_C[-1]), float(self.fraction[-1]))


@dataclass(frozen=True)
class Heating:
    """A wire from one state on, at one current, which may be 0: docs/theory.md, eq. (23).

    Attributes
    ----------
    wire : HeatedWire
    surroundings : Surroundings
    start : WireState
    current_A : float
    panel : float
        Longest panel of the quadrature.

    Raises
    ------
    SceneError
        When the current is not finite.
    """

    wire: HeatedWire
    surroundings: Surroundings
    start: WireState
    current_A: float  # noqa: N815
    panel: float = PANEL

    def __post_init__(self) -> None:
        if not math.isfinite(self.current_A):
            raise SceneError(f"current_A = {self.current_A:g}: must be finite")

    def net_W_m(self, temperature_C: Values) -> Values:  # noqa: N802, N803
        """q: what a metre of wire gains, at temperatures on its way."""
        return self._joule_W_m(temperature_C) - self._loss_W_m(temperature_C)

    @property
    def _kinks_C(self) -> tuple[float, ...]:  # noqa: N802
        return self.wire.transformation.kinks_C(self.start.fraction)

    def _fraction(self, there: Values) -> tuple[Values, Values]:
        start = self.start
        return self.wire.transformation.along(start.fraction, start.temperature_C, there)

    def _joule_W_m(self, there: Values) -> Values:  # noqa: N802
        return self.current_A**2 * self.wire.resistance_ohm_m(self._fraction(there)[0])

    def _loss_W_m(self, there: Values) -> Values:  # noqa: N802
        ambient = self.surroundings.ambient_C
        return self.surroundings.loss_W_mK(self.wire) * (there - ambient)

    def _capacity_J_mK(self, there: Values) -> Values:  # noqa: N802
        slope = self._fraction(there)[1]
        own = self.wire.heat_capacity_J_kgK + self.wire.latent_heat_J_kg * slope
        return self.wire.mass_kg_m * own

    @cached_property
    def final_C(self) -> float | None:  # noqa: N802
        """Temperature at which the wire stands still; None when it would melt before."""
        start_C = self.start.temperature_C  # noqa: N806
        begin = float(self.net_W_m(np.array([start_C]))[0])
        if begin == 0:
            return start_C
        limit = MELTING_C if begin > 0 else self.surroundings.ambient_C
        marks = [t for t in self._kinks_C if _between(start_C, t, limit)]
        edges = sorted([start_C, *marks, limit], reverse=begin < 0)
        places = np.concatenate([np.linspace(a, b, _SAMPLES) for a, b in itertools.pairwise(edges)])
        turned = np.flatnonzero(self.net_W_m(places) * begin <= 0)
        if not turned.size:
            return None
        first = int(turned[0])
        return float(
            brentq(
                lambda t: float(self.net_W_m(np.array([t]))[0]),
                places[first - 1],
                places[first],
                xtol=1e-13 * max(1.0, abs(start_C)),
            )
        )

    @cached_property
    def _target(self) -> float:
        """X: a zero of q, or a place beyond the melting point that stands for one."""
        if self.final_C is None:
            return 2 * MELTING_C - self.start.temperature_C
        return self.final_C

    def _temperature(self, s: Values) -> Values:
        return self._target - (self._target - self.start.temperature_C) * np.exp(-s)

    @cached_property
    def _edges(self) -> Values:
        """Panels of s, with an edge wherever the law of the wire changes."""
        start_C, target = self.start.temperature_C, self._target  # noqa: N806
        if target == start_C:
            return np.zeros(1)
        end = _NEAR_ENOUGH if self.final_C is not None else math.log(2.0)
        marks = sorted(
            math.log((target - start_C) / (target - t))
            for t in set(self._kinks_C)
            if _between(start_C, t, target)
        )
        places = [0.0, *(mark for mark in marks if mark < end), end]
        counts = [
            max(math.ceil((b - a) / self.panel), math.ceil(_FEWEST_PANELS * PANEL / self.panel))
            for a, b in itertools.pairwise(places)
        ]
        pieces = [
            np.linspace(a, b, count, endpoint=False)
            for a, b, count in zip(places, places[1:], counts, strict=False)
        ]
        return np.append(np.concatenate(pieces), end)

    def _rates(self, s: Values) -> Values:
        """Derivatives (3, ...) of time, Joule heat and loss by s."""
        there = self._temperature(s)
        flat = there.ravel()
        time = self._capacity_J_mK(flat) * (self._target - flat) / self.net_W_m(flat)
        rates = np.stack([time, time * self._joule_W_m(flat), time * self._loss_W_m(flat)])
        return rates.reshape(3, *s.shape)

    def _gained(self, begin: Values, end: Values) -> Values:
        """Time, Joule heat and loss (3, n) from one s to another, on one panel each."""
        nodes, weights = leggauss(GAUSS_POINTS)
        middle, half = (begin + end) / 2, (end - begin) / 2
        values = self._rates(middle[:, None] + half[:, None] * nodes)
        return (values * weights).sum(axis=-1) * half

    @cached_property
    def _at_edges(self) -> Values:
        edges = self._edges
        gains = self._gained(edges[:-1], edges[1:])
        return np.concatenate([np.zeros((3, 1)), np.cumsum(gains, axis=1)], axis=1)

    def at(self, time_s: Values) -> Course:
        """Give the wire's state at times, none of them negative.

        Raises
        ------
        SceneError
            When the wire melts before the last.
        """
        times = np.asarray(time_s, dtype=float)
        edges, known = self._edges, self._at_edges
        if self.final_C is None and times.max(initial=0.0) > known[0, -1]:
            raise SceneError(
                f"current_A = {self.current_A:g}: the wire would melt, at {MELTING_C:g} C, after "
                f"{known[0, -1]:.3g} s; use a lower current or a shorter time"
            )
        k = np.clip(np.searchsorted(known[0], times, side="right") - 1, 0, max(len(edges) - 2, 0))
        moving = times < known[0, -1]
        s = np.where(moving, edges[k], edges[-1])
        gained = known[:, k]
        still = np.where(moving, 0.0, times - known[0, -1])
        if moving.any():
            s[moving] = self._solved(k[moving], times[moving])
            gained[:, moving] += self._gained(edges[k[moving]], s[moving])
        gained[:, ~moving] = known[:, [-1]]
        there = self._temperature(s)
        fraction = self._fraction(there)[0]
        joule = gained[1] + still * self._joule_W_m(there)
        loss = gained[2] + still * self._loss_W_m(there)
        return Course(times, there, fraction, joule, loss)

    def _solved(self, k: Places, times: Values) -> Values:
        """Find s at times that lie in panels k; Newton's steps, kept inside the panel."""
        low, high = self._edges[k], self._edges[k + 1]
        begin, end = self._at_edges[0][k], self._at_edges[0][k + 1]
        s = low + (high - low) * (times - begin) / (end - begin)
        for _ in range(_NEWTON_STEPS):
            short = times - begin - self._gained(low, s)[0]
            step = short / self._rates(s)[0]
            s = np.clip(s + step, low, high)
            if np.abs(step).max() < 1e-13 * max(1.0, float(high.max())):
                break
        return s


def _between(one: float, middle: float, other: float) -> bool:
    return min(one, other) < middle < max(one, other)
