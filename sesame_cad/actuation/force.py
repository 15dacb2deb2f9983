"""The force of one loop on two rigid plates, cold, hot and between, at one gap or along many."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum

from sesame_cad.actuation.subject import check_one_cell, cold_materials, heated_cell
from sesame_cad.errors import InputError
from sesame_cad.omissions import material_omissions
from sesame_cad.specification import Specification
from solver.actuation.cell_path import HeatedCell
from solver.actuation.transformation import Transformation
from solver.errors import NotConvergedError, SceneError
from solver.held import solve_between_plates
from solver.held_equilibrium import HeldEquilibrium
from solver.materials import LoopMaterials
from solver.omitted import OmittedTerm
from solver.plates import PlateAxis, Plates

TOLERANCE = 5e-3
"""Relative error of force and height that held loops are allowed at the least: where a plate
touches, the error of smooth functions falls slowly."""

_STEPS_OF_TRANSITION = 8


class MeasuredTo(StrEnum):
    """From where the gap counts: the wire's centreline, as all lengths here, or its surface."""

    CENTRELINE = "centreline"
    SURFACE = "surface"


@dataclass(frozen=True)
class Vice:
    """A loop of a specification, and how the plates stand.

    Attributes
    ----------
    spec : Specification
    cell : HeatedCell
    materials : LoopMaterials
        With cold wire: what gives the units their size.
    axis : PlateAxis
    measured_to : MeasuredTo
    """

    spec: Specification
    cell: HeatedCell
    materials: LoopMaterials
    axis: PlateAxis
    measured_to: MeasuredTo

    @property
    def radius_mm(self) -> float:
        """The unit of length."""
        return self.materials.loop_radius_m * 1e3

    @property
    def force_unit_N(self) -> float:  # noqa: N802 - the unit's own spelling
        """The unit of force, which no modulus of the wire changes."""
        return self.materials.force_unit_N

    def plates(self, gap_mm: float) -> Plates:
        """Give the plates in units of R."""
        thick_mm = self.spec.wire.diameter_mm if self.measured_to is MeasuredTo.SURFACE else 0.0
        return Plates(gap_mm / self.radius_mm, self.axis, thick_mm / self.radius_mm)

    def held(
        self, gap_mm: float, fraction: float, start: HeldEquilibrium | None = None
    ) -> HeldEquilibrium:
        """Solve the loop at a gap and a fraction of austenite; errors as `solve_between_plates`."""
        return solve_between_plates(
            self.cell.scene(fraction),
            self.plates(gap_mm),
            tolerance=max(self.spec.model.tolerance, TOLERANCE),
            start=start,
        )


def vice(
    spec: Specification,
    axis: PlateAxis = PlateAxis.LATERAL,
    measured_to: MeasuredTo = MeasuredTo.CENTRELINE,
) -> Vice:
    """Prepare the loop of a specification.

    Raises
    ------
    InputError
        When one circular loop is not all there is to it, or its numbers lie outside the model.
    """
    check_one_cell(spec)
    return Vice(spec, heated_cell(spec), cold_materials(spec), axis, measured_to)


@dataclass(frozen=True)
class ForcePoint:
    """One state of the loop between plates.

    Attributes
    ----------
    gap_mm : float
    fraction : float
        Of austenite: 0 is cold, 1 is hot.
    found : HeldEquilibrium or None
        None when there is no shape to rely on.
    status : str
        ``"converged"``, or why there is none.
    omitted : tuple of OmittedTerm
    """

    gap_mm: float
    fraction: float
    found: HeldEquilibrium | None
    status: str = "converged"
    omitted: tuple[OmittedTerm, ...] = ()


def check_gap(spec: Specification, gap_mm: float, measured_to: MeasuredTo) -> None:
    """Refuse a gap that leaves no room.

    Raises
    ------
    InputError
        With one line.
    """
    least_mm = spec.wire.diameter_mm if measured_to is MeasuredTo.SURFACE else 0.0
    if not gap_mm > least_mm:
        room = f"greater than wire.diameter_mm = {least_mm:g}" if least_mm else "greater than 0"
        raise InputError(f"--gap: {gap_mm:g} mm must be {room}")


def force_point(
    held: Vice, gap_mm: float, fraction: float, start: HeldEquilibrium | None = None
) -> ForcePoint:
    """Solve one state.

    Raises
    ------
    InputError
        When the numbers lie outside the model.
    NotConvergedError
        When there is no shape to rely on, with the state's name.
    """
    try:
        found = held.held(gap_mm, fraction, start)
    except SceneError as error:
        raise InputError(f"{held.spec.name}: {error}") from None
    except NotConvergedError as error:
        raise NotConvergedError(f"{_state_name(fraction)}, gap {gap_mm:g} mm: {error}") from None
    ours = material_omissions(held.spec, held.materials)
    names = {term.term for term in ours}
    kept = tuple(term for term in found.omitted if term.term not in names)
    return ForcePoint(gap_mm, fraction, found, found.status, (*kept, *ours))


def force_curve(held: Vice, states: Iterable[tuple[float, float]]) -> tuple[ForcePoint, ...]:
    """Solve pairs of a gap in mm and a fraction, each from the one before.

    A state without a shape to rely on is told and does not end the curve.

    Raises
    ------
    NotConvergedError
        When no state has one.
    """
    points: list[ForcePoint] = []
    start: HeldEquilibrium | None = None
    for gap_mm, fraction in states:
        try:
            points.append(_solved(held, gap_mm, fraction, start))
            start = points[-1].found
        except NotConvergedError as error:
            points.append(ForcePoint(gap_mm, fraction, None, str(error)))
            start = None
    if points and all(point.found is None for point in points):
        raise NotConvergedError(points[0].status)
    return tuple(points)


def _solved(
    held: Vice, gap_mm: float, fraction: float, start: HeldEquilibrium | None
) -> ForcePoint:
    """Solve from the neighbour, or from the beginning if that leads nowhere."""
    if start is None:
        return force_point(held, gap_mm, fraction)
    try:
        return force_point(held, gap_mm, fraction, start)
    except NotConvergedError:
        return force_point(held, gap_mm, fraction)


@dataclass(frozen=True)
class TemperaturePoint:
    """Force at a temperature, on the way up from martensite or down from austenite."""

    temperature_C: float  # noqa: N815 - the unit's own spelling
    way: str
    point: ForcePoint


def with_transitions(
    law: Transformation,
    temperatures_C: Sequence[float],  # noqa: N803
) -> list[float]:
    """Add to rising temperatures those, within their range, between which the wire transforms.

    All that changes does so between these; evenly spaced ones may step over most of it.
    """
    low, high = min(temperatures_C), max(temperatures_C)
    added = [
        round(start + (finish - start) * k / _STEPS_OF_TRANSITION, 9)
        for start, finish in (
            (law.austenite_start_C, law.austenite_finish_C),
            (law.martensite_finish_C, law.martensite_start_C),
        )
        for k in range(_STEPS_OF_TRANSITION + 1)
    ]
    return sorted({*temperatures_C, *(t for t in added if low <= t <= high)})


def force_against_temperature(
    held: Vice,
    law: Transformation,
    gap_mm: float,
    temperatures_C: Sequence[float],  # noqa: N803
) -> tuple[TemperaturePoint, ...]:
    """Follow the force from cold to hot and back, slowly.

    Parameters
    ----------
    temperatures_C : sequence of float
        Rising.

    Raises
    ------
    NotConvergedError
        When no state has a shape to rely on.
    """
    up = [("heating", t, float(law.heated(t))) for t in temperatures_C]
    down = [("cooling", t, float(law.cooled(t))) for t in reversed(temperatures_C)]
    fractions = sorted({fraction for _, _, fraction in up + down})
    solved = force_curve(held, [(gap_mm, fraction) for fraction in fractions])
    known = dict(zip(fractions, solved, strict=True))
    return tuple(TemperaturePoint(t, way, known[fraction]) for way, t, fraction in up + down)


def _state_name(fraction: float) -> str:
    return {0.0: "cold", 1.0: "hot"}.get(fraction, f"{100 * fraction:.3g} % austenite")
