"""The heated cell, wire and surroundings that a specification describes."""

from __future__ import annotations

from sesame_cad.errors import InputError
from sesame_cad.specification import Specification
from sesame_cad.specification.prediction import coupled_because
from sesame_cad.state import loop_materials, loop_scene
from solver.actuation.cell_path import HeatedCell
from solver.actuation.duty import Duty
from solver.actuation.transformation import Transformation
from solver.actuation.wire import HeatedWire, Surroundings
from solver.errors import SceneError
from solver.materials import LoopMaterials


def check_one_cell(spec: Specification) -> None:
    """Refuse arrays whose loops do not all move alike.

    Raises
    ------
    InputError
        When one cell is not all there is to solve, or circuits differ in their wire.
    """
    coupling = coupled_because(spec.layout, spec.wiring, spec.wire)
    if coupling is not None:
        raise InputError(
            f"{spec.name}: force and actuation are predicted for equal circles on a square grid or "
            f"in a row, with the fabric between them cut away; {coupling}"
        )
    if any(wire != spec.wire for wire in spec.wires(1)):
        raise InputError(
            f"{spec.name}: wiring.circuits: force and actuation are predicted for circuits of the "
            "wire in [wire] and its current alone"
        )


def cold_materials(spec: Specification) -> LoopMaterials:
    """Give a loop's materials, with martensite in its wire."""
    return loop_materials(spec, spec.wire.modulus_cold_GPa)


def heated_cell(spec: Specification) -> HeatedCell:
    """Give the dimensionless cell.

    Raises
    ------
    InputError
        When its numbers lie outside the model.
    """
    ratio = spec.wire.modulus_hot_GPa / spec.wire.modulus_cold_GPa
    try:
        return HeatedCell(loop_scene(spec, cold_materials(spec)), ratio)
    except SceneError as error:
        raise InputError(f"{spec.name}: {error}") from None


def transformation(spec: Specification) -> Transformation:
    """Give the wire's four transformation temperatures.

    Raises
    ------
    InputError
        When the hysteresis is too narrow for both spans.
    """
    heat = spec.actuation
    start_C = spec.wire.transition_C  # noqa: N806
    middle_C = start_C + heat.heating_span_C / 2 - heat.hysteresis_C  # noqa: N806
    needed_C = abs(heat.cooling_span_C - heat.heating_span_C) / 2  # noqa: N806
    try:
        return Transformation(
            start_C,
            start_C + heat.heating_span_C,
            middle_C + heat.cooling_span_C / 2,
            middle_C - heat.cooling_span_C / 2,
        )
    except SceneError:
        raise InputError(
            f"{spec.name}: actuation.hysteresis_C = {heat.hysteresis_C:g}: must be at least "
            f"{needed_C:g}, half of the difference of heating_span_C and cooling_span_C, and no "
            "temperature below absolute zero"
        ) from None


def heated_wire(spec: Specification) -> HeatedWire:
    """Give the wire of [wire] and [actuation] in SI units.

    Raises
    ------
    InputError
        When its transformation temperatures do not go together.
    """
    wire, heat = spec.wire, spec.actuation
    return HeatedWire(
        diameter_m=wire.diameter_mm / 1e3,
        density_kg_m3=wire.density_g_cm3 * 1e3,
        resistivity_cold_ohm_m=wire.resistivity_cold_uohm_cm * 1e-8,
        resistivity_hot_ohm_m=wire.resistivity_hot_uohm_cm * 1e-8,
        modulus_cold_Pa=wire.modulus_cold_GPa * 1e9,
        modulus_hot_Pa=wire.modulus_hot_GPa * 1e9,
        transformation=transformation(spec),
        heat_capacity_J_kgK=heat.heat_capacity_J_gK * 1e3,
        latent_heat_J_kg=heat.latent_heat_J_g * 1e3,
    )


def surroundings(spec: Specification) -> Surroundings:
    """Give what cools the wire."""
    return Surroundings(spec.actuation.ambient_C, spec.convection_W_m2K)


def duty(spec: Specification, current_A: float) -> Duty:  # noqa: N803
    """Give the cycles of current."""
    heat = spec.actuation
    return Duty(current_A, heat.heating_s, heat.cooling_s, heat.cycles)
