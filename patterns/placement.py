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
            stroke = np.array([(x + along * ARM_MM, y), (x, y), (x, y + up * ARM_MM)])
            found.append(Mark(x, y, (stroke,)))
    return _clear(found, laid)


def end_marks(pieces: Sequence[Polygon], laid: LaidWire) -> tuple[Mark, ...]:
    """Set a short line across the axis, which is along x, beyond both ends of each piece.

    Parameters
    ----------
    pieces, laid
        As of `corner_marks`.
    """
    found: list[Mark] = []
    for piece in pieces:
        left, bottom, right, top = piece.bounds
        middle = (bottom + top) / 2
        for x in (left - GAP_MM, right + GAP_MM):
            stroke = np.array([(x, middle - ARM_MM / 2), (x, middle + ARM_MM / 2)])
            found.append(Mark(x, middle, (stroke,)))
    return _clear(found, laid)


def _clear(marks: list[Mark], laid: LaidWire) -> tuple[Mark, ...]:
    """Leave out marks too near to wire."""
    return tuple(
        mark
        for mark in marks
        if all(
            np.all(laid.distance_mm(_close(stroke), CLEAR_MM) >= CLEAR_MM)
            for stroke in mark.strokes
        )
    )


def _close(stroke: np.ndarray) -> np.ndarray:
    """Points along a stroke that are near to one another."""
    share = np.linspace(0.0, 1.0, 13)[:, None]
    parts = [a + share * (b - a) for a, b in pairwise(stroke)]
    return np.concatenate(parts)
