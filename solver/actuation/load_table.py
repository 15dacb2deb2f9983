"""Heights of the cell under any load at any fraction of austenite, from a few solves."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline, PchipInterpolator
from scipy.optimize import brentq

from solver.actuation.cell_path import CellResponse, HeatedCell
from solver.actuation.lifting import PRESSED_TO, pressed
from solver.errors import NotConvergedError
from solver.scene import LoopScene

Values = NDArray[np.float64]

TABLE_FRACTIONS = 6
"""Fractions of austenite at which the forces are solved."""

_FEWEST_SHARES = 7
"""Heights of `PRESSED_TO` that must have been solved; slack fabric has no single answer at some."""

_FINE_SHARES = 541


@dataclass(frozen=True, eq=False)
class LoadTable:
    """Forces of the cell at a few fractions of austenite and heights; all else is interpolated.

    Attributes
    ----------
    response : CellResponse
        The free cell, of height H.
    fractions : array (k,)
        Rising, without those at which the cell is flat by itself.
    shares : array (m,)
        Heights in units of H, falling from 1.
    forces : array (k, m)
        In units of E_f t R H³: near the fraction where the cell turns flat the force falls with
        the cube of H.
    """

    response: CellResponse
    fractions: Values
    shares: Values
    forces: Values

    @cached_property
    def _between_fractions(self) -> PchipInterpolator:
        return PchipInterpolator(self.fractions, self.forces, axis=0)

    @cached_property
    def _fine(self) -> Values:
        return np.linspace(1.0, float(self.shares[-1]), _FINE_SHARES)

    def curve(self, fraction: float) -> tuple[Values, Values]:
        """Heights and forces (n,) of one fraction, from free to well past the largest force."""
        free = float(self.response.height(np.array([fraction]))[0])
        if free == 0:
            return np.zeros(_FINE_SHARES), np.zeros(_FINE_SHARES)
        own = self._between_fractions(fraction) * free**3
        force = np.maximum(CubicSpline(self.shares[::-1], own[::-1])(self._fine), 0.0)
        force[0] = 0.0
        return free * self._fine, force

    def largest_load(self, fraction: float) -> float:
        """F_max: the load on a cell that flattens it."""
        return float(self.curve(fraction)[1].max())

    def height(self, fraction: float, load: float) -> float:
        """Height at which the cell stands under a load; 0 if it is flattened."""
        heights, forces = self.curve(fraction)
        if load <= 0:
            return float(heights[0])
        carrying = np.flatnonzero(forces >= load)
        if not carrying.size:
            return 0.0
        k = int(carrying[0])
        share = (load - forces[k - 1]) / (forces[k] - forces[k - 1])
        return float(heights[k - 1] + share * (heights[k] - heights[k - 1]))

    def snaps_at(self, begin: float, end: float, load: float) -> float | None:
        """Fraction at which a cell that carries a load no longer does; None if it always can.

        Parameters
        ----------
        begin, end : float
            Fractions between which the wire changes, in this order.
        """
        places = np.linspace(begin, end, 201)
        margin = np.array([self.largest_load(float(place)) for place in places]) - load
        if load <= 0 or margin.min() >= 0:
            return None
        k = int(np.flatnonzero(margin < 0)[0])
        if k == 0:
            return begin
        return float(brentq(lambda f: self.largest_load(f) - load, places[k - 1], places[k]))


def load_table(
    cell: HeatedCell, response: CellResponse, *, count: int = TABLE_FRACTIONS
) -> LoadTable:
    """Solve the cell pressed to several heights, at several fractions of austenite.

    Raises
    ------
    NotConvergedError
        When there is no shape to rely on.
    """
    rows: list[tuple[float, Values, Values]] = []
    for fraction in _fractions(cell, response, count):
        height = float(response.height(np.array([fraction]))[0])
        if height > 0:
            shares, forces = _forces(cell.scene(fraction), height)
            rows.append((fraction, shares, forces / height**3))
    if not rows:
        flat = np.zeros((2, len(PRESSED_TO)))
        return LoadTable(response, np.array([0.0, 1.0]), np.array(PRESSED_TO), flat)
    deepest = max(float(shares[-1]) for _, shares, _ in rows)
    common = np.array([share for share in PRESSED_TO if share >= deepest])
    forces = [CubicSpline(shares[::-1], own[::-1])(common) for _, shares, own in rows]
    return LoadTable(response, np.array([row[0] for row in rows]), common, np.array(forces))


def _fractions(cell: HeatedCell, response: CellResponse, count: int) -> list[float]:
    """Even fractions where the cell rises, up to near where it is flat."""
    turning = cell.flat_from
    if turning is None:
        return [float(one) for one in np.linspace(0.0, 1.0, count)]
    if response.heights[0] == 0:
        return [float(one) for one in np.linspace(1.0, turning, count, endpoint=False)[::-1]]
    return [float(one) for one in np.linspace(0.0, turning, count, endpoint=False)]


def _forces(scene: LoopScene, free_height: float) -> tuple[Values, Values]:
    """Shares of the free height, and forces there; a share without a solution is left out."""
    shares, forces, start, fault = [1.0], [0.0], None, ""
    for share in PRESSED_TO[1:]:
        try:
            start = pressed(scene, share * free_height, start)
        except NotConvergedError as error:
            fault = str(error)
            continue
        shares.append(share)
        forces.append(start.force)
    if len(shares) < _FEWEST_SHARES:
        raise NotConvergedError(f"pressed to {PRESSED_TO[-1]:g} of its height: {fault}")
    return np.array(shares), np.array(forces)


def height_history(table: LoadTable, fractions: Values, load: float) -> tuple[Values, int | None]:
    """Heights (n,) along a history of fractions (n,); a cell that was flattened stays flat.

    Returns
    -------
    heights : array (n,)
    snap : int or None
        Place in the history at which the load flattens the cell.
    """
    levels, place = np.unique(np.round(fractions, 9), return_inverse=True)
    heights = np.array([table.height(float(one), load) for one in levels])[place]
    if load <= 0:
        return heights, None
    fallen = np.flatnonzero(heights == 0)
    if not fallen.size:
        return heights, None
    first = int(fallen[0])
    heights[first:] = 0.0
    return heights, first
