"""Lock stitches: a small stitch forward and back that holds the end of a thread."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

POINTS_PER_LOCK = 2
"""Needle points that a lock adds at each end of a run."""


def with_locks(stations_mm: NDArray[np.float64], lock_length_mm: float) -> NDArray[np.float64]:
    """Lock both ends of a run that is sewn in the direction of rising stations.

    Parameters
    ----------
    stations_mm
        Where the needle goes in (n,), as lengths along the line that is sewn.
    lock_length_mm
        Length of the lock stitches.

    Returns
    -------
    array (n + 2 * POINTS_PER_LOCK,)
        At the first station forward and back, and at the last one back and forward again.
    """
    locked = np.pad(stations_mm, POINTS_PER_LOCK, mode="edge")
    locked[1] += lock_length_mm
    locked[-2] -= lock_length_mm
    return locked


def sides_with_locks(sides: NDArray[np.float64]) -> NDArray[np.float64]:
    """Repeat the side of the wire on which a run begins and ends, for the stitches of its locks."""
    return np.pad(sides, POINTS_PER_LOCK, mode="edge")
