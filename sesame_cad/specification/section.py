"""What every section of a specification has in common."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from pydantic import BaseModel, ConfigDict


@dataclass(frozen=True, slots=True)
class Allowed:
    """What a key may hold, in words, where its type and limits do not say it all.

    Attributes
    ----------
    text : str
        Continues "must be ...".
    """

    text: str


class Section(BaseModel):
    """Keys of one section: unknown ones are faults, and a value is never converted.

    Descriptions of keys begin with the thing and name the unit, so that "give ..." can stand
    before them.
    """

    model_config: ClassVar[ConfigDict] = ConfigDict(
        frozen=True,
        extra="forbid",
        strict=True,
        allow_inf_nan=False,
        validate_default=True,
    )
