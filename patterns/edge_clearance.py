"""How near straight edges come to wire."""

from __future__ import annotations

import numpy as np

from patterns.path import Vectors
from patterns.wire_index import Numbers, WireIndex


def edge_clearance_mm(
    start_mm: Vectors, end_mm: Vectors, wire: WireIndex, reach_mm: float
) -> Numbers:
    """Give the distance of each edge to a wire that it does not cross.

    Exact: an edge is nearest to an arc in an end of either, or in the foot of the arc's centre.

    Parameters
    ----------
    start_mm, end_mm : array (n, 2)
        Ends of the edges.
    wire : WireIndex
        The wire's centreline.
    reach_mm : float
        Farther wire need not be found.

    Returns
    -------
    array (n,)
        Distance in mm; where it is more than the reach it may be too large.
    """
    result = np.full(len(start_mm), np.inf)
    edge, piece = wire.pairs(start_mm, end_mm, reach_mm)
    targets = wire.targets_mm[piece]
    start, end = start_mm[edge], end_mm[edge]
    for place in (start, end, *(_foot(targets[:, k], start, end) for k in range(3))):
        np.minimum.at(result, edge, wire.distance_mm(place, piece))
    return result


def _foot(target: Vectors, start: Vectors, end: Vectors) -> Vectors:
    along = end - start
    share = np.sum((target - start) * along, axis=1) / np.sum(along**2, axis=1)
    return start + np.clip(share, 0.0, 1.0)[:, None] * along
