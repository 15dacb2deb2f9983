"""Steps of a sparse trust region: conjugate gradients in the metric of a factorised matrix.

Steihaug's method (SIAM J. Numer. Anal. 20 (1983) 626): minimise the quadratic model until it is
solved, or leave the trust region along the way, or along a direction of negative curvature.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array

from solver.mesh.assembly import LowerPattern

Vectors = NDArray[np.float64]
Product = Callable[[Vectors], Vectors]

_MOST_ITERATIONS = 30
_MODEL_TOLERANCE = 1e-2
_MODE_TOLERANCE = 1e-2


def symmetric_product(pattern: LowerPattern, entries: Vectors) -> Product:
    """Product with the symmetric matrix whose lower triangle has these entries."""
    lower = csc_array((entries, pattern.rows, pattern.starts), shape=(pattern.size, pattern.size))
    upper = lower.T
    diagonal = entries[pattern.diagonal]
    return lambda v: lower @ v + upper @ v - diagonal * v


@dataclass(frozen=True)
class QuadraticModel:
    """Energy g·p + ½ p·H p, and the positive definite metric P in which steps are measured.

    Attributes
    ----------
    gradient : array (n,)
    hessian, metric, inverse : callable
        Products with H, with P and with the inverse of P.
    convex : bool
        Whether H is positive definite.
    """

    gradient: Vectors
    hessian: Product
    metric: Product
    inverse: Product
    convex: bool

    def change(self, step: Vectors) -> float:
        """Energy that the model predicts for a step (n,), from 0."""
        return float(self.gradient @ step + step @ self.hessian(step) / 2)

    def length(self, step: Vectors) -> float:
        """Length of a step in the metric."""
        return math.sqrt(max(0.0, float(step @ self.metric(step))))


@dataclass(frozen=True)
class Step:
    """A step (n,), and whether it ends at the trust region's boundary."""

    displacement: Vectors
    bounded: bool


def _factor_to_boundary(square: float, mixed: float, length: float, radius: float) -> float:
    """How far along d a step p of |p|² = ``length`` meets the boundary; |d|², p·P d as given."""
    room = max(0.0, radius**2 - length)
    return (math.sqrt(mixed**2 + square * room) - mixed) / square


def steihaug_step(model: QuadraticModel, radius: float) -> Step:
    """Approximate minimum of the model among steps no longer than ``radius`` in its metric."""
    step = np.zeros_like(model.gradient)
    residual = model.gradient
    scaled = model.inverse(residual)
    along = -scaled
    product = first = float(residual @ scaled)
    # |along|², step·P along and |step|² by recursion (Conn, Gould and Toint 2000, section 7.5.1)
    square, mixed, length = product, 0.0, 0.0
    for _ in range(_MOST_ITERATIONS):
        bent = model.hessian(along)
        curvature = float(along @ bent)
        if curvature <= 0:
            break
        factor = product / curvature
        longer = length + 2 * factor * mixed + factor**2 * square
        if longer > radius**2:
            break
        step = step + factor * along
        residual = residual + factor * bent
        scaled = model.inverse(residual)
        previous, product = product, float(residual @ scaled)
        if product <= _MODEL_TOLERANCE * first:
            return Step(step, bounded=False)
        ratio = product / previous
        along = ratio * along - scaled
        mixed = ratio * (mixed + factor * square)
        square = product + ratio**2 * square
        length = longer
    else:
        return Step(step, bounded=False)
    return Step(step + _factor_to_boundary(square, mixed, length, radius) * along, bounded=True)


def lowest_direction(model: QuadraticModel) -> tuple[float, Vectors]:
    """Lowest λ of H v = λ P v, roughly, and v (n,) with v·P v = 1, pointing downhill.

    Lanczos' method in the metric: all but a few of the eigenvalues are near 1, so that a negative
    one shows soon.
    """
    n = len(model.gradient)
    basis = np.empty((_MOST_ITERATIONS, n))
    images, projected = np.empty_like(basis), np.zeros((_MOST_ITERATIONS, _MOST_ITERATIONS))
    measured = np.empty_like(basis)
    vector = np.random.default_rng(0).normal(size=n)
    lowest, mode = math.inf, vector
    for k in range(_MOST_ITERATIONS):
        for _ in range(2):  # once is not enough against rounding
            vector = vector - (measured[:k] @ vector) @ basis[:k]
        length = model.length(vector)
        if length == 0:
            break
        basis[k] = vector / length
        measured[k], images[k] = model.metric(basis[k]), model.hessian(basis[k])
        projected[k, : k + 1] = projected[: k + 1, k] = basis[: k + 1] @ images[k]
        values, modes = np.linalg.eigh(projected[: k + 1, : k + 1])
        previous, lowest = lowest, float(values[0])
        mode = modes[:, 0] @ basis[: k + 1]
        if lowest < 0 and previous - lowest <= _MODE_TOLERANCE * abs(lowest):
            break
        vector = model.inverse(images[k])
    return lowest, -mode if mode @ model.gradient > 0 else mode


def trust_region_step(model: QuadraticModel, radius: float) -> Step:
    """Step of Steihaug's method, or along the lowest direction where that overlooks it.

    Conjugate gradients do not see negative curvature across the gradient, as at a saddle point.
    """
    step = steihaug_step(model, radius)
    if model.convex or step.bounded:
        return step
    eigenvalue, mode = lowest_direction(model)
    if eigenvalue >= 0:
        return step
    start = step.displacement
    measured = model.metric(mode)
    factor = _factor_to_boundary(
        float(mode @ measured), float(start @ measured), model.length(start) ** 2, radius
    )
    return Step(start + factor * mode, bounded=True)
