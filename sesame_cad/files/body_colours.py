"""Colours of fabric and wire in three-dimensional files."""

from __future__ import annotations

from types import MappingProxyType

COLOURS = MappingProxyType({"fabric": "#D9D2C5", "wire": "#0072B2"})
"""By material, ``#RRGGBB``."""


def rgba(colour: str) -> list[int]:
    """Red, green, blue and full opacity, 0 to 255, of ``#RRGGBB``."""
    return [*bytes.fromhex(colour[1:]), 255]
