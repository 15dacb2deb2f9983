"""Tie stitches: small bars that hold two layers together, off the wire."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from patterns.errors import PatternError
from patterns.laid_wire import LaidWire
from patterns.locks import with_locks
from patterns.path import Vectors

BARS = 3
"""How often a tie goes over its two holes."""

ROUND_OFF_MM = 1e-6


def tie_runs(
    middle_mm: Vectors,
    along: Vectors,
    laid: LaidWire,
    *,
    length_mm: float,
    clear_mm: float,
    lock_length_mm: float,
) -> Sequence[Vectors]:
    """Tie two layers together at given places, there and back between two holes each.

    Parameters
    ----------
    middle_mm
        Middles of the ties (n, 2).
    along
        Their directions (n, 2), of any length but 0.
    laid
        Wire in both layers, which the needle must miss.
    length_mm
        From hole to hole; longer than two locks.
    clear_mm
        Smallest distance of the needle from a centreline.
    lock_length_mm
        Length of the stitches that lock the thread, inside the tie.

    Returns
    -------
    sequence of Vectors
        Needle points (m, 2) in mm of each tie, locked at both ends.

    Raises
    ------
    PatternError
        When a tie is too short for its locks, has no direction, or would bring the needle to a
        wire; the message says where.
    """
    if length_mm < 2 * lock_length_mm:
        raise PatternError(
            f"a tie of {length_mm:g} mm has no room for two locks of {lock_length_mm:g} mm"
        )
    size = np.hypot(*along.T)
    if np.any(size == 0):
        raise PatternError(f"tie {int(np.argmin(size)) + 1} has no direction")
    ends = np.where(np.arange(BARS + 1) % 2 == 0, -length_mm / 2, length_mm / 2)
    stations = with_locks(ends, lock_length_mm)  # BARS is odd: it ends where it is locked backward
    runs = middle_mm[:, None] + stations[:, None] * (along / size[:, None])[:, None]
    distance = laid.distance_mm(runs.reshape(-1, 2), clear_mm).reshape(len(runs), -1)
    near = np.flatnonzero(distance.min(axis=1, initial=np.inf) < clear_mm - ROUND_OFF_MM)
    if near.size:
        x, y = middle_mm[near[0]]
        raise PatternError(
            f"the tie at ({x:.2f}, {y:.2f}) mm brings the needle to within "
            f"{distance[near[0]].min():.2f} mm of a wire's centre; it needs {clear_mm:.2f} mm"
        )
    return list(runs)
