"""What the model of the shape leaves out of a real array, in numbers."""

from __future__ import annotations

import math

from sesame_cad.specification import Specification
from solver.checks import CONTACT, smallest_wire_gap
from solver.equilibrium import Equilibrium
from solver.materials import LoopMaterials
from solver.omitted import SMALL, OmittedTerm

GRAVITY_M_S2 = 9.80665


def loop_mass_kg(spec: Specification, radius_mm: float | None = None) -> float:
    """Mass of one loop of wire and the fabric in it; of the design's own radius or another."""
    radius_m = (spec.layout.diameter_mm / 2 if radius_mm is None else radius_mm) / 1e3
    wire_area_m2 = math.pi * (spec.wire.diameter_mm / 2e3) ** 2
    wire_kg = 2 * math.pi * radius_m * wire_area_m2 * spec.wire.density_g_cm3 * 1e3
    unstretched_m2 = math.pi * (radius_m / (1 + spec.fabric.prestrain)) ** 2
    return wire_kg + unstretched_m2 * spec.fabric.areal_density_g_m2 / 1e3


def omissions(
    spec: Specification, materials: LoopMaterials, found: Equilibrium
) -> tuple[OmittedTerm, ...]:
    """Everything left out: what the solve itself found, and what the materials and cut add.

    Contact is judged with the real wire's diameter instead of a line's.
    """
    gap_mm = smallest_wire_gap(found.shape) * spec.layout.diameter_mm / 2
    return (
        *(term for term in found.omitted if term.term != CONTACT),
        OmittedTerm(
            CONTACT,
            "wire diameter / smallest distance across the loop",
            spec.wire.diameter_mm / max(gap_mm, 1e-9),
            matters=gap_mm < 2 * spec.wire.diameter_mm,
            fatal=gap_mm <= spec.wire.diameter_mm,
        ),
        *material_omissions(spec, materials),
    )


def material_omissions(spec: Specification, materials: LoopMaterials) -> tuple[OmittedTerm, ...]:
    """What materials and cut add to any shape, measured on the largest loop."""
    alpha = materials.alpha(spec.fabric.poisson)
    weight = loop_mass_kg(spec) * GRAVITY_M_S2 / materials.force_unit_N
    margin = (spec.outline.margin_mm + spec.wire.diameter_mm / 2) / (spec.layout.diameter_mm / 2)
    return (
        OmittedTerm("bending of the fabric", "alpha", alpha, matters=alpha > SMALL),
        OmittedTerm("gravity", "weight of a loop / (E_f t R)", weight, matters=weight > SMALL),
        OmittedTerm(
            "fabric left outside the wire", "width of the rim / R", margin, matters=margin > 0.25
        ),
    )
