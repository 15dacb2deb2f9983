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
        description=(
            "the error allowed in the computed shape, relative to its size (no unit); coupled "
            "shapes are allowed 0.1 at the least"
        ),
    )
    fidelity: Literal["auto", "compact", "mesh"] = Field(
        default="auto",
        description=(
            "what the shape is solved with (a word): smooth functions, which know one cell; a "
            "mesh, which knows all loops together; or what the prediction takes"
        ),
    )
    refinement: int = Field(
        default=0,
        ge=0,
        le=3,
        description=(
            "how often the mesh of a coupled shape is refined (a count), whatever its error, which "
            "is told; 0 is until the tolerance is met"
        ),
    )
