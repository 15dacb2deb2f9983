"""Plane curves along which wires lie flat, each a function of a parameter from 0 to 1."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize_scalar

from solver.errors import SceneError

Vectors = NDArray[np.float64]
Point = tuple[float, float]

_SAMPLES = 400
_STEP = 1e-6


class PlaneCurve(Protocol):
    """A smooth curve; a closed one ends where it begins, in the same direction."""

    @property
    def closed(self) -> bool:
        """Whether the parameters 0 and 1 are the same point."""
        ...

    def at(self, parameters: Vectors) -> Vectors:
        """Points (n, 2) at parameters (n,)."""
        ...

    def scaled(self, factor: float) -> PlaneCurve:
        """Give the curve with all coordinates multiplied."""
        ...


def _finite(*values: float) -> bool:
    return all(math.isfinite(value) for value in values)


@dataclass(frozen=True, slots=True)
class Ellipse:
    """An ellipse, run counterclockwise from the end of its first semi-axis.

    Attributes
    ----------
    centre : tuple of float
    semi_axes : tuple of float
        Greater than 0; a circle when they are equal.
    angle : float
        By which the first semi-axis is turned from x, in radians.

    Raises
    ------
    SceneError
        When a semi-axis is not greater than 0, or a number is not finite.
    """

    centre: Point
    semi_axes: Point
    angle: float = 0.0
    closed = True

    def __post_init__(self) -> None:
        if not (min(self.semi_axes) > 0 and _finite(*self.centre, *self.semi_axes, self.angle)):
            raise SceneError(
                f"semi_axes = {self.semi_axes}: an ellipse needs two that are greater than 0, "
                "and finite numbers"
            )

    def at(self, parameters: Vectors) -> Vectors:
        """Points (n, 2) at parameters (n,): the eccentric angle over 2π."""
        turns = 2 * np.pi * parameters
        along, across = self.semi_axes[0] * np.cos(turns), self.semi_axes[1] * np.sin(turns)
        return np.array(self.centre) + np.stack([along, across], axis=1) @ rotation(self.angle)

    def scaled(self, factor: float) -> Ellipse:
        """Give the ellipse with all lengths multiplied."""
        (x, y), (a, b) = self.centre, self.semi_axes
        return Ellipse((factor * x, factor * y), (factor * a, factor * b), self.angle)


def rotation(angle: float) -> Vectors:
    """Matrix (2, 2) that turns rows of points by an angle, counterclockwise."""
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.array([[cosine, sine], [-sine, cosine]])


def circle(centre: Point, radius: float) -> Ellipse:
    """Give a circle."""
    return Ellipse(centre, (radius, radius))


@dataclass(frozen=True, slots=True)
class Arc:
    """An open arc of a circle, from one angle (radians) to another.

    Raises
    ------
    SceneError
        When it is longer than the circle, has no length, or a number is not finite.
    """

    centre: Point
    radius: float
    first: float
    last: float
    closed = False

    def __post_init__(self) -> None:
        numbers = _finite(*self.centre, self.radius, self.first, self.last)
        if not (numbers and self.radius > 0 and 0 < abs(self.last - self.first) < 2 * np.pi):
            raise SceneError(
                f"an arc of radius {self.radius:g} from {self.first:g} to {self.last:g} rad: the "
                "radius must be greater than 0, and the arc shorter than the circle"
            )

    def at(self, parameters: Vectors) -> Vectors:
        """Points (n, 2) at parameters (n,)."""
        angle = self.first + parameters * (self.last - self.first)
        unit = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        return np.array(self.centre) + self.radius * unit

    def scaled(self, factor: float) -> Arc:
        """Give the arc with all lengths multiplied."""
        x, y = self.centre
        return Arc((factor * x, factor * y), factor * self.radius, self.first, self.last)


@dataclass(frozen=True)
class Through:
    """The cubic spline through points; two make a straight line.

    It is smooth everywhere, also where a closed one ends: corners come out rounded. A closed one
    runs counterclockwise, however its points are given.

    Attributes
    ----------
    points : tuple of tuple
        At least 2, of a closed curve at least 4, of which none follows itself; the first is not
        repeated.
    closed : bool

    Raises
    ------
    SceneError
        When there are too few, two in a row are the same, or a number is not finite.
    """

    points: tuple[Point, ...]
    closed: bool

    def __post_init__(self) -> None:
        least = 4 if self.closed else 2
        if len(self.points) < least:
            raise SceneError(f"{len(self.points)} points: a curve like this needs {least}")
        if not all(_finite(*point) for point in self.points):
            raise SceneError("points of a curve must be finite numbers")
        if not np.linalg.norm(np.diff(self._knots, axis=0), axis=1).all():
            raise SceneError("two points of a curve that follow each other are the same")

    @property
    def _knots(self) -> Vectors:
        knots = np.array(self.points, dtype=np.float64)
        if not self.closed:
            return knots
        (x, y), (u, v) = knots.T, np.roll(knots, -1, axis=0).T
        clockwise = np.sum(x * v - u * y) < 0
        return np.concatenate([knots, knots[:1]])[:: -1 if clockwise else 1]

    @cached_property
    def _spline(self) -> CubicSpline:
        knots = self._knots
        chords = np.linalg.norm(np.diff(knots, axis=0), axis=1)
        along = np.concatenate([[0.0], np.cumsum(chords)]) / chords.sum()
        return CubicSpline(along, knots, bc_type="periodic" if self.closed else "not-a-knot")

    def at(self, parameters: Vectors) -> Vectors:
        """Points (n, 2) at parameters (n,): about the share of the length."""
        return np.asarray(self._spline(parameters), dtype=np.float64)

    def scaled(self, factor: float) -> Through:
        """Give the curve with all coordinates multiplied."""
        return Through(tuple((factor * x, factor * y) for x, y in self.points), self.closed)


def line(start: Point, end: Point) -> Through:
    """Give a straight line."""
    return Through((start, end), closed=False)


def nearest(curve: PlaneCurve, point: Point) -> tuple[float, float]:
    """Parameter at which a curve comes nearest to a point, and how near it comes."""
    if isinstance(curve, Ellipse):
        inside = (np.array(point) - curve.centre) @ rotation(-curve.angle) / curve.semi_axes
        best = math.atan2(inside[1], inside[0]) / (2 * np.pi) % 1
        return best, _distance(curve, best, point)
    grid = np.linspace(0, 1, _SAMPLES + 1)
    start = grid[np.argmin(np.linalg.norm(curve.at(grid) - point, axis=1))]
    low, high = start - 1 / _SAMPLES, start + 1 / _SAMPLES
    if not curve.closed:
        low, high = max(0.0, low), min(1.0, high)
    found = minimize_scalar(
        lambda t: _distance(curve, t, point),
        bounds=(low, high),
        method="bounded",
        options={"xatol": 1e-12},
    )
    candidates = [float(found.x), *([] if curve.closed else [0.0, 1.0])]
    best = min(candidates, key=lambda t: _distance(curve, t, point) + (0 < t < 1) * 1e-9)
    return (best % 1 if curve.closed else best), _distance(curve, best, point)


def _distance(curve: PlaneCurve, parameter: float, point: Point) -> float:
    wrapped = parameter % 1 if curve.closed else parameter
    return math.dist(curve.at(np.array([wrapped]))[0], point)


def direction(curve: PlaneCurve, parameter: float) -> Vectors:
    """Unit tangent (2,) at a parameter."""
    around = np.array([parameter - _STEP, parameter + _STEP])
    around = around % 1 if curve.closed else np.clip(around, 0, 1)
    before, after = curve.at(around)
    return (after - before) / np.linalg.norm(after - before)


def length(curve: PlaneCurve, first: float = 0.0, last: float = 1.0) -> float:
    """Length between two parameters; of a closed curve the last may be beyond 1.

    That of chords so short that what is lacking is less than a ten thousandth.
    """
    parameters = np.linspace(first, last, _SAMPLES + 1)
    points = curve.at(parameters % 1 if curve.closed else parameters)
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
