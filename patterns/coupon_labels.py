"""Stitched letters and numbers of a coupon."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np

from patterns.coupon_wire import CouponWire
from patterns.registration import Mark

HEIGHT_MM, WIDTH_MM = 4.0, 2.4
ABOVE_MM = 4.5
"""Middle of a label above what it names."""

BESIDE_MM = 4.0
"""Middle of a row's letter from the row's beginning."""

_SEGMENTS: Mapping[str, tuple[tuple[float, float], tuple[float, float]]] = MappingProxyType(
    {
        "top": ((0, 1), (1, 1)),
        "upper left": ((0, 0.5), (0, 1)),
        "upper right": ((1, 0.5), (1, 1)),
        "middle": ((0, 0.5), (1, 0.5)),
        "lower left": ((0, 0), (0, 0.5)),
        "lower right": ((1, 0), (1, 0.5)),
        "bottom": ((0, 0), (1, 0)),
    }
)
_DIGITS: Mapping[int, tuple[str, ...]] = MappingProxyType(
    {
        1: ("upper right", "lower right"),
        2: ("top", "upper right", "middle", "lower left", "bottom"),
        3: ("top", "upper right", "middle", "lower right", "bottom"),
        4: ("upper left", "middle", "upper right", "lower right"),
        5: ("top", "upper left", "middle", "lower right", "bottom"),
        6: ("top", "upper left", "middle", "lower left", "lower right", "bottom"),
    }
)
_LETTERS: Mapping[str, tuple[tuple[tuple[float, float], ...], ...]] = MappingProxyType(
    {
        "width": (((0, 1), (0.2, 0), (0.5, 0.6), (0.8, 0), (1, 1)),),
        "interval": (((0, 1), (1, 1)), ((0.5, 1), (0.5, 0)), ((0, 0), (1, 0))),
        "cover": (((1, 1), (0, 1), (0, 0), (1, 0)),),
    }
)


def label_marks(
    cells: Sequence[tuple[str, int, float, float]], wire: CouponWire
) -> tuple[Mark, ...]:
    """Give a letter to each row and a number to each cell, off the wire.

    Parameters
    ----------
    cells
        Row, number from 1 to 6, and middle of each cell.
    """
    marks: list[Mark] = []
    for row, number, x, y in cells:
        above = y + ABOVE_MM + (wire.wave_mm if row == "cover" else 0.0)
        if number == 1:
            marks.append(_mark(_LETTERS[row], wire.left_mm - BESIDE_MM, above))
        marks.append(_mark([_SEGMENTS[name] for name in _DIGITS[number]], x, above))
    return tuple(marks)


def _mark(strokes: Sequence[Sequence[tuple[float, float]]], x_mm: float, y_mm: float) -> Mark:
    size, centre = np.array([WIDTH_MM, HEIGHT_MM]), np.array([x_mm, y_mm])
    return Mark(x_mm, y_mm, tuple(centre + size * (np.array(stroke) - 0.5) for stroke in strokes))
