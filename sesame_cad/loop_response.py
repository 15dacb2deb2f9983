"""A real loop's height and pitch, and how they change with every number that makes it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from sesame_cad.specification import Specification
from solver.compact import solve_loop
from solver.equilibrium import Equilibrium
from solver.materials import LoopMaterials
from solver.reading import Reading
from solver.scene import LoopScene
from solver.sensitivity import sensitivities

BETA_POWERS: Mapping[str, int] = MappingProxyType(
    {
        "fabric_modulus_kPa": -1,
        "fabric_thickness_mm": -1,
        "wire_modulus_GPa": 1,
        "wire_diameter_mm": 4,
        "loop_diameter_mm": -3,
    }
)
"""β = E_w π d_w⁴/64 / (2 E_f t R³)."""

AXIAL_POWERS: Mapping[str, int] = MappingProxyType(
    {
        "fabric_modulus_kPa": -1,
        "fabric_thickness_mm": -1,
        "wire_modulus_GPa": 1,
        "wire_diameter_mm": 2,
        "loop_diameter_mm": -1,
    }
)
"""k = E_w π d_w²/4 / (E_f t R)."""


@dataclass(frozen=True, slots=True)
class LoopDesign:
    """One loop in the units of a specification, at one modulus of its wire."""

    loop_diameter_mm: float
    wire_diameter_mm: float
    prestrain: float
    fabric_modulus_kPa: float  # noqa: N815 - the unit's own spelling
    fabric_thickness_mm: float
    poisson: float
    wire_modulus_GPa: float  # noqa: N815
    reading: str

    @property
    def materials(self) -> LoopMaterials:
        """In SI units."""
        return LoopMaterials(
            fabric_modulus_Pa=self.fabric_modulus_kPa * 1e3,
            fabric_thickness_m=self.fabric_thickness_mm / 1e3,
            wire_modulus_Pa=self.wire_modulus_GPa * 1e9,
            wire_diameter_m=self.wire_diameter_mm / 1e3,
            loop_radius_m=self.loop_diameter_mm / 2e3,
        )

    @property
    def scene(self) -> LoopScene:
        """Without dimensions; raises `SceneError` where the model does not reach."""
        own = self.materials
        return LoopScene(
            self.prestrain, own.beta, self.poisson, Reading(self.reading), own.axial_stiffness
        )


def loop_design(spec: Specification, state: str) -> LoopDesign:
    """Take a specification's loop, cold or hot."""
    wire = spec.wire
    return LoopDesign(
        loop_diameter_mm=spec.layout.diameter_mm,
        wire_diameter_mm=wire.diameter_mm,
        prestrain=spec.fabric.prestrain,
        fabric_modulus_kPa=spec.fabric.modulus_kPa,
        fabric_thickness_mm=spec.fabric.thickness_mm,
        poisson=spec.fabric.poisson,
        wire_modulus_GPa=wire.modulus_cold_GPa if state == "cold" else wire.modulus_hot_GPa,
        reading=spec.model.reading,
    )


@dataclass(frozen=True)
class LoopResponse:
    """A solved loop, and the derivatives of its size.

    Attributes
    ----------
    design : LoopDesign
    found : Equilibrium
    height_mm, pitch_mm : float
    height_by, pitch_by : mapping of str to float
        In mm per unit of each of the design's numbers.
    """

    design: LoopDesign
    found: Equilibrium
    height_mm: float
    pitch_mm: float
    height_by: Mapping[str, float]
    pitch_by: Mapping[str, float]


def respond(design: LoopDesign, tolerance: float = 1e-4) -> LoopResponse:
    """Solve a loop and differentiate it.

    Raises
    ------
    SceneError
        When it lies outside the model.
    NotConvergedError
        When its shape cannot be relied on.
    """
    found = solve_loop(design.scene, tolerance=tolerance)
    told = sensitivities(found)
    radius_mm = design.loop_diameter_mm / 2
    height = found.shape.height if found.buckled else 0.0
    by = [
        _in_units(design, found.scene, size, slopes)
        for size, slopes in ((height, told.height), (found.shape.width, told.width))
    ]
    return LoopResponse(
        design, found, height * radius_mm, found.shape.width * radius_mm, by[0], by[1]
    )


def _in_units(
    design: LoopDesign, scene: LoopScene, size: float, slopes: Mapping[str, float]
) -> dict[str, float]:
    """Derivatives in mm per unit, from those of a length ``size`` in units of R."""
    radius_mm = design.loop_diameter_mm / 2
    by = {
        key: radius_mm
        * (
            slopes["beta"] * scene.beta * power
            + slopes["axial_stiffness"] * scene.axial_stiffness * AXIAL_POWERS[key]
        )
        / getattr(design, key)
        for key, power in BETA_POWERS.items()
    }
    by["loop_diameter_mm"] += size / 2
    return {
        **by,
        "prestrain": radius_mm * slopes["strain"],
        "poisson": radius_mm * slopes["poisson"],
    }
