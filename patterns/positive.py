"""Lengths that must be positive, told with their names."""

from __future__ import annotations

from math import isfinite

from patterns.errors import PatternError


def check_positive(thing: str, **quantities: float) -> None:
    """Refuse quantities that are not positive and finite.

    Parameters
    ----------
    thing : str
        What they belong to, for the message.
    **quantities : float
        Each under the name that it has there.

    Raises
    ------
    PatternError
        One line that names each of them and its value.
    """
    wrong = [
        f"{name} is {value:g}"
        for name, value in quantities.items()
        if not (isfinite(value) and value > 0)
    ]
    if wrong:
        raise PatternError(f"no {thing} when {' and '.join(wrong)}: each must be greater than 0")
