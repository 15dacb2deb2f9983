"""Minimisation with second derivatives in a trust region, for tens to hundreds of unknowns.

Each step minimises the quadratic model exactly within a ball, with the eigenvalues of the Hessian
at hand, so that it leaves saddle points along their negative directions (Moré and Sorensen, 1983).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.float64]
Derivatives = Callable[[Vectors], tuple[float, Vectors, Vectors]]
"""Value, gradient (n,) and Hessian (n, n) at unknowns (n,)."""

_SMALLEST_RADIUS = 1e-14


@dataclass(frozen=True)
class Minimum:
    """Where a minimisation ended.

    Attributes
    ----------
    unknowns : array (n,)
    value, gradient_norm : float
    lowest_eigenvalue : float
        Of the Hessian there.
    steps, factorizations : int
        Steps tried, and Hessians factorised.
    converged : bool
        Whether the gradient is small and the Hessian has no negative eigenvalue.
    """

    unknowns: Vectors
    value: float
    gradient_norm: float
    lowest_eigenvalue: float
    steps: int
    factorizations: int
    converged: bool


def trust_step(eigenvalues: Vectors, slope: Vectors, radius: float) -> Vectors:
    """Minimise slope·p + ½ Σ λ p² in the ball |p| ≤ radius, in the Hessian's eigenbasis.

    Solves the secular equation |p(μ)| = radius with p = −slope/(λ + μ) by safeguarded Newton
    iteration; the hard case (no slope along the lowest direction) is met by moving along it.
    """
    lowest = eigenvalues[0]
    tiny = 1e-14 * max(1.0, float(np.max(np.abs(eigenvalues))))
    if lowest > tiny:
        free = -slope / eigenvalues
        if np.linalg.norm(free) <= radius:
            return free
    low = max(0.0, -lowest)
    high = low + float(np.linalg.norm(slope)) / radius
    mu = low + 1e-3 * (high - low)
    for _ in range(60):
        shifted = np.maximum(eigenvalues + mu, tiny)
        step = -slope / shifted
        length = float(np.linalg.norm(step))
        if abs(length - radius) < 1e-3 * radius:
            return step
        if length > radius:
            low = mu
        else:
            high = mu
        newton = mu + (length / radius - 1) * length**2 / max(
            float(np.sum(step * step / shifted)), 1e-300
        )
        mu = newton if low < newton < high else (low + high) / 2
        if high - low <= tiny:
            break
    step = -slope / np.maximum(eigenvalues + high, tiny)
    missing = radius**2 - float(step @ step)
    if lowest < 0 and missing > 0:
        step[0] += np.copysign(np.sqrt(missing), step[0] if step[0] != 0 else 1.0)
    return step


def minimise(
    derivatives: Derivatives,
    start: Vectors,
    *,
    tolerance: float,
    radius: float,
    most_steps: int = 200,
) -> Minimum:
    """Go downhill from ``start`` to a minimum.

    Parameters
    ----------
    tolerance : float
        Largest gradient norm at the minimum.
    radius : float
        Length of the first step at most.
    """
    q = start
    value, slope, hessian = derivatives(q)
    factorizations = 0
    steps = 0
    while True:
        eigenvalues, modes = np.linalg.eigh(hessian)
        factorizations += 1
        norm = float(np.linalg.norm(slope))
        floor = -1e-9 * max(1.0, float(eigenvalues[-1]))
        settled = norm <= tolerance and eigenvalues[0] >= floor
        if settled or steps >= most_steps or radius < _SMALLEST_RADIUS:
            return Minimum(q, value, norm, float(eigenvalues[0]), steps, factorizations, settled)
        in_modes = modes.T @ slope
        while True:
            steps += 1
            p = trust_step(eigenvalues, in_modes, radius)
            predicted = float(in_modes @ p + p @ (eigenvalues * p) / 2)
            trial = q + modes @ p
            found = derivatives(trial)
            # below rounding of the value, the gradient decides
            noise = 1e-14 * max(1.0, abs(value))
            smaller = float(np.linalg.norm(found[1])) < norm
            ratio = (found[0] - value) / predicted if predicted < 0 else 0.0
            accepted = ratio > 0.1 or (abs(predicted) < 10 * noise and smaller)
            length = float(np.linalg.norm(p))
            if ratio < 0.25 and not (accepted and abs(predicted) < 10 * noise):
                radius = 0.25 * length
            elif ratio > 0.75:
                radius = max(radius, 2.5 * length)
            if accepted:
                q = trial
                value, slope, hessian = found
                break
            if steps >= most_steps or radius < _SMALLEST_RADIUS:
                break
