"""One coordinate along the wire, as a linear function of a basis' unknowns at any angle."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from solver.disc_basis import DiscBasis

Vectors = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class EdgeRows:
    """Coordinate Σ (cosines[m]·q) cos mθ + (sines[m]·q) sin mθ of unknowns q.

    Attributes
    ----------
    cosines, sines : array (M, n)
    """

    cosines: Vectors
    sines: Vectors

    def at(self, theta: Vectors, derivative: int = 0) -> Vectors:
        """Rows (k, n) of the coordinate at angles (k,), or of a derivative by the angle."""
        m = np.arange(len(self.cosines), dtype=float)
        phase = np.multiply.outer(theta, m) + derivative * (np.pi / 2)
        power = m**derivative
        return (np.cos(phase) * power) @ self.cosines + (np.sin(phase) * power) @ self.sines


@lru_cache(maxsize=256)
def edge_rows(basis: DiscBasis, component: int) -> EdgeRows:
    """Tabulate component 0, 1 or 2 of the position."""
    waves = 1 + max(term.function.m for unknown in basis.unknowns for term in unknown)
    rows = {"cos": np.zeros((waves, basis.size)), "sin": np.zeros((waves, basis.size))}
    for i, unknown in enumerate(basis.unknowns):
        for term in unknown:
            if term.component == component:
                f = term.function
                rows[f.trig][f.m, i] += term.weight * f.edge_value
    return EdgeRows(rows["cos"], rows["sin"])
