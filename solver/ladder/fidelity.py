"""Which rung of the ladder a user asks for."""

from __future__ import annotations

from enum import StrEnum


class Fidelity(StrEnum):
    """A rung, or ``auto``: the cheapest that meets the tolerance."""

    SCALING = "scaling"
    COMPACT = "compact"
    MESH = "mesh"
    AUTO = "auto"
