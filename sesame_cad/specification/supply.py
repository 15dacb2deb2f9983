"""The section [supply]: what heats the wire."""

from __future__ import annotations

from pydantic import Field

from sesame_cad.specification.section import Section


class SupplySection(Section):
    """The supply's limits; the defaults are those of the paper's supply."""

    voltage_V: float = Field(  # noqa: N815 - the unit's own spelling
        default=18.0, gt=0, le=1000, description="the most that the supply gives, in V"
    )
    current_A: float = Field(  # noqa: N815 - the unit's own spelling
        default=3.0,
        gt=0,
        le=1000,
        description="the most that the supply gives to all circuits together, in A",
    )
