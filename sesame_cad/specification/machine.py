"""The section [machine]: the embroidery machine and its hoop."""

from __future__ import annotations

from dataclasses import fields
from typing import Annotated

from pydantic import AfterValidator, Field

from patterns.machine import DST_LARGEST_STEP_MM, CouchingMode, Machine
from patterns.sewing_time import SewingPace
from sesame_cad.specification.section import Allowed, Section

MACHINE_NAME = Allowed("1 to 80 printable characters on one line")

PROFILE_NAME = Allowed("the name of a profile, or a file that ends in .toml")

_DEFAULT = Machine(hoop_width_mm=406.0, hoop_height_mm=330.0, needle_diameter_mm=0.75)


def _printable(text: str) -> str:
    if not text.isprintable():
        raise ValueError(f"must be {MACHINE_NAME.text}")
    return text


Colour = Annotated[str, Field(pattern=r"^#[0-9A-Fa-f]{6}$")]
COLOURS = Allowed('a list of four colours, each such as "#1F77B4"')

DEFAULT_PROFILE = "generic-tailored-wire"
"""The profile whose values are the defaults of the keys."""


class MachineSection(Section):
    """A machine, key by key; what a specification leaves out, its profile gives."""

    profile: Annotated[
        str, Field(min_length=1, max_length=200), AfterValidator(_printable), PROFILE_NAME
    ] = Field(
        default=DEFAULT_PROFILE,
        description=(
            "the profile (a text) that gives every key left out here and in [stitching]: a name "
            "from the command machines, or a file beside the specification"
        ),
    )
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
    hoop_rim_mm: float = Field(
        default=_DEFAULT.hoop_rim_mm,
        ge=0,
        le=100,
        description="the width in mm of the strip inside the hoop in which the machine cannot sew",
    )
    couching: CouchingMode = Field(
        default=_DEFAULT.couching,
        description=(
            "what the file holds of the stitches over the wire (a word): needle points to its left "
            "and right, or places on it about which the head swings its needle"
        ),
    )
    swing_mm: float = Field(
        default=_DEFAULT.swing_mm,
        ge=0.5,
        le=12,
        description=(
            "the distance in mm from the left to the right needle point of a head that swings; "
            "used with centreline only"
        ),
    )
    hand_guided: bool = Field(
        default=_DEFAULT.hand_guided,
        description="whether a hand, not a head, leads the wire (true or false)",
    )
    speed_spm: float = Field(
        default=800.0,
        ge=10,
        le=2000,
        description="the machine's speed with thread, in stitches per minute",
    )
    wire_speed_spm: float = Field(
        default=300.0,
        ge=10,
        le=2000,
        description="the machine's speed with wire, in stitches per minute",
    )
    stop_time_s: float = Field(
        default=120.0,
        ge=0,
        le=36_000,
        description="the time in seconds that the operator takes at a stop",
    )
    refuses_zero_colours: bool = Field(
        default=False,
        description=(
            "whether the machine refuses DST files of no colour change, whose header then says 1 "
            "(true or false)"
        ),
    )
    double_stop: bool = Field(
        default=False,
        description=(
            "whether every stop in a DST file is written twice, which forces some machines to stop "
            "(true or false)"
        ),
    )
    threads: Annotated[tuple[Colour, ...], COLOURS] = Field(
        default=("#000000", "#BBBBBB", "#009E73", "#E69F00"),
        strict=False,  # TOML's lists are not tuples
        min_length=4,
        max_length=4,
        description=(
            "the threads' colours (words) for marks, couching, covers, and stripes and ties, in "
            "this order"
        ),
    )

    def geometry(self) -> Machine:
        """Give the machine as the geometry knows it."""
        return Machine(**self.model_dump(include={field.name for field in fields(Machine)}))

    @property
    def pace(self) -> SewingPace:
        """How fast the machine and its operator work."""
        return SewingPace(self.speed_spm, self.wire_speed_spm, self.stop_time_s)
