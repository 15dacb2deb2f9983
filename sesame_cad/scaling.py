"""The same shape at another size: what of a design stays as it is, and what does not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from math import pi
from typing import Any

from patterns.electrics import ONE_SECOND_A, one_second_current_A, resistance_ohm
from sesame_cad.omissions import GRAVITY_M_S2, loop_mass_kg
from sesame_cad.specification import Specification
from sesame_cad.state import loop_materials, loop_scene
from solver.checks import smallest_bend_radius
from solver.compact import solve_loop
from solver.equilibrium import Equilibrium
from solver.materials import LoopMaterials

STOCK_MM = tuple(diameter for diameter, _ in ONE_SECOND_A)
"""Diameters in which makers of actuator wire sell it."""

SIMILAR = (
    "height, pitch and every other length, over the loop's diameter",
    "strains and stresses of the fabric over its modulus",
    "the prestrain at which the loop buckles, and whether it flattens when hot",
)
"""What depends on β, ε and ν alone, for a wire that hardly stretches."""


@dataclass(frozen=True, slots=True)
class Loop:
    """One loop of a wire, of the same β as another.

    Attributes
    ----------
    wire_diameter_mm, loop_diameter_mm : float
    height_mm, pitch_mm : float
        Cold.
    smallest_bend_radius_mm : float
        Of the cold wire.
    wire_surface_strain : float
        Half the wire's diameter over that radius, less that with which it was laid.
    resistance_cold_ohm, resistance_hot_ohm : float
        Of a loop's wire.
    current_A, power_W : float
        That heats it in one second in still air, and what a hot loop then takes.
    force_unit_N, energy_unit_mJ : float
        E_f t R and E_f t R², with which forces and energies of equal shapes grow.
    axial_stiffness : float
        E_w A_w/(E_f t R): a wire that stretches more is not quite similar.
    weight_over_force_unit : float
        Weight of a loop over E_f t R: gravity is left out, and not similar.
    """

    wire_diameter_mm: float
    loop_diameter_mm: float
    height_mm: float
    pitch_mm: float
    smallest_bend_radius_mm: float
    wire_surface_strain: float
    resistance_cold_ohm: float
    resistance_hot_ohm: float
    current_A: float  # noqa: N815 - the unit's own spelling
    power_W: float  # noqa: N815
    force_unit_N: float  # noqa: N815
    energy_unit_mJ: float  # noqa: N815
    axial_stiffness: float
    weight_over_force_unit: float


@dataclass(frozen=True, slots=True)
class Materials:
    """What the new loop is made of, where it differs: moduli as in a specification."""

    fabric_modulus_kPa: float | None = None  # noqa: N815 - the unit's own spelling
    fabric_thickness_mm: float | None = None
    wire_modulus_cold_GPa: float | None = None  # noqa: N815
    wire_modulus_hot_GPa: float | None = None  # noqa: N815


@dataclass(frozen=True)
class Scaling:
    """A design, and the loops of equal β.

    Attributes
    ----------
    beta, beta_hot, like_beta_hot : float
        Equal for both when cold; when hot only if the ratio of the moduli is.
    like, asked : Loop
    stock : tuple of Loop
    """

    beta: float
    beta_hot: float
    like_beta_hot: float
    like: Loop
    asked: Loop
    stock: tuple[Loop, ...]

    def data(self) -> dict[str, Any]:
        """Give plain data; ratios are of the asked loop to that of the design."""
        like, asked = asdict(self.like), asdict(self.asked)
        thicker = self.asked.wire_diameter_mm / self.like.wire_diameter_mm
        return {
            "beta": self.beta,
            "beta_hot": self.beta_hot,
            "like_beta_hot": self.like_beta_hot,
            "loop_diameter_mm": self.asked.loop_diameter_mm,
            "like": like,
            "asked": asked,
            "similar": list(SIMILAR),
            "ratios": {
                **{key: asked[key] / like[key] for key in like},
                "cooling_time_least": min(thicker, thicker**2),
                "cooling_time_most": max(thicker, thicker**2),
            },
            "stock": [asdict(loop) for loop in self.stock],
        }


def with_materials(
    spec: Specification, changed: Materials, wire_diameter_mm: float
) -> Specification:
    """Give the design with other materials."""
    given = {key: value for key, value in asdict(changed).items() if value is not None}
    fabric = {key: given[f"fabric_{key}"] for key in _FABRIC if f"fabric_{key}" in given}
    wire = {key: given[f"wire_{key}"] for key in _WIRE if f"wire_{key}" in given}
    wire["diameter_mm"] = wire_diameter_mm
    return spec.model_copy(
        update={
            "fabric": spec.fabric.model_copy(update=fabric),
            "wire": spec.wire.model_copy(update=wire),
        }
    )


_FABRIC = ("modulus_kPa", "thickness_mm")
_WIRE = ("modulus_cold_GPa", "modulus_hot_GPa")


def scaled(
    spec: Specification,
    wire_diameter_mm: float,
    changed: Materials | None = None,
    stock_mm: Sequence[float] = STOCK_MM,
) -> Scaling:
    """Find the loops of other wires that take a design's shape.

    Raises
    ------
    SceneError
        When the design lies outside the model.
    NotConvergedError
        When its shape cannot be relied on.
    """
    changed = changed or Materials()
    materials = loop_materials(spec, spec.wire.modulus_cold_GPa)
    found = solve_loop(loop_scene(spec, materials), tolerance=spec.model.tolerance)
    beta = materials.beta

    def loop(diameter_mm: float) -> tuple[Loop, LoopMaterials]:
        other = with_materials(spec, changed, diameter_mm)
        own = loop_materials(other, other.wire.modulus_cold_GPa)
        own = replace(own, loop_radius_m=own.radius_of_beta(beta))
        return _loop(other, own, found), own

    asked, own = loop(wire_diameter_mm)
    other = with_materials(spec, changed, wire_diameter_mm)
    return Scaling(
        beta=beta,
        beta_hot=replace(own, wire_modulus_Pa=other.wire.modulus_hot_GPa * 1e9).beta,
        like_beta_hot=loop_materials(spec, spec.wire.modulus_hot_GPa).beta,
        like=_loop(spec, materials, found),
        asked=asked,
        stock=tuple(loop(diameter)[0] for diameter in stock_mm),
    )


def _loop(spec: Specification, materials: LoopMaterials, found: Equilibrium) -> Loop:
    """Give the numbers of one loop from the shape that all have in common."""
    wire = spec.wire
    radius_mm = materials.loop_radius_m * 1e3
    length_mm = 2 * pi * radius_mm
    bend_mm = smallest_bend_radius(found.shape, found.degree) * radius_mm
    cold, hot = (
        resistance_ohm(length_mm, wire.diameter_mm, resistivity)
        for resistivity in (wire.resistivity_cold_uohm_cm, wire.resistivity_hot_uohm_cm)
    )
    current = one_second_current_A(wire.diameter_mm)
    weight_N = loop_mass_kg(spec, radius_mm) * GRAVITY_M_S2  # noqa: N806 - the unit's own spelling
    return Loop(
        wire_diameter_mm=wire.diameter_mm,
        loop_diameter_mm=2 * radius_mm,
        height_mm=found.shape.height * radius_mm,
        pitch_mm=found.shape.width * radius_mm,
        smallest_bend_radius_mm=bend_mm,
        wire_surface_strain=wire.diameter_mm / 2 * (1 / bend_mm - 1 / radius_mm),
        resistance_cold_ohm=cold,
        resistance_hot_ohm=hot,
        current_A=current,
        power_W=current**2 * hot,
        force_unit_N=materials.force_unit_N,
        energy_unit_mJ=materials.energy_unit_J * 1e3,
        axial_stiffness=materials.axial_stiffness,
        weight_over_force_unit=weight_N / materials.force_unit_N,
    )
