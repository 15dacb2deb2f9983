"""Registration marks: the same strokes in the stitch file and in the cut file."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from patterns.errors import PatternError

Stroke = NDArray[np.float64]

_CROSS = (np.array([(-0.5, 0.0), (0.5, 0.0)]), np.array([(0.0, -0.5), (0.0, 0.5)]))
_F = (
    np.array([(-0.3, -0.5), (-0.3, 0.5), (0.3, 0.5)]),
    np.array([(-0.3, 0.05), (0.15, 0.05)]),
)
"""Strokes of a mark of size 1 about its centre."""


@dataclass(frozen=True)
class Mark:
    """A mark drawn in strokes.

    Attributes
    ----------
    x_mm, y_mm : float
        Its centre.
    strokes : tuple of arrays (n, 2)
        Open polylines in mm. A cross has two; the asymmetric mark (an F) shows a mirrored sheet.
    """

    x_mm: float
    y_mm: float
    strokes: tuple[Stroke, ...]


def registration_marks(
    bounds_mm: tuple[float, float, float, float], size_mm: float, gap_mm: float
) -> tuple[Mark, ...]:
    """Set four marks around a box: an F at the top left, crosses at the other corners.

    The F has no symmetry, so a sheet that is turned or laid face down shows at once.

    Parameters
    ----------
    bounds_mm : tuple of float
        The box (xmin, ymin, xmax, ymax) that the marks surround.
    size_mm : float
        Height of a mark.
    gap_mm : float
        Free space between the box and each mark, along both axes.

    Returns
    -------
    tuple of Mark
        Top left, top right, bottom right, bottom left.

    Raises
    ------
    PatternError
        When the box is inside out, the size is not positive or the gap is negative.
    """
    xmin, ymin, xmax, ymax = bounds_mm
    if not (xmin <= xmax and ymin <= ymax and size_mm > 0 and gap_mm >= 0):
        raise PatternError(
            f"no registration marks of {size_mm:g} mm at {gap_mm:g} mm from the box {bounds_mm}: "
            "the size must be positive, the gap not negative, the box not inside out"
        )
    out = gap_mm + size_mm / 2
    left, right, bottom, top = xmin - out, xmax + out, ymin - out, ymax + out
    return (
        _mark(left, top, size_mm, _F),
        _mark(right, top, size_mm, _CROSS),
        _mark(right, bottom, size_mm, _CROSS),
        _mark(left, bottom, size_mm, _CROSS),
    )


def _mark(x_mm: float, y_mm: float, size_mm: float, strokes: tuple[Stroke, ...]) -> Mark:
    centre = np.array([x_mm, y_mm])
    return Mark(x_mm, y_mm, tuple(centre + size_mm * stroke for stroke in strokes))
