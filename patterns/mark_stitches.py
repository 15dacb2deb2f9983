"""Registration marks in running stitch."""

from __future__ import annotations

from itertools import pairwise

import networkx as nx
import numpy as np
import shapely
from numpy.typing import NDArray

from patterns.locks import with_locks
from patterns.registration import Mark

MARK_STITCH_MM = 2.5

JOINT_MM = 1e-3
"""Strokes that come this near are joined."""

Point = tuple[float, float]
Vectors = NDArray[np.float64]


def mark_stitches(mark: Mark, lock_length_mm: float) -> list[Vectors]:
    """Sew the strokes of a mark there and back, so that joined strokes need no jump.

    Returns
    -------
    list of Vectors
        Needle points (n, 2) in mm of each run, locked at both ends; one run when all strokes are
        joined.
    """
    strokes = shapely.MultiLineString([shapely.LineString(stroke) for stroke in mark.strokes])
    graph = _segments(shapely.unary_union(strokes, grid_size=JOINT_MM))
    groups = sorted(sorted(group) for group in nx.connected_components(graph))
    return [_run(_round_walk(graph, group[0]), lock_length_mm) for group in groups]


def _segments(noded: shapely.Geometry) -> nx.Graph[Point]:
    """Give the straight segments between corners and joints of strokes."""
    graph: nx.Graph[Point] = nx.Graph()
    for part in shapely.get_parts(noded):
        corners = [(float(x), float(y)) for x, y in shapely.get_coordinates(part)]
        graph.add_edges_from(pairwise(corners))
    return graph


def _round_walk(graph: nx.Graph[Point], start: Point) -> list[Point]:
    """Walk along every segment in both directions and come back to the start."""
    both_ways: nx.DiGraph[Point] = graph.subgraph(
        nx.node_connected_component(graph, start)
    ).to_directed()
    return [start, *(end for _, end in nx.eulerian_circuit(both_ways, source=start))]


def _run(walk: list[Point], lock_length_mm: float) -> Vectors:
    """Sew along a walk in equal stitches from corner to corner."""
    corners = np.array(walk)
    length = np.hypot(*np.diff(corners, axis=0).T)
    at_corner = np.concatenate([[0.0], np.cumsum(length)])
    count = np.maximum(np.ceil(length / MARK_STITCH_MM), 1).astype(int)
    within = [
        np.linspace(a, b, n + 1)[1:] for (a, b), n in zip(pairwise(at_corner), count, strict=True)
    ]
    stations = with_locks(np.concatenate([[0.0], *within]), lock_length_mm)
    return np.stack([np.interp(stations, at_corner, axis) for axis in corners.T], axis=1)
