"""Sewn lines that show where flat pieces are to be laid on the fabric."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from shapely import Polygon

from patterns.laid_wire import LaidWire
from patterns.registration import Mark

GAP_MM = 1.0
"""Between a piece and its marks, so that they stay in sight."""

ARM_MM = 6.0
CLEAR_MM = 3.0
"""Marks nearer to a wire than this are left out: stitches that tie the wire need the room."""


def corner_marks(pieces: Sequence[Polygon], laid: LaidWire) -> tuple[Mark, ...]:
    """Set an angle at each corner of the box around each piece, outside of it.

    Parameters
    ----------
    pieces
        As they are to be laid.
    laid
        Wire that the needle must miss, laid before or after the marks.
    """
    found: list[Mark] = []
    for piece in pieces:
        left, bottom, right, top = piece.bounds
        for x, y, along, up in (
            (left - GAP_MM, top + GAP_MM, 1, -1),
            (right + GAP_MM, top + GAP_MM, -1, -1),
            (right + GAP_MM, bottom - GAP_MM, -1, 1),
            (left - GAP_MM, bottom - GAP_MM, 1, 1),
        ):
            arm = min(ARM_MM, (top - bottom) / 3)
            stroke = np.array([(x + along * arm, y), (x, y), (x, y + up * arm)])
            if np.all(laid.distance_mm(_close(stroke), CLEAR_MM) >= CLEAR_MM):
                found.append(Mark(x, y, (stroke,)))
    return tuple(found)


def _close(stroke: np.ndarray) -> np.ndarray:
    """Points along a stroke that are near to one another."""
    share = np.linspace(0.0, 1.0, 13)[:, None]
    parts = [a + share * (b - a) for a, b in pairwise(stroke)]
    return np.concatenate(parts)
