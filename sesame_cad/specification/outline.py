"""The section [outline]: where the fabric is cut."""

from __future__ import annotations

from pydantic import Field

from sesame_cad.specification.section import Section


class OutlineSection(Section):
    """The cut lines around the wire."""

    margin_mm: float = Field(
        default=2.0,
        ge=0.1,
        le=100,
        description="the width in mm of the fabric left beside the wire",
    )
    corner_radius_mm: float = Field(
        default=1.0, ge=0, le=100, description="the radius in mm of the corners of cut lines"
    )
