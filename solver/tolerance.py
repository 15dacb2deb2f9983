"""What may be asked of a solve's accuracy."""

from __future__ import annotations

import math

from solver.errors import SceneError


def check_tolerance(tolerance: float) -> None:
    """Refuse a relative error that no height can be told to.

    Raises
    ------
    SceneError
        When it is not a finite number greater than 0.
    """
    if not (tolerance > 0 and math.isfinite(tolerance)):
        raise SceneError(f"tolerance = {tolerance:g}: must be greater than 0 and finite")
