"""Minimisation with second derivatives in a trust region, for tens to hundreds of unknowns.

Where the Hessian is positive definite and Newton's step short enough, that step is taken. Elsewhere
a step minimises the quadratic model exactly within a ball, with the eigenvalues of the Hessian at
hand, so that it leaves saddle points along their negative directions (Moré and Sorensen, 1983).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dposv

Vectors = NDArray[np.float64]
Derivatives = Callable[[Vectors], tuple[float, Vectors, Vectors]]
"""Value, gradient (n,) and Hessian (n, n) at unknowns (n,)."""

_SMALLEST_RADIUS = 1e-14
_ROUNDING = 1e-14


@dataclass(frozen=True)
class Minimum:
    """Where a minimisation ended.

    Attributes
    ----------
    unknowns : array (n,)
    value, gradient_norm : float
    hessian : array (n, n)
    steps, factorizations : int
        Steps tried, and Hessians factorised.
    converged : bool
        Whether the gradient is small and the Hessian has no negative eigenvalue.
    """

    unknowns: Vectors
    value: float
    gradient_norm: float
    hessian: Vectors
    steps: int
    factorizations: int
    converged: bool

    @property
    def lowest_eigenvalue(self) -> float:
        """Of the Hessian."""
        return float(np.linalg.eigvalsh(self.hessian)[0])

    def after(self, earlier: Minimum) -> Minimum:
        """Give the same with the steps of an earlier stage added."""
        return replace(
            self,
            steps=self.steps + earlier.steps,
            factorizations=self.factorizations + earlier.factorizations,
        )


def trust_step(eigenvalues: Vectors, slope: Vectors, radius: float) -> Vectors:
    """Minimise slope·p + ½ Σ λ p² in the ball |p| ≤ radius, in the Hessian's eigenbasis.

    Solves the secular equation |p(μ)| = radius with p = −slope/(λ + μ) by safeguarded Newton
    iteration; the hard case (no slope along the lowest direction) is met by moving along it.
    """
    lowest = eigenvalues[0]
    tiny = _ROUNDING * max(1.0, float(np.max(np.abs(eigenvalues))))
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
    missing = radius**2 - float(step[1:] @ step[1:])
    if float(step @ step) > radius**2:
        return step * (radius / float(np.linalg.norm(step)))
    if lowest < 0:
        step[0] = np.copysign(np.sqrt(missing), step[0] if step[0] != 0 else 1.0)
    return step


@dataclass(frozen=True)
class _Model:
    """The quadratic model around a point, factorised."""

    slope: Vectors
    hessian: Vectors
    newton: Vectors | None
    modes: tuple[Vectors, Vectors] | None

    def step(self, radius: float) -> tuple[Vectors, float]:
        """Give the best step in a ball, and the change of value that the model foretells."""
        if self.newton is not None and np.linalg.norm(self.newton) <= radius:
            return self.newton, float(self.slope @ self.newton) / 2
        eigenvalues, modes = self.modes or np.linalg.eigh(self.hessian)
        in_modes = modes.T @ self.slope
        p = trust_step(eigenvalues, in_modes, radius)
        return modes @ p, float(in_modes @ p + p @ (eigenvalues * p) / 2)


def _model(slope: Vectors, hessian: Vectors) -> tuple[_Model, bool]:
    """Factorise, and say whether the Hessian has no negative eigenvalue but for rounding."""
    _, newton, info = dposv(hessian, -slope)
    if info == 0:
        return _Model(slope, hessian, newton, None), True
    eigenvalues, modes = np.linalg.eigh(hessian)
    floor = -1e-9 * max(1.0, float(eigenvalues[-1]))
    return _Model(slope, hessian, None, (eigenvalues, modes)), bool(eigenvalues[0] >= floor)


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
    factorizations = steps = 0
    while True:
        model, convex = _model(slope, hessian)
        factorizations += 1
        norm = float(np.linalg.norm(slope))
        settled = norm <= tolerance and convex
        if settled or steps >= most_steps or radius < _SMALLEST_RADIUS:
            return Minimum(q, value, norm, hessian, steps, factorizations, settled)
        accepted = False
        while not accepted and steps < most_steps and radius >= _SMALLEST_RADIUS:
            steps += 1
            p, predicted = model.step(radius)
            found = derivatives(q + p)
            ratio = (found[0] - value) / predicted if predicted < 0 else 0.0
            # below rounding of the value, the gradient decides
            drowned = abs(predicted) < 10 * _ROUNDING * max(1.0, abs(value))
            smaller = bool(np.linalg.norm(found[1]) < norm)
            accepted = ratio > 0.1 or (drowned and smaller)
            if not ratio >= 0.25 and not (accepted and drowned):
                radius = 0.25 * float(np.linalg.norm(p))
            elif ratio > 0.75:
                radius = max(radius, 2.5 * float(np.linalg.norm(p)))
            if accepted:
                q = q + p
                value, slope, hessian = found
