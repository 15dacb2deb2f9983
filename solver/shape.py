"""The smooth shape of a solved loop."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solver.disc_basis import position_map
from solver.disc_functions import DiscFunction
from solver.symmetry import Unknown

Vectors = NDArray[np.float64]
Expansion = dict[tuple[int, DiscFunction], float]
"""Coefficient of each disc function in each component of the position."""


@dataclass(frozen=True)
class LoopShape:
    """Position of every point of the disc, lengths in units of the loop radius.

    The disc's crests lie on the x axis and its valleys on the y axis; z = 0 is half-way between.

    Attributes
    ----------
    unknowns : tuple of Unknown
    coefficients : array (n,)
    """

    unknowns: tuple[Unknown, ...]
    coefficients: Vectors

    def position(self, radius: ArrayLike, angle_rad: ArrayLike) -> Vectors:
        """Positions (n, 3) of the points that lay at polar coordinates of the flat disc."""
        r, theta = np.broadcast_arrays(np.asarray(radius, float), np.asarray(angle_rad, float))
        return position_map(self.unknowns, r.ravel(), theta.ravel()) @ self.coefficients

    def edge(self, count: int) -> Vectors:
        """Positions (count, 3) of equally spaced points of the wire, from the crest on +x."""
        return self.position(1.0, np.arange(count) * (2 * np.pi / count))

    @cached_property
    def expansion(self) -> Expansion:
        """Coefficients by component and disc function."""
        out: Expansion = {}
        for unknown, coefficient in zip(self.unknowns, self.coefficients, strict=True):
            for term in unknown:
                key = (term.component, term.function)
                out[key] = out.get(key, 0.0) + term.weight * float(coefficient)
        return out

    @cached_property
    def height(self) -> float:
        """Rise of the wire from valley to crest, along the saddle's own axis."""
        crest, valley = self.position(1.0, [0.0, np.pi / 2])[:, 2]
        return float(crest - valley)

    @cached_property
    def width(self) -> float:
        """Distance of opposite crests: the pitch at which equal loops stand side by side."""
        return float(2 * self.position(1.0, 0.0)[0, 0])

    @property
    def height_over_perimeter(self) -> float:
        """Height over the wire's length, h/(2π R)."""
        return self.height / (2 * np.pi)


def from_expansion(unknowns: tuple[Unknown, ...], expansion: Expansion) -> Vectors:
    """Coefficients (n,) that come nearest to an expansion; exact when it lies in the space.

    The unknowns must be orthonormal in the mean square over the disc.
    """
    return np.array(
        [
            sum(
                term.weight * expansion.get((term.component, term.function), 0.0)
                for term in unknown
            )
            for unknown in unknowns
        ]
    )
