"""The section [output]: which files are written."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator, Field

from sesame_cad.specification.section import Allowed, Section

NOTES = Allowed("at most 2000 printable characters and line ends")

ShapeFormat = Literal["stl", "3mf", "glb", "vtu"]

StitchFormat = Literal["dst", "exp", "u01", "pes", "jef", "vp3"]


def _dst_first(formats: tuple[StitchFormat, ...]) -> tuple[StitchFormat, ...]:
    # Whatever else is asked for, the rules are checked on the DST file: it is always written.
    return tuple(dict.fromkeys(("dst", *formats)))


def _once(formats: tuple[ShapeFormat, ...]) -> tuple[ShapeFormat, ...]:
    return tuple(dict.fromkeys(formats))


def _readable(text: str) -> str:
    if not text.replace("\n", "").isprintable():
        raise ValueError(f"must be {NOTES.text}")
    return text


class OutputSection(Section):
    """Stitch formats, the thickness of the preview, pictures, the worksheet."""

    formats: Annotated[tuple[StitchFormat, ...], AfterValidator(_dst_first)] = Field(
        default=("dst",),
        strict=False,  # TOML's lists are not tuples
        description="the stitch files' formats (words); dst is always written",
    )
    shapes: Annotated[tuple[ShapeFormat, ...], AfterValidator(_once)] = Field(
        default=("stl", "3mf", "glb", "vtu"),
        strict=False,
        description=(
            "the formats of the shapes (words): stl for printing, 3mf for printing with two "
            "materials, glb for viewers, vtu with stretch and stress for ParaView"
        ),
    )
    preview_thickness_mm: float | None = Field(
        default=None,
        ge=0.001,
        le=10,
        description=(
            "the thickness in mm of the fabric in the printable preview, no more than the wire's; "
            "when left out, the fabric's own, but at most 0.8 wire diameters"
        ),
    )
    paper: Literal["a4", "letter"] = Field(
        default="a4", description="the paper of the worksheet (a word)"
    )
    notes: Annotated[str, Field(max_length=2000), AfterValidator(_readable), NOTES] = Field(
        default="", description="free notes for the worksheet (a text)"
    )
    pictures: bool = Field(default=True, description="whether pictures are drawn (true or false)")
