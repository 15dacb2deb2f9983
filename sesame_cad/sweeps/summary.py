"""A sweep in a few numbers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

from sesame_cad.sweeps.outcome import CONVERGED, Outcome

MOST_REASONS = 5


def summary(outcomes: Sequence[Outcome]) -> dict[str, Any]:
    """Count what came out."""
    heights = [
        found.height_over_perimeter
        for found in outcomes
        if found.physical and found.height_over_perimeter is not None
    ]
    reasons = Counter(
        found.status.split(":")[0].split(" (")[0] for found in outcomes if found.status != CONVERGED
    )
    return {
        "points": len(outcomes),
        "buckled": sum(found.buckled is True for found in outcomes),
        "slack": sum(found.slack is True for found in outcomes),
        "self_meeting": sum(found.self_meeting is True for found in outcomes),
        "not_converged": sum(reasons.values()),
        "reasons": dict(reasons.most_common(MOST_REASONS)),
        "largest_height_over_perimeter": max(heights, default=None),
    }
