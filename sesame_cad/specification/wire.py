"""The section [wire]: the shape-memory wire, cold and hot."""

from __future__ import annotations

from pydantic import Field

from patterns.electrics import one_second_current_A
from sesame_cad.specification.section import Section

LARGEST_MODULUS_GPA = 2000.0
"""Stiffer than diamond: beyond this somebody mistook the unit."""


class WireSection(Section):
    """The wire; moduli from Table I of the paper, the rest usual for nickel-titanium."""

    diameter_mm: float = Field(ge=0.001, le=10, description="the wire's diameter in mm")
    modulus_cold_GPa: float = Field(  # noqa: N815 - the unit's own spelling
        default=28.0,
        ge=1e-3,
        le=LARGEST_MODULUS_GPA,
        description="the wire's elastic modulus below its transition, in GPa",
    )
    modulus_hot_GPa: float = Field(  # noqa: N815 - the unit's own spelling
        default=75.0,
        ge=1e-3,
        le=LARGEST_MODULUS_GPA,
        description="the wire's elastic modulus above its transition, in GPa",
    )
    transition_C: float = Field(  # noqa: N815 - the unit's own spelling
        default=40.0, ge=-200, le=1000, description="the wire's transition temperature in °C"
    )
    resistivity_cold_uohm_cm: float = Field(
        default=80.0,
        ge=0.1,
        le=1e5,
        description="the wire's resistivity below its transition, in microohm cm",
    )
    resistivity_hot_uohm_cm: float = Field(
        default=100.0,
        ge=0.1,
        le=1e5,
        description="the wire's resistivity above its transition, in microohm cm",
    )
    density_g_cm3: float = Field(
        default=6.45, ge=0.1, le=25, description="the wire's density in g/cm3"
    )
    current_A: float | None = Field(  # noqa: N815 - the unit's own spelling
        default=None,
        gt=0,
        le=1000,
        description=(
            "the current in A with which a circuit is heated; when left out, that which heats "
            "nickel-titanium wire of the diameter in one second in still air"
        ),
    )

    @property
    def design_current_A(self) -> float:  # noqa: N802 - the unit's own spelling
        """The current with which a circuit is heated, in A."""
        return one_second_current_A(self.diameter_mm) if self.current_A is None else self.current_A
