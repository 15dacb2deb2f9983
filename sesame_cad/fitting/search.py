"""Choices of loop, wire and prestrain that come as near as they can to what is wanted."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from sesame_cad.fitting.actuator import Action, Parts, action
from solver.errors import NotConvergedError, SceneError
from solver.many import solve_many
from solver.reading import Reading

Vectors = NDArray[np.float64]

_STARTS_BY_CHOICE = (12, 5, 5)
_MOST_STARTS = 5
_SAME = 0.02
_FAR = 1e3
"""Residual of a choice whose shape cannot be solved: farther than any that can."""


@dataclass(frozen=True, slots=True)
class Bounds:
    """What may be chosen from.

    Attributes
    ----------
    loop_diameter_mm, prestrain : (float, float)
        Least and greatest; the same twice where it is given.
    wires_mm : tuple of float
        Wires in stock; or least and greatest diameter, where any can be had.
    any_wire : bool
        Whether any between them can be had.
    """

    loop_diameter_mm: tuple[float, float]
    prestrain: tuple[float, float]
    wires_mm: tuple[float, ...]
    any_wire: bool = False

    @property
    def boxes(self) -> tuple[tuple[tuple[float, float], ...], ...]:
        """Each wire's box of choices, in the order of `CHOICES`."""
        wires = (
            [(min(self.wires_mm), max(self.wires_mm))]
            if self.any_wire
            else [(wire, wire) for wire in self.wires_mm]
        )
        return tuple((self.loop_diameter_mm, wire, self.prestrain) for wire in wires)


@dataclass(frozen=True)
class Answer:
    """One choice.

    Attributes
    ----------
    choice : array (3,)
        In the order of `CHOICES`.
    action : Action
    errors : dict
        Of each wanted quantity, relative to it.
    within : float
        The largest error that is allowed.
    """

    choice: Vectors
    action: Action
    errors: Mapping[str, float]
    within: float

    @property
    def error(self) -> float:
        """The largest of the errors."""
        return max(abs(error) for error in self.errors.values())

    @property
    def reached(self) -> bool:
        """Whether all that is wanted is reached."""
        return self.error <= self.within

    @property
    def rank(self) -> tuple[float, ...]:
        """Reached first; then taut fabric; then what tolerances spoil least, or what is nearest."""
        if self.reached:
            return (0, float(self.action.slack), self.action.height_spread)
        return (1, self.error)


def fit(parts: Parts, wanted: Mapping[str, float], bounds: Bounds, within: float) -> list[Answer]:
    """Find choices, the best first; those that do not reach what is wanted come last.

    Parameters
    ----------
    wanted : mapping of str to float
        Values, greater than 0, of some of `QUANTITIES`.
    within : float
        Relative error that is allowed.
    """
    found = [
        answer
        for box in bounds.boxes
        for start in _starts(parts, wanted, box)
        if (answer := _improved(parts, wanted, box, start, within)) is not None
    ]
    return _distinct(sorted(found, key=lambda answer: answer.rank))


def _distinct(answers: Iterable[Answer]) -> list[Answer]:
    kept: list[Answer] = []
    for answer in answers:
        if all(np.abs(answer.choice / other.choice - 1).max() > _SAME for other in kept):
            kept.append(answer)
    return kept


def _starts(
    parts: Parts, wanted: Mapping[str, float], box: Sequence[tuple[float, float]]
) -> list[Vectors]:
    """The best of a coarse grid: heights and pitches of all its loops are solved at once."""
    sides = [
        np.geomspace(low, high, count) if high > low else np.array([low])
        for (low, high), count in zip(box, _STARTS_BY_CHOICE, strict=True)
    ]
    grid = [np.array(choice) for choice in itertools.product(*sides)]
    cold = [parts.loop(choice) for choice in grid]
    cold_height, cold_pitch, good = _sizes([loop.scene for loop in cold], parts)
    radius_mm = np.array([loop.loop_diameter_mm / 2 for loop in cold])
    values = {"height_mm": cold_height * radius_mm, "pitch_mm": cold_pitch * radius_mm}
    if "stroke_mm" in wanted:
        hot_height, _, _ = _sizes([parts.hot(loop).scene for loop in cold], parts)
        values["stroke_mm"] = values["height_mm"] - hot_height * radius_mm
    known = [key for key in wanted if key in values]
    cost = np.zeros(len(grid))
    for key in known:
        cost += np.log(np.maximum(values[key], 1e-3 * wanted[key]) / wanted[key]) ** 2
    if "force_N" in wanted:
        # a hot loop presses with a tenth or two of the unit of force
        units = np.array([loop.materials.force_unit_N for loop in cold])
        cost += np.log(0.15 * units / wanted["force_N"]) ** 2
    # a flat loop has no slope to go by
    cost[~good | (cold_height <= 0)] = np.inf
    order = [i for i in np.argsort(cost, kind="stable").tolist() if np.isfinite(cost[i])]
    return [grid[i] for i in _spread_out(order, grid)]


def _spread_out(order: Sequence[int], grid: Sequence[Vectors]) -> list[int]:
    """The first few that differ in prestrain or wire; beside each other they lead to the same."""
    kept: list[int] = []
    for i in order:
        if all(not np.array_equal(grid[i][1:], grid[j][1:]) for j in kept):
            kept.append(i)
        if len(kept) == _MOST_STARTS:
            break
    return kept


def _sizes(scenes: Sequence[object], parts: Parts) -> tuple[Vectors, Vectors, NDArray[np.bool_]]:
    """Heights and pitches in units of R, and which of them can be relied on."""
    given = [
        np.array([getattr(scene, key) for scene in scenes], dtype=float)
        for key in ("strain", "beta", "poisson", "axial_stiffness")
    ]
    strain, beta, poisson, axial_stiffness = given
    reading = Reading(parts.reading)
    found = solve_many(strain, beta, poisson, reading, axial_stiffness, highest_degree=9)
    good = (found.status == "converged") & ~found.meets
    return 2 * np.pi * found.height_over_perimeter, found.width, good


def _improved(
    parts: Parts,
    wanted: Mapping[str, float],
    box: Sequence[tuple[float, float]],
    start: Vectors,
    within: float,
) -> Answer | None:
    """Go from a start to the nearest choice, by least squares of the relative errors."""
    keys = tuple(wanted)
    free = [k for k, (low, high) in enumerate(box) if high > low]
    solve = _remembering(lambda choice: _tried(parts, choice, keys))

    def choice_at(x: Vectors) -> Vectors:
        choice = start.copy()
        choice[free] = np.exp(x)
        return choice

    def residual(x: Vectors) -> Vectors:
        found = solve(choice_at(x))
        if found is None:
            return np.full(len(keys), _FAR)
        return np.array([found.values[key] / wanted[key] - 1 for key in keys])

    def slope(x: Vectors) -> Vectors:
        choice = choice_at(x)
        found = solve(choice)
        if found is None:
            return np.zeros((len(keys), len(free)))
        return np.array([found.slopes[key][free] * choice[free] / wanted[key] for key in keys])

    x = np.log(start[free])
    if free:
        low, high = np.log([box[k] for k in free]).T
        inside = np.clip(x, low + 1e-9 * (high - low), high - 1e-9 * (high - low))
        x = least_squares(
            residual,
            inside,
            slope,
            bounds=(low, high),
            xtol=1e-12,
            ftol=1e-12,
            gtol=1e-12,
            max_nfev=40,
        ).x
    found = solve(choice_at(x))
    if found is None:
        return None
    errors = {key: found.values[key] / wanted[key] - 1 for key in keys}
    return Answer(choice_at(x), found, errors, within)


def _tried(parts: Parts, choice: Vectors, keys: tuple[str, ...]) -> Action | None:
    try:
        return action(parts, choice, keys)
    except (SceneError, NotConvergedError):
        return None


def _remembering(
    solve: Callable[[Vectors], Action | None],
) -> Callable[[Vectors], Action | None]:
    """Solve a choice once, for its residual and its slope."""
    known: dict[bytes, Action | None] = {}

    def remembered(choice: Vectors) -> Action | None:
        key = choice.tobytes()
        if key not in known:
            known[key] = solve(choice)
        return known[key]

    return remembered
