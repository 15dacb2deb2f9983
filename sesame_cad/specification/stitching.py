"""The section [stitching]: how the wire is tied down and covered."""

from __future__ import annotations

from pydantic import Field

from patterns.stitching import Stitching, Stripes, Ties, Underlay
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
    couching_angle_deg: float = Field(
        default=_DEFAULT.couching_angle_deg,
        ge=5,
        le=90,
        description=(
            "the largest turn in degrees of the wire from one of these stitches to the next; "
            "on tight bends they are closer for it"
        ),
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
    cover_overlap_mm: float = Field(
        default=_DEFAULT.cover_overlap_mm,
        ge=0,
        le=5,
        description=(
            "the length in mm by which a cover goes on past that on each side, before its last "
            "stitch"
        ),
    )
    cover_margin_mm: float = Field(
        default=_DEFAULT.cover_margin_mm,
        ge=0.08,
        le=2,
        description=(
            "the free space in mm between needle and covered wire in the plan, which makes covers "
            "wider; at least needle_margin_mm is kept"
        ),
    )
    cover_underlay: Underlay = Field(
        default=_DEFAULT.cover_underlay,
        description=(
            "the stitches below a cover (a word): none, or a run along both of its edges; its "
            "middle is the wire"
        ),
    )
    stripes: Stripes = Field(
        default=_DEFAULT.stripes,
        description=(
            "the direction of lines of thread that does not stretch, through the centres of the "
            "loops, sewn last (a word); sleeves always have them across their beams"
        ),
    )
    stripe_stitch_mm: float = Field(
        default=_DEFAULT.stripe_stitch_mm,
        ge=1,
        le=5,
        description="the length in mm of the longest stitch of these lines, but over wire",
    )
    stripe_passes: int = Field(
        default=_DEFAULT.stripe_passes,
        ge=1,
        le=2,
        description="how often these lines are sewn over (a count): once, or there and back",
    )
    ties: Ties = Field(
        default=_DEFAULT.ties,
        description=(
            "ties of thread that does not stretch, sewn over both wires where loops touch, so that "
            "they stay tangent (a word); sleeves have ties of their own"
        ),
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

    def geometry(self) -> Stitching:
        """Give the settings as the geometry knows them."""
        return Stitching(**self.model_dump())
