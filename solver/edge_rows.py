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

    def at(self, theta: Vectors) -> tuple[Vectors, Vectors, Vectors]:
        """Rows (k, n) of the coordinate at angles (k,), and of its first and second derivative."""
        m = np.arange(len(self.cosines), dtype=float)
        phase = np.multiply.outer(theta, m)
        c, s = np.cos(phase), np.sin(phase)
        value = c @ self.cosines + s @ self.sines
        slope = (m * c) @ self.sines - (m * s) @ self.cosines
        bend = (m * m * c) @ self.cosines + (m * m * s) @ self.sines
        return value, slope, -bend

    def of(self, q: Vectors) -> EdgeRows:
        """Give the coordinate of one shape q (n,) as rows of a single unknown."""
        return EdgeRows((self.cosines @ q)[:, None], (self.sines @ q)[:, None])


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
