"""The section [fabric]: what is stretched."""

from __future__ import annotations

from pydantic import Field

from sesame_cad.specification.section import Section


class FabricSection(Section):
    """The stretched fabric; defaults from Table I of the paper, Poisson's ratio of a knit."""

    prestrain: float = Field(
        default=0.3,
        gt=0,
        le=2,
        description="the fabric's strain in the hoop, the same both ways (no unit; 0.3 is 30 %)",
    )
    thickness_mm: float = Field(
        default=0.27,
        ge=0.001,
        le=10,
        description="the fabric's thickness in mm, before it is stretched",
    )
    modulus_kPa: float = Field(  # noqa: N815 - the unit's own spelling
        default=700.0, ge=0.01, le=1e7, description="the fabric's elastic modulus in kPa"
    )
    poisson: float = Field(
        default=0.45, gt=-1, lt=0.5, description="the fabric's Poisson's ratio (no unit)"
    )
    areal_density_g_m2: float = Field(
        default=190.0,
        ge=0.1,
        le=1e5,
        description="the fabric's mass in g/m2, before it is stretched",
    )
