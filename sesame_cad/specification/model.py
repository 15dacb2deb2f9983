"""The section [model]: which mechanics predicts the shape, and how finely."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from sesame_cad.specification.section import Section


class ModelSection(Section):
    """The energy that is minimised, and the accuracy that is asked for."""

    reading: Literal["plane-stress", "published"] = Field(
        default="plane-stress",
        description=(
            "the reading of the fabric's energy (a word): for a thin sheet in plane stress, "
            "or as printed in the paper"
        ),
    )
    tolerance: float = Field(
        default=1e-4,
        ge=1e-8,
        le=0.1,
        description="the error allowed in the computed shape, relative to its size (no unit)",
    )
