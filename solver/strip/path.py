"""Following a strip's shape as the couple grows: pseudo-arclength continuation.

Steps are measured along the curve of (shape, couple), both in units of the first shape's size, so
that the curve is followed around folds, where the couple turns back (Keller, 1977).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, minimize_scalar

from solver.errors import NotConvergedError
from solver.strip.balance import Balance, Point, bordered, newton

Vectors = NDArray[np.float64]

_FIRST_STEP = 0.1
_LONGEST_STEP = 0.25
_SHORTEST_STEP = 1e-6
_SHORTEST_BOUND = 1e-3
"""To which longer steps are held where a path bends sharply."""
_FEW_ITERATIONS = 6
_COUPLE_OVER_SHAPE = 3.0
"""Couple that counts for as much as the whole shape; near what snaps a strip."""
_MOST_STEPS = 2000
_LONGEST_WAY = 1.5
"""From a step's start to its end, in lengths of the step; beyond it lies another path."""
_TOP = 1e-5
"""Of the place along a step where the couple is largest; its square is the couple's error."""
_FOUND = 1e-11
"""Of a place along a step."""


@dataclass(frozen=True)
class Step:
    """A step along a path: from a point, ``length`` along ``border``, to another."""

    balance: Balance
    start: Point
    border: Vectors
    metric: Vectors
    length: float
    end: Point

    def at(self, length: float) -> Point:
        """Give the point at another length of the step, from 0 to its own."""
        if length == 0:
            return self.start
        return _corrected(self.balance, self.start, self.border, self.metric, length)

    def cut(self, end: Point) -> Step:
        """Give the step up to one of its points."""
        length = float(self.border @ (end.vector - self.start.vector))
        return replace(self, length=length, end=end)

    def where(self, couple: float) -> Point:
        """Give the point at a couple that the step passes."""
        length = brentq(
            lambda h: self.at(h).couple - couple, 0.0, self.length, xtol=_FOUND * self.length
        )
        return self.at(float(length))

    def top(self, sign: int) -> Point:
        """Give the point at which the couple, in the sense of ``sign``, is largest."""
        found = minimize_scalar(
            lambda h: -sign * self.at(float(h)).couple,
            bounds=(0.0, self.length),
            method="bounded",
            options={"xatol": _TOP * self.length},
        )
        return self.at(float(found.x))

    def turning(self) -> Point:
        """Give the point at which the lowest eigenvalue changes sign."""
        length = brentq(
            lambda h: self.balance.lowest_eigenvalue(self.at(h)),
            0.0,
            self.length,
            xtol=_FOUND * self.length,
        )
        return self.at(float(length))


def _metric(balance: Balance, size: float, forces: int) -> Vectors:
    """Weights of the squares of shape, forces and couple in a step's length."""
    couple = [1 / _COUPLE_OVER_SHAPE**2]
    return np.concatenate([np.ones(balance.basis.size), np.zeros(forces), couple]) / size**2


def _corrected(
    balance: Balance, start: Point, border: Vectors, metric: Vectors, length: float
) -> Point:
    """Bring a step's first guess back to balance, across the step."""
    guess = start.moved(_direction(balance, start, border) * length)
    end = newton(balance, guess, border, float(border @ start.vector) + length)
    away = end.vector - start.vector
    if away @ (metric * away) > (_LONGEST_WAY * length) ** 2:
        raise NotConvergedError(f"the path was lost at a couple of {start.couple:g} EI/L")
    return end


def _direction(balance: Balance, point: Point, border: Vectors) -> Vectors:
    """Direction of the path at a point, of length 1 along ``border``."""
    matrix = bordered(balance, balance.residual(point)[1], border)
    target = np.zeros(len(border))
    target[-1] = 1
    return np.asarray(np.linalg.solve(matrix, target), dtype=np.float64)


def _next_border(balance: Balance, point: Point, border: Vectors, metric: Vectors) -> Vectors:
    """Row along the path at a point, in the sense of the row before."""
    direction = _direction(balance, point, border)
    return metric * direction / np.sqrt(direction @ (metric * direction))


def steps_along(
    balance: Balance, start: Point, sign: int, longest: float = _LONGEST_STEP
) -> Iterator[Step]:
    """Walk along the path from ``start``, the couple at first growing in the sense of ``sign``.

    Raises
    ------
    NotConvergedError
        When even short steps do not lead on.
    """
    size = float(np.linalg.norm(start.x))
    metric = _metric(balance, size, len(start.force))
    border = np.zeros(len(metric))
    border[-1] = sign / size
    point, length = start, min(_FIRST_STEP, longest)
    for _ in range(_MOST_STEPS):
        border = _next_border(balance, point, border, metric)
        step, length = _shortened(balance, point, border, metric, min(length, longest))
        yield step
        point = step.end
    raise NotConvergedError(
        f"the path did not end in {_MOST_STEPS} steps at a couple of {point.couple:g} EI/L"
    )


def _shortened(
    balance: Balance, point: Point, border: Vectors, metric: Vectors, length: float
) -> tuple[Step, float]:
    """Take a step, as short as it must be; give the length of the next one too."""
    while length > _SHORTEST_STEP:
        try:
            end = _corrected(balance, point, border, metric, length)
        except NotConvergedError:
            length /= 2
            continue
        easy = end.iterations - point.iterations <= _FEW_ITERATIONS + 1
        return Step(balance, point, border, metric, length, end), 1.5 * length if easy else length
    raise NotConvergedError(f"the path could not be followed past {point.couple:g} EI/L")


@dataclass(frozen=True)
class Branch:
    """A state from no couple to where it ends, or to the largest couple allowed.

    Attributes
    ----------
    steps : tuple of Step
    end : Point or None
        Where the state is no longer stable; None if that is not reached.
    merges : bool
        Whether it meets another stable state there, which is all that is left beyond.
    """

    steps: tuple[Step, ...]
    end: Point | None
    merges: bool = False

    @property
    def iterations(self) -> int:
        """Newton steps taken on the way."""
        return sum(s.end.iterations - s.start.iterations for s in self.steps)

    def at(self, couple: float) -> Point | None:
        """State at a couple on the way; None where it is no longer, or was not sought."""
        if couple == 0:
            return self.steps[0].start
        for step in self.steps:
            if (step.start.couple - couple) * (step.end.couple - couple) <= 0:
                return step.where(couple)
        return None


def _told_of_turns(
    balance: Balance, start: Point, sign: int, longest: float = _LONGEST_STEP
) -> Iterator[tuple[Step, bool]]:
    """Walk along the path, and say of each step whether the couple has a largest value on it."""
    before = None
    for step in steps_along(balance, start, sign, longest):
        if before:
            yield before, bool(sign * step.border[-1] <= 0)
        before = step


def stable_branch(
    balance: Balance, state: Point, sign: int, limit: float, longest: float = _LONGEST_STEP
) -> Branch:
    """Follow a stable state while the couple grows in the sense of ``sign`` up to ``limit``.

    ``longest`` bounds the length of its steps.
    """
    steps: list[Step] = []
    for step, back in _told_of_turns(balance, state, sign, longest):
        unstable = balance.lowest_eigenvalue(step.end) < 0
        if unstable or back:
            try:
                # a stable path that turns back has gone over into the other state
                end = step.turning() if unstable else step.top(sign)
            except NotConvergedError:
                if longest < _SHORTEST_BOUND:
                    raise
                rest = stable_branch(balance, step.start, sign, limit, longest / 4)
                return replace(rest, steps=(*steps, *rest.steps))
            return Branch((*steps, step.cut(end)), end, merges=not unstable)
        steps.append(step)
        if sign * step.end.couple >= limit:
            break
    return Branch(tuple(steps), None)


def carried(balance: Balance, start: Point, couple: float) -> Point | None:
    """Follow a shape, stable or not, to a couple; None where its path turns back before it."""
    if couple == 0:
        return start
    sign = 1 if couple > 0 else -1
    for step, back in _told_of_turns(balance, start, sign):
        rising = step.cut(step.top(sign)) if back else step
        if sign * rising.end.couple >= sign * couple:
            return rising.where(couple)
        if back:
            return None
    return None
