"""The section [sleeve]: two rows of loops around a beam, tied together and compressed."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from patterns.hooks import SleevePlace
from sesame_cad.specification.beam import BeamSection
from sesame_cad.specification.layout import LayoutSection
from sesame_cad.specification.section import Section


def sewn_width_mm(loop_mm: float, wire_mm: float, margin_mm: float) -> float:
    """Width of a row of loops with the fabric beside its wire, as it is sewn."""
    return loop_mm + wire_mm + 2 * margin_mm


class SleeveSection(Section):
    """How a sleeve is tied together and where it lies on its beam."""

    compressed_pitch_mm: float = Field(
        default=0.0,
        ge=0,
        le=10_000,
        description=(
            "the distance in mm of neighbouring loops along the beam when hooks hold the sleeve "
            "compressed; 0 is all the room that one half of the beam has"
        ),
    )
    half: Literal["left", "right"] = Field(
        default="left", description="the half of the beam that holds the compressed sleeve (a word)"
    )
    tie_angle_deg: float = Field(
        default=20.0,
        ge=5,
        le=60,
        description=(
            "direction in degrees, from a loop's stripe, in which ties on both sides of the stripe "
            "hold the upper to the lower loop"
        ),
    )
    tie_length_mm: float = Field(
        default=3.0,
        ge=1,
        le=10,
        description="the length in mm of a tie, from hole to hole across both wires",
    )
    needle_to_beam_mm: float = Field(
        default=0.8,
        ge=0.2,
        le=20,
        description="the least free space in mm between a tie's needle and beams or their frame",
    )
    upper_terminals: Literal["opposite", "same"] = Field(
        default="opposite",
        description=(
            "the end of the rows at which the upper array's tails leave (a word): that opposite to "
            "the lower array's, or the same, where each crimp then lies on another"
        ),
    )

    upper_hoop_rim_mm: float = Field(
        default=10.0,
        ge=0,
        le=1000,
        description=(
            "the width in mm of the rim of the upper array's hoop, which must lie inside that of "
            "the lower one (machine.hoop_width_mm, machine.hoop_height_mm)"
        ),
    )
    rows_joined: int = Field(
        default=1,
        ge=1,
        le=1000,
        description=(
            "the number of neighbouring rows of an array that share one wire, in series, and are "
            "heated together (a count); layout.rows must be a multiple of it"
        ),
    )

    def pitch_mm(self, layout: LayoutSection, beam: BeamSection) -> float:
        """Distance of neighbouring loops when the sleeve is compressed."""
        if self.compressed_pitch_mm:
            return self.compressed_pitch_mm
        begin, end = beam.sleeve_room_mm
        return (end - begin) / (layout.columns or 1)

    def place(self, layout: LayoutSection, beam: BeamSection) -> SleevePlace:
        """Where on the beam hooks hold the sleeve: in the middle of the room on its half."""
        begin, end = beam.sleeve_room_mm
        length = (layout.columns or 1) * self.pitch_mm(layout, beam)
        start = (begin + end - length) / 2
        if self.half == "right":
            start = beam.length_mm - start - length
        return SleevePlace(start, length)
