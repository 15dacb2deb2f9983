"""Motions that cost no energy, and the lowest eigenvalue without them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.mesh.factorization import Factored
from solver.mesh.krylov import Product
from solver.mesh.triangulation import Mesh

Vectors = NDArray[np.float64]

_BLOCK = 3
_MOST_ITERATIONS = 30
_TOLERANCE = 1e-3
_NO_MOTION = 1e-9
_FOR_THE_MOST_PART = 0.5


def rigid_motions(positions: Vectors, mass: Vectors) -> Vectors:
    """Translations and turns of a shape, (3n, 6), orthonormal in the mean square by mass (n,).

    They are five where all vertices lie on a line.
    """
    arms = positions - mass @ positions / mass.sum()
    axes = np.eye(3)
    shifts: list[Vectors] = [np.tile(axis, len(arms)) for axis in axes]
    turns: list[Vectors] = [np.asarray(np.cross(axis, arms), np.float64).ravel() for axis in axes]
    columns = np.stack(shifts + turns, axis=1)
    root = np.sqrt(np.repeat(mass, 3))[:, None]
    modes, sizes, _ = np.linalg.svd(root * columns, full_matrices=False)
    return modes[:, sizes > _NO_MOTION * sizes[0]] / root


def _orthonormal(columns: Vectors, weights: Vectors) -> Vectors:
    root = np.sqrt(weights)[:, None]
    return np.linalg.qr(root * columns)[0] / root


def turn_of_fabric(mesh: Mesh, positions: Vectors) -> Vectors:
    """Velocity (3n,) of the vertices (n, 3) when the fabric turns in the plane it lay in.

    That is (X ∂/∂Y − Y ∂/∂X) x, with the mean gradient of the triangles about each vertex.
    """
    corners = mesh.points[mesh.triangles]
    sides, moved = (v[:, 1:] - v[:, :1] for v in (corners, positions[mesh.triangles]))
    gradient = np.linalg.inv(sides) @ moved  # (m, 2, 3): of x by X and by Y
    total, area = np.zeros((len(positions), 2, 3)), np.zeros(len(positions))
    for corner in mesh.triangles.T:
        np.add.at(total, corner, gradient * mesh.areas[:, None, None])
        np.add.at(area, corner, mesh.areas)
    x, y = mesh.points.T / area
    return (x[:, None] * total[:, 1] - y[:, None] * total[:, 0]).ravel()


def _is_along(motion: Vectors, other: Vectors, weights: Vectors) -> bool:
    """Whether a motion of length 1 is for the most part another, in the mean square."""
    length = float(other @ (weights * other))
    return float(motion @ (weights * other)) ** 2 > _FOR_THE_MOST_PART * length > 0


def lowest_eigenvalue(
    hessian: Product,
    factored: Factored,
    positions: Vectors,
    mass: Vectors,
    free: Vectors | None = None,
) -> float:
    """Lowest λ of H v = λ M v with the rigid motions taken out, by inverse iteration on a block.

    It is the energy's curvature, in units of E_f t, along a displacement with a mean square of 1
    over the area of one loop.

    Parameters
    ----------
    hessian : callable
        Product with H.
    factored : Factored
        Of H, or of H with a little stiffness lent to every motion.
    positions : array (n, 3)
    mass : array (n,)
    free : array (3n,), optional
        One more motion that costs nothing: where the softest motion is for the most part that, λ
        is the next one's.
    """
    weights = np.repeat(mass, 3)
    rigid = rigid_motions(positions, mass)
    if free is not None:
        free = free - rigid @ (rigid.T @ (weights * free))
    block = np.random.default_rng(0).normal(size=(len(weights), _BLOCK))
    value = np.inf
    for _ in range(_MOST_ITERATIONS):
        block -= rigid @ (rigid.T @ (weights[:, None] * block))
        block = _orthonormal(block, weights)
        image = np.stack([hessian(column) for column in block.T], axis=1)
        values, modes = np.linalg.eigh(block.T @ image)
        softest_is_free = free is not None and _is_along(block @ modes[:, 0], free, weights)
        previous, value = value, float(values[int(softest_is_free)])
        if abs(value - previous) <= _TOLERANCE * abs(values[-1]):
            break
        block = factored.solve(np.ascontiguousarray(weights[:, None] * (block @ modes)))
    return value
