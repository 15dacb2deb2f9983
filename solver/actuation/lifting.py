"""A cell under a slab: its height against load and temperature, and the load that flattens it.

The force of a loop pressed between plates grows as they close, up to a largest force F_max, and
falls from there to nothing: the flat loop is an equilibrium without force. Under a dead load W a
loop therefore stands where F = W on the falling side, and no lower; with W > F_max it snaps flat.
Flat it stays as long as the load lies on it, however its stiffness changes: to rise by a small
amplitude costs work in proportion to it, and frees energy in proportion to its square only.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline, PchipInterpolator
from scipy.optimize import brentq

from solver.actuation.cell_path import CellResponse, HeatedCell
from solver.errors import NotConvergedError, SceneError
from solver.held import solve_between_plates
from solver.held_equilibrium import HeldEquilibrium
from solver.plates import PlateAxis, Plates
from solver.scene import LoopScene

Values = NDArray[np.float64]

PRESSED_TO = (1.0, 0.97, 0.93, 0.88, 0.82, 0.76, 0.70, 0.64, 0.58, 0.52, 0.46)
"""Heights, in units of the free one, at which the force is solved; the largest force lies at about
0.6 for all strains and stiffnesses that were tried."""

TABLE_FRACTIONS = 6
"""Fractions of austenite at which it is."""

_FEWEST_SHARES = 7
"""Of these heights that must have been solved; slack fabric has no single answer at some."""

_FINE_SHARES = 541
_PRESS_TOLERANCE = 5e-3


def pressed(
    scene: LoopScene,
    height: float,
    start: HeldEquilibrium | None = None,
    *,
    tolerance: float = _PRESS_TOLERANCE,
) -> HeldEquilibrium:
    """Press a cell to a height, that of the wire's centreline; its ``force`` is that of the slab.

    Raises
    ------
    NotConvergedError
        When there is no shape to rely on.
    """
    plates = Plates(height, PlateAxis.HEIGHT)
    return solve_between_plates(scene, plates, tolerance=tolerance, start=start)


def stands_at(scene: LoopScene, free_height: float, load: float) -> HeldEquilibrium:
    """Find where a cell carries a load, by solving it there.

    Parameters
    ----------
    free_height : float
        Without load.
    load : float
        On this cell, in units of E_f t R, greater than 0.

    Raises
    ------
    SceneError
        When the load is not positive.
    NotConvergedError
        When it flattens the cell.
    """
    if not load > 0:
        raise SceneError(f"load = {load:g}: must be greater than 0")
    known: dict[float, HeldEquilibrium] = {}

    def excess(height: float) -> float:
        nearest = min(known, key=lambda other: abs(other - height), default=None)
        start = None if nearest is None else known[nearest]
        known[height] = pressed(scene, height, start)
        return known[height].force - load

    above = free_height
    for share in PRESSED_TO[1:]:
        height = share * free_height
        if excess(height) > 0:
            found = float(brentq(excess, height, above, xtol=1e-5 * free_height))
            return known[found] if found in known else pressed(scene, found, known[height])
        if known[height].force < known.get(above, known[height]).force:
            break
        above = height
    largest = max(one.force for one in known.values())
    raise NotConvergedError(
        f"load = {load:g}: flattens the cell, which carries no more than about {largest:.3g}; use "
        "a lighter load or more cells"
    )


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
