"""How a Surface Evolver datafile spells numbers."""

from __future__ import annotations


def text(value: float) -> str:
    """Shortest text that reads back as the same number; zero has no sign."""
    return repr(float(value) + 0.0)
