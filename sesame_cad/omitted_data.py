"""What a model leaves out, as plain data."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:  # the scaling rung must not load what it does not need
    from solver.omitted import OmittedTerm


def omitted_data(terms: Iterable[OmittedTerm]) -> list[dict[str, Any]]:
    """Name, measure, size and whether it matters of each term; null for a size that is unknown."""
    return [
        {
            "term": left.term,
            "measure": left.measure,
            "value": None if math.isnan(left.value) else left.value,
            "matters": left.matters,
        }
        for left in terms
    ]
