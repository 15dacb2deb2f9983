"""A space of disc shapes tabulated at the points where energies are integrated.

Membrane energies are integrated exactly: on a polynomial shape the density is a polynomial, for
which Gauss points in r² and equally spaced angles leave no error.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from solver.symmetry import Parity, Unknown, mirror_class, saddle

Vectors = NDArray[np.float64]
Space = Literal["saddle"] | tuple[Parity, Parity]


@dataclass(frozen=True)
class DiscBasis:
    """Linear maps from n unknowns to derivatives of the position.

    Attributes
    ----------
    unknowns : tuple of Unknown
        What each coefficient moves.
    gradient : array (P, 3, 2, n)
        Derivatives of the position along x and y at P points of the disc.
    area : array (P,)
        Weights of these points; they add up to π.
    tangent, second : array (Q, 3, n)
        First and second derivative of the position along the edge at Q points.
    arc : array (Q,)
        Weights of these points; they add up to 2π.
    """

    unknowns: tuple[Unknown, ...]
    gradient: Vectors
    area: Vectors
    tangent: Vectors
    second: Vectors
    arc: Vectors

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return len(self.unknowns)


def position_map(unknowns: tuple[Unknown, ...], r: Vectors, theta: Vectors) -> Vectors:
    """Linear map (n_points, 3, n) from unknowns to positions at polar coordinates."""
    out = np.zeros((len(r), 3, len(unknowns)))
    for i, unknown in enumerate(unknowns):
        for term in unknown:
            out[:, term.component, i] += term.weight * term.function.value(r, theta)
    return out


def _edge_map(unknowns: tuple[Unknown, ...], theta: Vectors, derivative: int) -> Vectors:
    """Linear map (n_points, 3, n) from unknowns to a derivative along the edge."""
    out = np.zeros((len(theta), 3, len(unknowns)))
    one = np.ones(1)
    for i, unknown in enumerate(unknowns):
        for term in unknown:
            radial = term.function.radial(one)[0]
            out[:, term.component, i] += (
                term.weight * radial * term.function.angular(theta, derivative)
            )
    return out


def _gradient_map(unknowns: tuple[Unknown, ...], r: Vectors, theta: Vectors) -> Vectors:
    """Linear map (n_points, 3, 2, n) from unknowns to derivatives along x and y."""
    out = np.zeros((len(r), 3, 2, len(unknowns)))
    for i, unknown in enumerate(unknowns):
        for term in unknown:
            along_x, along_y = term.function.gradient(r, theta)
            out[:, term.component, 0, i] += term.weight * along_x
            out[:, term.component, 1, i] += term.weight * along_y
    return out


def _sector_angles(count: int, sectors: int) -> Vectors:
    """Angles in the first of ``sectors`` equal sectors, of at least ``count`` round the disc.

    They sit in the middle of their steps, so that the mirrors at the sector's edges repeat them.
    """
    inside = math.ceil(count / sectors)
    return np.linspace(0.5, inside - 0.5, inside) * (2 * np.pi / (inside * sectors))


@lru_cache(maxsize=64)
def disc_basis(degree: int, space: Space) -> DiscBasis:
    """Tabulate a space of shapes; ``degree`` (odd) bounds its polynomials.

    ``space`` is ``"saddle"``, or the mirror class (odd_in_x, odd_in_y). A saddle's energy is
    integrated over an eighth of the disc, that of mirror classes over a quarter.
    """
    if space == "saddle":
        unknowns, sectors = saddle(degree), 8
    else:
        unknowns, sectors = mirror_class(degree, *space), 4
    # gradients have degree up to `degree`, the density four times that
    theta = _sector_angles(4 * degree + 1, sectors)
    nodes, weights = np.polynomial.legendre.leggauss(degree + 1)
    radius = np.sqrt((nodes + 1) / 2)
    r, angle = np.meshgrid(radius, theta, indexing="ij")
    area = np.repeat(weights / 2 * np.pi / len(theta), len(theta))
    edge = _sector_angles(6 * (degree + 1), sectors)
    return DiscBasis(
        unknowns=unknowns,
        gradient=_gradient_map(unknowns, r.ravel(), angle.ravel()),
        area=area,
        tangent=_edge_map(unknowns, edge, 1),
        second=_edge_map(unknowns, edge, 2),
        arc=np.full(len(edge), 2 * np.pi / len(edge)),
    )
