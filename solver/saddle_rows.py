"""Height and width of a saddle as linear functions of its unknowns."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from solver.disc_basis import DiscBasis
from solver.shape import LoopShape

Vectors = NDArray[np.float64]


@lru_cache(maxsize=32)
def _edge_ends(basis: DiscBasis) -> Vectors:
    """Positions (2, 3, n) by a saddle's unknowns of the crest on +x and of the valley on +y."""
    shapes = (LoopShape(basis.unknowns, unit) for unit in np.eye(basis.size))
    ends = [shape.curve.position(np.array([0.0, np.pi / 2])) for shape in shapes]
    return np.stack(ends, axis=-1)


def crest_less_valley(basis: DiscBasis) -> Vectors:
    """Height (n,) of a saddle by its unknowns, from the crest on +x to the valley on +y."""
    crest, valley = _edge_ends(basis)[:, 2]
    return crest - valley


def crest_distance(basis: DiscBasis) -> Vectors:
    """Distance (n,) of a saddle's crest on +x from its axis, by its unknowns."""
    return _edge_ends(basis)[0, 0]
