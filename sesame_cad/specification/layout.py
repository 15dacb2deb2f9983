"""The section [layout]: where the loops lie."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BeforeValidator, Field

from sesame_cad.specification.section import Section


def _refuse_kept(value: object) -> object:
    if value == "kept":
        raise ValueError(
            'must be "cut": fabric kept between the loops couples them, '
            "which needs the coupled array solve, not available yet"
        )
    return value


class LayoutSection(Section):
    """Equal loops on a square grid, each touching its neighbours."""

    kind: Literal["grid"] = Field(
        default="grid", description="the arrangement of the loops (a word): a square grid"
    )
    rows: int = Field(ge=1, le=200, description="the number of rows of loops (a count)")
    columns: int = Field(ge=1, le=200, description="the number of loops in a row (a count)")
    loop_diameter_mm: float = Field(
        ge=0.1,
        le=10_000,
        description="the diameter in mm of the wire's centreline in a loop, in the hoop",
    )
    between: Annotated[Literal["cut"], BeforeValidator(_refuse_kept)] = Field(
        default="cut", description="what becomes of the fabric between the loops (a word)"
    )
