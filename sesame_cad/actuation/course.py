"""An array that is heated and cooled: its wire's temperature, its shape and what it lifts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from sesame_cad.actuation.body import Body, array_body
from sesame_cad.actuation.subject import (
    check_one_cell,
    cold_materials,
    duty,
    heated_cell,
    heated_wire,
    surroundings,
)
from sesame_cad.errors import InputError
from sesame_cad.omissions import GRAVITY_M_S2
from sesame_cad.specification import Specification
from solver.actuation.cell_path import CellPath, HeatedCell, cell_path
from solver.actuation.duty import Duty, History, follow
from solver.actuation.heating import Heating
from solver.actuation.load_table import LoadTable, height_history, load_table
from solver.actuation.wire import HeatedWire, Surroundings, WireState, at_rest
from solver.errors import SceneError
from solver.materials import LoopMaterials

Values = NDArray[np.float64]

SAMPLES = 101
"""Times in an interval of heating or of cooling."""

_FINE_SAMPLES = 4001
"""Times among which that of 90 % is sought."""


@dataclass(frozen=True)
class Actuation:
    """Everything that follows from a specification's current.

    Attributes
    ----------
    spec : Specification
    body : Body
    materials : LoopMaterials
        With cold wire: what gives the units their size.
    wire : HeatedWire
    around : Surroundings
    duty : Duty
    history : History
        Of the wire, per metre.
    path : CellPath
        The free cell, cold to hot and back.
    table : LoadTable
        The cell under loads.
    """

    spec: Specification
    body: Body
    materials: LoopMaterials
    wire: HeatedWire
    around: Surroundings
    duty: Duty
    history: History
    path: CellPath
    table: LoadTable

    @property
    def radius_mm(self) -> float:
        """The unit of length."""
        return self.materials.loop_radius_m * 1e3

    @property
    def array_force_unit_N(self) -> float:  # noqa: N802 - the unit's own spelling
        """The unit of force of all cells together."""
        return self.materials.force_unit_N * self.body.cells

    @property
    def load_N(self) -> float:  # noqa: N802
        """Weight of the slab."""
        return self.spec.actuation.load_g / 1e3 * GRAVITY_M_S2

    @property
    def load(self) -> float:
        """The same on one cell, in units of E_f t R."""
        return self.load_N / self.array_force_unit_N

    @property
    def start(self) -> WireState:
        """The wire before the current is switched on."""
        return at_rest(self.wire, self.around.ambient_C)

    @cached_property
    def heights_mm(self) -> Values:
        """Heights (n,) of the array without load, along the history."""
        return self.path.response.height(self.history.course.fraction) * self.radius_mm

    @cached_property
    def loaded(self) -> tuple[Values, int | None]:
        """Heights (n,) in mm under the slab, and the place at which it flattens the array."""
        heights, snap = height_history(self.table, self.history.course.fraction, self.load)
        return heights * self.radius_mm, snap

    @property
    def working_mm(self) -> Values:
        """Heights (n,) with the load, if there is one."""
        return self.loaded[0] if self.load > 0 else self.heights_mm

    def height_mm(self, fraction: float) -> float:
        """Height with the load at a fraction of austenite, the array standing; 0 if it cannot."""
        if self.load > 0:
            return self.table.height(fraction, self.load) * self.radius_mm
        return float(self.path.response.height(np.array([fraction]))[0]) * self.radius_mm

    def flattening_load_g(self, fraction: float) -> float:
        """Mass of the slab that flattens the array."""
        largest_N = self.table.largest_load(fraction) * self.array_force_unit_N  # noqa: N806
        return largest_N / GRAVITY_M_S2 * 1e3

    @cached_property
    def last_cycle(self) -> slice:
        """Places of the last cycle in the history."""
        return slice(-SAMPLES * len(self.duty.intervals) // self.duty.cycles, None)

    @cached_property
    def final_C(self) -> float | None:  # noqa: N802
        """Temperature that the wire would take if the current stayed on; None if it melts."""
        return Heating(self.wire, self.around, self.start, self.duty.current_A).final_C

    def time_to_s(self, share: float) -> float | None:
        """Time until a share of the way from the first height to that of austenite is done.

        None when the first heating is too short or too weak for it, or nothing moves.
        """
        heating = Heating(self.wire, self.around, self.start, self.duty.current_A)
        times = np.linspace(0.0, self.duty.heating_s, _FINE_SAMPLES)
        fractions = heating.at(times).fraction
        heights = self._heights_mm(fractions)
        begin, end = heights[0], self.height_mm(1.0)
        return _reached(times, heights - begin, share * (end - begin))

    def time_back_s(self, share: float) -> float | None:
        """Time from switching off until a share of the last stroke has come back; None if not."""
        if not self.duty.cooling_s > 0:
            return None
        off = slice(-SAMPLES, None)
        cycle, own = self.working_mm[self.last_cycle], self.working_mm[off]
        time = self.history.course.time_s[off]
        return _reached(time - time[0], own - own[0], share * (cycle[0] - own[0]))

    def _heights_mm(self, fractions: Values) -> Values:
        if self.load > 0:
            return height_history(self.table, fractions, self.load)[0] * self.radius_mm
        return self.path.response.height(fractions) * self.radius_mm


def _reached(times: Values, changes: Values, wanted: float) -> float | None:
    """Time at which a change reaches what is wanted, of either sign."""
    there = np.flatnonzero(changes * np.sign(wanted) >= abs(wanted))
    if wanted == 0 or not there.size:
        return None
    k = int(there[0])
    if k == 0:
        return float(times[0])
    share = (wanted - changes[k - 1]) / (changes[k] - changes[k - 1])
    return float(times[k - 1] + share * (times[k] - times[k - 1]))


@dataclass(frozen=True)
class SolvedCell:
    """The mechanics of one cell, which neither current nor load nor temperatures change."""

    cell: HeatedCell
    path: CellPath
    table: LoadTable


def solved_cell(
    spec: Specification, progress: Callable[[str], None] = lambda _: None
) -> SolvedCell:
    """Solve the cell of a specification, free from cold to hot and back, and under loads.

    Raises
    ------
    InputError
        When one cell is not all there is to it, or a number lies outside the model.
    NotConvergedError
        When there is no shape to rely on.
    """
    check_one_cell(spec)
    cell = heated_cell(spec)
    progress("shapes from cold to hot and back")
    path = cell_path(cell, tolerance=spec.model.tolerance)
    progress("shapes under load")
    return SolvedCell(cell, path, load_table(cell, path.response))


def actuate(
    spec: Specification,
    current_A: float | None = None,  # noqa: N803
    progress: Callable[[str], None] = lambda _: None,
    solved: SolvedCell | None = None,
) -> Actuation:
    """Heat and cool the array of a specification.

    Parameters
    ----------
    current_A : float, optional
        Instead of the specification's; 0 is no current.
    progress : callable
        Told what is being done.
    solved : SolvedCell, optional
        Of the same cell, to spare its solution.

    Raises
    ------
    InputError
        When one cell is not all there is to it, a number lies outside the model, the wire melts,
        or ``solved`` is another cell's.
    NotConvergedError
        When there is no shape to rely on.
    """
    check_one_cell(spec)
    wire = heated_wire(spec)
    try:
        around = surroundings(spec)
        cycles = duty(spec, spec.current_A if current_A is None else current_A)
        start = at_rest(wire, around.ambient_C)
        history = follow(wire, around, start, cycles.intervals, samples=SAMPLES)
    except SceneError as error:
        raise InputError(f"{spec.name}: {error}") from None
    progress("wire and cut lines")
    body = array_body(spec)
    own = solved_cell(spec, progress) if solved is None else solved
    if own.cell != heated_cell(spec):
        raise InputError(f"{spec.name}: the solved cell is another one's")
    materials = cold_materials(spec)
    return Actuation(spec, body, materials, wire, around, cycles, history, own.path, own.table)
