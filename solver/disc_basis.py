"""A space of disc shapes tabulated at the points where energies are integrated.

Membrane energies are integrated exactly: on a polynomial shape the density is a polynomial, for
which Gauss points in r² and equally spaced angles leave no error.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from solver.symmetry import (
    ALIGNED,
    FLAT,
    Mirrors,
    Symmetry,
    Unknown,
    displacements,
    mirror_symmetry,
    oblique,
    saddle,
)

Vectors = NDArray[np.float64]
Space = Literal["saddle", "oblique"] | Mirrors | Symmetry

_MIRRORED: tuple[Space, ...] = ("saddle", (0, 0), ALIGNED, FLAT)


@dataclass(frozen=True, eq=False)
class DiscBasis:
    """Linear maps from n unknowns to derivatives of the position.

    Attributes
    ----------
    degree : int
    space : Space
    unknowns : tuple of Unknown
        What each coefficient moves.
    gradient : array (P, 3, 2, n)
        Derivatives of the position along x and y at P points of the disc.
    area : array (P,)
        Weights of these points; they add up to π.
    edge : array (Q, 6, n)
        First and second derivative of the position along the edge at Q points.
    angle : array (Q,)
        Where on the edge these points lie.
    arc : array (Q,)
        Weights of these points; they add up to 2π.
    """

    degree: int
    space: Space
    unknowns: tuple[Unknown, ...]
    gradient: Vectors
    area: Vectors
    edge: Vectors
    angle: Vectors
    arc: Vectors

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return len(self.unknowns)

    @property
    def mirrored(self) -> bool:
        """Whether every shape has a mirror plane, and so no writhe."""
        return self.space in _MIRRORED

    @property
    def tangent(self) -> Vectors:
        """First derivative of the position along the edge, (Q, 3, n)."""
        return self.edge[:, :3]

    @property
    def second(self) -> Vectors:
        """Second derivative of the position along the edge, (Q, 3, n)."""
        return self.edge[:, 3:]

    def along_edge(self, q: Vectors) -> Vectors:
        """First and second derivative (…, Q, 6) along the edge of shapes (…, n)."""
        flat = q @ self.edge.reshape(-1, self.size).T
        return flat.reshape(*q.shape[:-1], -1, 6)

    def up_to(self, highest: int) -> DiscBasis:
        """Give the subspace of polynomials up to a degree, at the same points."""
        kept = [
            i
            for i, unknown in enumerate(self.unknowns)
            if all(term.function.degree <= highest for term in unknown)
        ]
        return replace(
            self,
            unknowns=tuple(self.unknowns[i] for i in kept),
            gradient=np.ascontiguousarray(self.gradient[..., kept]),
            edge=np.ascontiguousarray(self.edge[..., kept]),
        )


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
    for i, unknown in enumerate(unknowns):
        for term in unknown:
            out[:, term.component, i] += (
                term.weight * term.function.edge_value * term.function.angular(theta, derivative)
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


def _unknowns_and_sectors(degree: int, space: Space) -> tuple[tuple[Unknown, ...], int]:
    """List a space's unknowns, and the equal sectors of the disc that hold equal energies."""
    if space == "saddle":
        return saddle(degree), 8
    if space == "oblique":
        return oblique(degree), 2
    symmetry = space if isinstance(space, Symmetry) else mirror_symmetry(*space)
    return displacements(degree, symmetry), 4 // len(symmetry.in_plane)


def _disc_points(degree: int, sectors: int) -> tuple[Vectors, Vectors, Vectors]:
    """Radius, angle and weight (P,) of the points at which the fabric's energy is integrated."""
    # gradients have degree up to `degree`, the density four times that
    theta = _sector_angles(4 * degree + 1, sectors)
    nodes, weights = np.polynomial.legendre.leggauss(degree + 1)
    radius = np.sqrt((nodes + 1) / 2)
    r, angle = np.meshgrid(radius, theta, indexing="ij")
    area = np.repeat(weights / 2 * np.pi / len(theta), len(theta))
    return r.ravel(), angle.ravel(), area


@lru_cache(maxsize=128)
def disc_basis(degree: int, space: Space) -> DiscBasis:
    """Tabulate a space of shapes; ``degree`` (odd) bounds its polynomials.

    ``space`` is ``"saddle"``, ``"oblique"``, a mirror class (odd_in_x, odd_in_y) or a symmetry.
    Energies are integrated over the part of the disc that the symmetry repeats: an eighth for a
    saddle, a quarter where two mirrors or half-turns are left, half of it with one half-turn.
    """
    unknowns, sectors = _unknowns_and_sectors(degree, space)
    r, angle, area = _disc_points(degree, sectors)
    edge = _sector_angles(6 * (degree + 1), sectors)
    return DiscBasis(
        degree=degree,
        space=space,
        unknowns=unknowns,
        gradient=_gradient_map(unknowns, r, angle),
        area=area,
        edge=np.concatenate([_edge_map(unknowns, edge, 1), _edge_map(unknowns, edge, 2)], axis=1),
        angle=edge,
        arc=np.full(len(edge), 2 * np.pi / len(edge)),
    )


@lru_cache(maxsize=256)
def tangent_map(source: DiscBasis, points: DiscBasis) -> Vectors:
    """Linear map (Q, 3, n) from a basis' unknowns to x' at the points of another basis' edge."""
    return _edge_map(source.unknowns, points.angle, 1)


@lru_cache(maxsize=64)
def jet_map(basis: DiscBasis) -> Vectors:
    """Linear map (P, 5, 3, n) to derivatives by x, y, xx, xy and yy at the points of a basis."""
    sectors = _unknowns_and_sectors(basis.degree, basis.space)[1]
    r, theta, _ = _disc_points(basis.degree, sectors)
    out = np.zeros((len(r), 5, 3, basis.size))
    out[:, :2] = np.swapaxes(basis.gradient, 1, 2)
    for i, unknown in enumerate(basis.unknowns):
        for term in unknown:
            for k, values in enumerate(term.function.second(r, theta)):
                out[:, 2 + k, term.component, i] += term.weight * values
    return out


@lru_cache(maxsize=256)
def transfer(source: DiscBasis, target: DiscBasis) -> Vectors:
    """Linear map (n_target, n_source) to the nearest shape of another space.

    Exact where the shape lies in the target space; the functions are orthonormal over the disc.
    """
    column = {
        (term.component, term.function): (i, term.weight)
        for i, unknown in enumerate(source.unknowns)
        for term in unknown
    }
    out = np.zeros((target.size, source.size))
    for k, unknown in enumerate(target.unknowns):
        for term in unknown:
            i, weight = column.get((term.component, term.function), (0, 0.0))
            out[k, i] += term.weight * weight
    return out
