"""The shapes of one free cell from cold wire to hot and back, each from the one before."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from solver.circle import stays_flat
from solver.compact import solve_loop
from solver.equilibrium import Equilibrium
from solver.errors import SceneError
from solver.scene import LoopScene

Values = NDArray[np.float64]

PATH_STATES = 25
"""States from cold to hot; as many back."""

ONE_BRANCH = 1e-3
"""Relative change of the height by which two states of one fraction differ after a snap."""


@dataclass(frozen=True)
class HeatedCell:
    """A loop whose wire's modulus changes with its fraction of austenite.

    Attributes
    ----------
    cold : LoopScene
        With martensite: a circle on isotropic fabric.
    modulus_ratio : float
        r of hot modulus to cold, greater than 0; β and the axial stiffness are in proportion to
        1 + ξ (r − 1).

    Raises
    ------
    SceneError
        When the ratio is not positive, or the loop is no circle on isotropic fabric.
    """

    cold: LoopScene
    modulus_ratio: float

    def __post_init__(self) -> None:
        if not (self.modulus_ratio > 0 and math.isfinite(self.modulus_ratio)):
            raise SceneError(f"modulus_ratio = {self.modulus_ratio:g}: must be greater than 0")
        if not self.cold.isotropic_circle:
            raise SceneError("a heated cell is modelled as a circle on isotropic fabric")

    def scene(self, fraction: float) -> LoopScene:
        """Give the loop at a fraction of austenite."""
        stiffer = 1 + fraction * (self.modulus_ratio - 1)
        return replace(
            self.cold,
            beta=self.cold.beta * stiffer,
            axial_stiffness=self.cold.axial_stiffness * stiffer,
        )

    @cached_property
    def flat_from(self) -> float | None:
        """Fraction at which the free loop turns flat, or stops being flat; None if there is none.

        The branch of saddles ends there with height 0, so that no snap and no hysteresis comes of
        it: the loop rises from flat by the same way.
        """
        if stays_flat(self.cold) == stays_flat(self.scene(1.0)):
            return None
        low, high = 0.0, 1.0
        cold_is_flat = stays_flat(self.cold)
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            if stays_flat(self.scene(middle)) == cold_is_flat:
                low = middle
            else:
                high = middle
        return (low + high) / 2


_HALVINGS = 50


@dataclass(frozen=True, slots=True)
class PathEvent:
    """What happens to the free cell at a fraction of austenite on the way.

    Attributes
    ----------
    kind : str
        ``"turns flat"``, ``"rises"`` or ``"snaps"``.
    fraction : float
        Of austenite.
    way : str
        ``"heating"`` or ``"cooling"``.
    """

    kind: str
    fraction: float
    way: str


def follow_cell(
    cell: HeatedCell, fractions: Iterable[float], *, tolerance: float = 1e-4
) -> tuple[Equilibrium, ...]:
    """Solve the free cell at one fraction of austenite after the other, each from the last.

    Raises
    ------
    NotConvergedError
        When there is no shape to rely on.
    """
    states: list[Equilibrium] = []
    for fraction in fractions:
        start = next((one for one in reversed(states) if one.buckled), None)
        states.append(solve_loop(cell.scene(fraction), tolerance=tolerance, start=start))
    return tuple(states)


@dataclass(frozen=True)
class CellPath:
    """The free cell from cold to hot and back.

    Attributes
    ----------
    cell : HeatedCell
    fractions : array (n,)
        Of austenite, rising from 0 to 1.
    heating : tuple of Equilibrium
        At these.
    cooling : tuple of Equilibrium
        At the same fractions, reached from above; in the order of the fractions.
    """

    cell: HeatedCell
    fractions: Values
    heating: tuple[Equilibrium, ...]
    cooling: tuple[Equilibrium, ...]

    @cached_property
    def events(self) -> tuple[PathEvent, ...]:
        """Where the cell turns flat, rises from flat or snaps."""
        found: list[PathEvent] = []
        turning = self.cell.flat_from
        if turning is not None:
            kinds = ("rises", "turns flat")
            kinds = kinds if stays_flat(self.cell.cold) else kinds[::-1]
            found += [
                PathEvent(kind, turning, way)
                for kind, way in zip(kinds, ("heating", "cooling"), strict=True)
            ]
        found += [
            PathEvent("snaps", float(fraction), "cooling")
            for fraction, up, down in zip(self.fractions, self.heating, self.cooling, strict=True)
            if abs(down.shape.height - up.shape.height) > ONE_BRANCH * max(up.shape.height, 0.1)
        ]
        return tuple(found)

    @cached_property
    def response(self) -> CellResponse:
        """Height, width and energy at any fraction of austenite."""
        return CellResponse(
            self.cell.flat_from,
            self.fractions,
            np.array([one.shape.height for one in self.heating]),
            np.array([one.shape.width for one in self.heating]),
            np.array([one.energy for one in self.heating]),
        )


def cell_path(cell: HeatedCell, *, states: int = PATH_STATES, tolerance: float = 1e-4) -> CellPath:
    """Follow the free cell from cold to hot and back.

    Parameters
    ----------
    states : int
        From cold to hot, at even fractions with both ends; as many back.

    Raises
    ------
    NotConvergedError
        When there is no shape to rely on.
    """
    fractions = np.linspace(0.0, 1.0, states)
    there = [float(one) for one in fractions]
    found = follow_cell(cell, [*there, *reversed(there)], tolerance=tolerance)
    return CellPath(cell, fractions, found[:states], found[: states - 1 : -1])


@dataclass(frozen=True, eq=False)
class CellResponse:
    """Height, width and energy of the free cell against its wire's fraction of austenite.

    Squares of heights are interpolated, not heights: they are nearly straight also where the loop
    turns flat, and there the height itself is a square root.

    Attributes
    ----------
    flat_from : float or None
        Fraction where the loop turns flat or rises.
    fractions, heights, widths, energies : array (n,)
        At the states that were solved; lengths in units of R, energies in units of E_f t R².
    """

    flat_from: float | None
    fractions: Values
    heights: Values
    widths: Values
    energies: Values

    def height(self, fraction: Values) -> Values:
        """Rise from valley to crest, array like the fractions (n,)."""
        squares = self._through(self.heights**2, fraction, level=0.0)
        return np.sqrt(np.maximum(squares, 0.0))

    def width(self, fraction: Values) -> Values:
        """Distance of the crests: the pitch of an array."""
        return self._through(self.widths, fraction)

    def energy(self, fraction: Values) -> Values:
        """Energy of a loop."""
        return self._through(self.energies, fraction)

    def _through(self, values: Values, fraction: Values, level: float | None = None) -> Values:
        """Interpolate monotonely, on each side of the turning point by itself."""
        asked = np.asarray(fraction, dtype=float)
        if self.flat_from is None:
            return np.asarray(PchipInterpolator(self.fractions, values)(asked))
        known, own = self._with_turning(values, level)
        left, right = known <= self.flat_from, known >= self.flat_from
        found = np.empty_like(asked)
        for side, here in ((left, asked <= self.flat_from), (right, asked > self.flat_from)):
            found[here] = PchipInterpolator(known[side], own[side])(asked[here])
        return found

    def _with_turning(self, values: Values, level: float | None) -> tuple[Values, Values]:
        """Add the turning point, at a level that is known or that its flat side leads to."""
        turning = float(self.flat_from or 0.0)
        k = int(np.searchsorted(self.fractions, turning))
        if level is None:
            flat_left = self.heights[0] == 0
            side = slice(0, k) if flat_left else slice(k, None)
            known, own = self.fractions[side], values[side]
            rank = min(2, len(known) - 1)
            near = slice(-3, None) if flat_left else slice(0, 3)
            level = float(np.polyval(np.polyfit(known[near], own[near], rank), turning))
        return np.insert(self.fractions, k, turning), np.insert(values, k, level)
