"""The section [stitching]: how the wire is tied down and covered."""

from __future__ import annotations

from pydantic import Field

from patterns.stitching import Stitching
from sesame_cad.specification.section import Section

_DEFAULT = Stitching()


class StitchingSection(Section):
    """The settings of `patterns.stitching.Stitching`, whose defaults it takes."""

    couching_interval_mm: float = Field(
        default=_DEFAULT.couching_interval_mm,
        ge=0.5,
        le=10,
        description="the distance in mm along the wire between stitches that tie it down",
    )
    needle_margin_mm: float = Field(
        default=_DEFAULT.needle_margin_mm,
        ge=0.08,
        le=2,
        description=(
            "the free space in mm between needle and wire in the plan; "
            "rounding to the machine's 0.1 mm takes up to 0.071 mm of it"
        ),
    )
    cover_spacing_mm: float = Field(
        default=_DEFAULT.cover_spacing_mm,
        ge=0.1,
        le=2,
        description="the distance in mm along the wire between stitches of a cover",
    )
    cover_reach_mm: float = Field(
        default=_DEFAULT.cover_reach_mm,
        ge=0,
        le=5,
        description="the gap in mm between two passes of wire below which the first is covered",
    )
    lock_length_mm: float = Field(
        default=_DEFAULT.lock_length_mm,
        ge=0.5,
        le=3,
        description="the length in mm of the stitches that lock a thread",
    )
    tail_length_mm: float = Field(
        default=_DEFAULT.tail_length_mm,
        ge=15,
        le=500,
        description="the length in mm of straight wire at each end, for the crimp",
    )
    mark_size_mm: float = Field(
        default=_DEFAULT.mark_size_mm,
        ge=3,
        le=50,
        description="the size in mm of a registration mark",
    )
    mark_gap_mm: float = Field(
        default=_DEFAULT.mark_gap_mm,
        ge=1,
        le=100,
        description="the distance in mm of a registration mark from everything else",
    )
    smallest_bend_diameters: float = Field(
        default=_DEFAULT.smallest_bend_diameters,
        ge=1,
        le=1000,
        description="the smallest bend radius of the wire, in diameters of the wire (no unit)",
    )
