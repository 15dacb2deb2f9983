"""Which of many loops meet themselves: wires that come together across the loop, or pass through.

Few do, and only where opposite crests come near each other, which is told for all at once; the few
are then judged one by one, as a loop that is solved alone is.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from solver.checks import NEAR_CRESTS, meets_itself
from solver.disc_basis import DiscBasis, position_map
from solver.round_wire import wire_diameter
from solver.scene import LoopScene
from solver.shape import LoopShape

Vectors = NDArray[np.float64]
Flags = NDArray[np.bool_]

_POINTS = 64
"""Of the wire: enough to tell whether crests are near, among them the crests themselves."""

_MARGIN = 1.2
"""For what lies between these points: loops up to this much farther apart are looked at closely."""


@lru_cache(maxsize=16)
def _edge(basis: DiscBasis) -> Vectors:
    """Positions (N, 3, n) of points of the wire by the unknowns."""
    angle = np.arange(_POINTS, dtype=np.float64) * (2 * np.pi / _POINTS)
    return position_map(basis.unknowns, np.ones(_POINTS), angle)


def nearest_across(basis: DiscBasis, q: Vectors) -> Vectors:
    """Smallest distance (B,) across saddles (B, n) of points at least a quarter turn apart."""
    edge = (q @ _edge(basis).reshape(-1, basis.size).T).reshape(len(q), _POINTS, 3)
    # the saddle repeats a quarter of its wire
    start = np.arange(_POINTS // 4 + 1)
    other = (start[:, None] + np.arange(_POINTS // 4, _POINTS // 2 + 1)) % _POINTS
    apart = edge[:, start, None] - edge[:, other]
    return np.sqrt(np.sum(apart * apart, axis=-1).min(axis=(1, 2)))


def meeting(scenes: Sequence[LoopScene], basis: DiscBasis, q: Vectors, width: Vectors) -> Flags:
    """Tell which saddles (B, n) of a distance of crests ``width`` (B,) meet themselves."""
    found = width <= 0
    largest = max(NEAR_CRESTS, *(wire_diameter(scene) for scene in scenes)) if scenes else 0.0
    for i in np.flatnonzero(~found & (nearest_across(basis, q) < _MARGIN * largest)).tolist():
        found[i] = meets_itself(scenes[i], LoopShape(basis.unknowns, q[i]))
    return found
