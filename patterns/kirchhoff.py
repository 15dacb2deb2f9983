"""Resistance between two nodes of a net."""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any

import networkx as nx
import numpy as np

MOST_NODES = 4000
"""Larger nets are not solved: the system is dense."""


def effective_resistance_ohm(
    graph: nx.MultiGraph[Any], start: Hashable, end: Hashable
) -> float | None:
    """Solve Kirchhoff's laws: the potential difference that drives 1 A from one node to another.

    With the Laplacian L of the conductances, ``L v = i``, and the end grounded.

    Parameters
    ----------
    graph
        Each edge with its resistance in ohm, more than 0, as the attribute ``ohm``.

    Returns
    -------
    float or None
        Infinite when the nodes are not connected; none when the net is larger than `MOST_NODES`.
    """
    if start == end:
        return 0.0
    if not nx.has_path(graph, start, end):
        return float("inf")
    nodes = list(nx.node_connected_component(graph, start))
    if len(nodes) > MOST_NODES:
        return None
    place = {node: k for k, node in enumerate(nodes)}
    laplacian = np.zeros((len(nodes), len(nodes)))
    for a, b, ohm in graph.subgraph(nodes).edges(data="ohm"):
        i, j = place[a], place[b]
        if i != j:
            laplacian[[i, j], [i, j]] += 1 / ohm
            laplacian[[i, j], [j, i]] -= 1 / ohm
    current = np.zeros(len(nodes))
    current[place[start]] = 1.0
    kept = np.array([k for k in range(len(nodes)) if k != place[end]])
    potential = np.linalg.solve(laplacian[np.ix_(kept, kept)], current[kept])
    return float(potential[np.searchsorted(kept, place[start])])
