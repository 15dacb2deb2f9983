"""How near straight edges come to wire."""

from __future__ import annotations

import numpy as np
from shapely import linestrings

from patterns.path import Arc, Piece, Vectors
from patterns.wire_index import Indices, Numbers, WireIndex


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
    edges = np.asarray(linestrings(np.stack([start_mm, end_mm], axis=1)), dtype=np.object_)
    edge, piece = wire.pairs(edges, reach_mm)
    start, end = start_mm[edge], end_mm[edge]
    targets = np.array([_targets(one) for one in wire.pieces])
    feet = [_foot(targets[piece, k], start, end) for k in range(targets.shape[1])]
    for place in (start, end, *feet):
        _lower(result, edge, wire, piece, place)
    return result


def _targets(piece: Piece) -> Vectors:
    """Ends and (for an arc) centre: the points whose feet on an edge can be nearest, (3, 2)."""
    ends, _ = piece.at(np.array([0.0, piece.length_mm]))
    centre = (piece.centre_x_mm, piece.centre_y_mm) if isinstance(piece, Arc) else ends[0]
    return np.array([*ends, centre])


def _foot(target: Vectors, start: Vectors, end: Vectors) -> Vectors:
    along = end - start
    share = np.sum((target - start) * along, axis=1) / np.sum(along**2, axis=1)
    return start + np.clip(share, 0.0, 1.0)[:, None] * along


def _lower(
    result: Numbers, edge: Indices, wire: WireIndex, piece: Indices, places_mm: Vectors
) -> None:
    distance, _, _ = wire.to_pieces(places_mm, piece)
    np.minimum.at(result, edge, distance)
