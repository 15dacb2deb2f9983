"""Words for colours, so that a person can pick the spool."""

from __future__ import annotations

from types import MappingProxyType

import numpy as np

NAMED = MappingProxyType(
    {
        "black": "#000000",
        "dark grey": "#555555",
        "grey": "#808080",
        "light grey": "#BBBBBB",
        "white": "#FFFFFF",
        "red": "#E00000",
        "dark red": "#800000",
        "vermilion": "#D55E00",
        "orange": "#E69F00",
        "brown": "#8B5A2B",
        "beige": "#E8DCC0",
        "yellow": "#F0E442",
        "light green": "#90EE90",
        "green": "#009E73",
        "dark green": "#005028",
        "turquoise": "#40D0D0",
        "sky blue": "#56B4E9",
        "blue": "#0072B2",
        "dark blue": "#00007F",
        "violet": "#7F00FF",
        "purple": "#CC79A7",
        "pink": "#FFB6C1",
    }
)


def rgb(colour: str) -> tuple[int, int, int]:
    """Red, green and blue, 0 to 255, of a colour as in HTML, ``"#rrggbb"``."""
    red, green, blue = bytes.fromhex(colour.removeprefix("#"))
    return red, green, blue


def colour_name(colour: str) -> str:
    """Name the nearest of `NAMED`, by its distance in red, green and blue."""
    own = np.array(rgb(colour))
    return min(NAMED, key=lambda name: float(np.sum((np.array(rgb(NAMED[name])) - own) ** 2)))
