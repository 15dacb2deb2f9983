"""The section [wiring]: which loops share a wire."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from sesame_cad.specification.section import Allowed, Section
from sesame_cad.specification.wire import LARGEST_MODULUS_GPA, WireSection

CIRCUITS = Allowed(
    "a list, each item with a name (letters, digits and - _ .) and cells or loops, such as "
    '{name = "left", cells = [[1, 1], [1, 2]]}, and if they differ from the rest terminals, '
    "wire_diameter_mm, "
    "wire_modulus_cold_GPa, wire_modulus_hot_GPa, wire_resistivity_cold_uohm_cm, "
    "wire_resistivity_hot_uohm_cm, wire_density_g_cm3 and wire_current_A"
)

_OWN = "wire_"


class CircuitItem(Section):
    """One circuit: its loops, and how its wire differs from that of the section [wire]."""

    name: str = Field(
        pattern=r"^[A-Za-z0-9][A-Za-z0-9._-]{0,31}$", description="the circuit's name"
    )
    cells: tuple[Annotated[tuple[int, int], Field(strict=False)], ...] = Field(
        default=(), strict=False, description="its loops: row and column, from 1"
    )
    loops: tuple[int, ...] = Field(
        default=(), strict=False, description="its loops: places in layout.circles, from 0"
    )
    terminals: Literal["corner", "left", "right", "top", "bottom"] | None = Field(
        default=None, description="where its tails leave"
    )
    wire_diameter_mm: float | None = Field(
        default=None, ge=0.001, le=10, description="its wire's diameter in mm"
    )
    wire_modulus_cold_GPa: float | None = Field(  # noqa: N815 - the unit's own spelling
        default=None, ge=1e-3, le=LARGEST_MODULUS_GPA, description="its wire's modulus, cold"
    )
    wire_modulus_hot_GPa: float | None = Field(  # noqa: N815 - the unit's own spelling
        default=None, ge=1e-3, le=LARGEST_MODULUS_GPA, description="its wire's modulus, hot"
    )
    wire_resistivity_cold_uohm_cm: float | None = Field(
        default=None, ge=0.1, le=1e5, description="its wire's resistivity, cold"
    )
    wire_resistivity_hot_uohm_cm: float | None = Field(
        default=None, ge=0.1, le=1e5, description="its wire's resistivity, hot"
    )
    wire_density_g_cm3: float | None = Field(
        default=None, ge=0.1, le=25, description="its wire's density in g/cm3"
    )
    wire_current_A: float | None = Field(  # noqa: N815 - the unit's own spelling
        default=None, gt=0, le=1000, description="its wire's design current in A"
    )

    def wire(self, common: WireSection) -> WireSection:
        """Give its wire: that of the section [wire] but for what the circuit has of its own."""
        own = {
            key.removeprefix(_OWN): value
            for key, value in self.model_dump().items()
            if key.startswith(_OWN) and value is not None
        }
        if "diameter_mm" in own:  # a current given for wire of another diameter does not hold
            own = {"current_A": None, **own}
        return common.model_copy(update=own)


class WiringSection(Section):
    """Circuits, given one by one or found."""

    split: Literal["none", "groups", "auto"] = Field(
        default="none",
        description=(
            "how the loops are divided among circuits (a word): not at all, a circuit for each "
            "group of touching loops, or the fewest parallel circuits that the supply can drive"
        ),
    )
    circuits: Annotated[tuple[CircuitItem, ...], CIRCUITS] = Field(
        default=(),
        strict=False,  # TOML's lists are not tuples
        description=(
            "the circuits in the order in which they are laid, each with its name (a text), its "
            "own wire and terminals; every loop in one (cells: row and column from 1 at the bottom "
            "left; loops: places in layout.circles from 0); without any, one wire runs through "
            "all loops"
        ),
    )
