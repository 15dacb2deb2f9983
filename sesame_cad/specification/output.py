"""The section [output]: which files are written."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator, Field

from sesame_cad.specification.section import Section

StitchFormat = Literal["dst", "exp", "u01"]


def _dst_first(formats: tuple[StitchFormat, ...]) -> tuple[StitchFormat, ...]:
    # Whatever else is asked for, the rules are checked on the DST file: it is always written.
    return tuple(dict.fromkeys(("dst", *formats)))


class OutputSection(Section):
    """Stitch formats, the thickness of the preview, pictures."""

    formats: Annotated[tuple[StitchFormat, ...], AfterValidator(_dst_first)] = Field(
        default=("dst",),
        strict=False,  # TOML's lists are not tuples
        description="the stitch files' formats (words); dst is always written",
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
    pictures: bool = Field(default=True, description="whether pictures are drawn (true or false)")
