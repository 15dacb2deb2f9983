"""The section [machine]: the embroidery machine and its hoop."""

from __future__ import annotations

from typing import Annotated

from pydantic import AfterValidator, Field

from patterns.machine import DST_LARGEST_STEP_MM, Machine
from sesame_cad.specification.section import Allowed, Section

MACHINE_NAME = Allowed("1 to 80 printable characters on one line")

_DEFAULT = Machine(hoop_width_mm=406.0, hoop_height_mm=330.0, needle_diameter_mm=0.75)


def _printable(text: str) -> str:
    if not text.isprintable():
        raise ValueError(f"must be {MACHINE_NAME.text}")
    return text


class MachineSection(Section):
    """A machine profile; the defaults of `patterns.machine.Machine` and a 13 x 16 inch hoop."""

    name: Annotated[
        str, Field(min_length=1, max_length=80), AfterValidator(_printable), MACHINE_NAME
    ] = Field(
        default="tailored-wire head, Mighty Hoop 13x16 in",
        description="the machine's name, for the worksheet (a text)",
    )
    hoop_width_mm: float = Field(
        default=_DEFAULT.hoop_width_mm,
        ge=10,
        le=10_000,
        description="the width in mm inside the hoop",
    )
    hoop_height_mm: float = Field(
        default=_DEFAULT.hoop_height_mm,
        ge=10,
        le=10_000,
        description="the height in mm inside the hoop",
    )
    needle_diameter_mm: float = Field(
        default=_DEFAULT.needle_diameter_mm,
        ge=0.3,
        le=3,
        description="the diameter in mm of the needle's shaft (0.75 for a needle Nm 75)",
    )
    shortest_stitch_mm: float = Field(
        default=_DEFAULT.shortest_stitch_mm,
        ge=0.1,
        le=0.5,
        description="the length in mm below which stitches are merged",
    )
    longest_stitch_mm: float = Field(
        default=_DEFAULT.longest_stitch_mm,
        ge=2,
        le=DST_LARGEST_STEP_MM,
        description="the length in mm of the longest stitch, along each axis",
    )
    jumps_per_trim: int = Field(
        default=_DEFAULT.jumps_per_trim,
        ge=1,
        le=20,
        description="the number of jumps in a row after which the machine trims (a count)",
    )
