"""The conditions of balance of a strip at a prescribed chord, and Newton's method for them.

Units: length L of the strip, energy EI/L, force EI/L², couple EI/L. With the heading θ(s),

    U = ½ ∫ θ'² ds − m ∫_covered θ' ds   subject to   ∫ (1 − cos θ) ds = δ,   ∫ sin θ ds = 0,

and where wanted to linear conditions too. Their multipliers are the compression P = dU/dδ, a force
Q across the chord, and what holds the linear conditions.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh, qr

from solver.errors import NotConvergedError
from solver.strip.basis import StripBasis

Vectors = NDArray[np.float64]

_ROUNDING = 1e-12
"""Relative to the shape."""
_LEAST_MASS = 1e-12
_MOST_ITERATIONS = 12
_LARGEST_GROWTH = 4.0
"""Of the shape in one solve; beyond it Newton's method has left the neighbourhood."""


@dataclass(frozen=True)
class Balance:
    """A strip at a chord.

    Attributes
    ----------
    basis : StripBasis
        n unknowns.
    shortening : float
        δ.
    held : array (r, n)
        Linear conditions, held x = 0, beside those of the chord.
    """

    basis: StripBasis
    shortening: float
    held: Vectors

    def energy(self, x: Vectors, couple: float) -> float:
        """U of unknowns (n,): docs/theory.md, eq. (20), one couple being that of both sleeves."""
        return float(x @ self.basis.stiffness @ x) / 2 - couple * float(self.basis.turn @ x)

    def conditions(self, x: Vectors) -> tuple[Vectors, Vectors]:
        """Values (2 + r,) and derivatives (2 + r, n) of the conditions."""
        basis, theta = self.basis, self.basis.heading @ x
        # 1 − cos θ, so that a strip that is all but straight keeps its digits
        values = [basis.weight @ (2 * np.sin(theta / 2) ** 2) - self.shortening]
        values.append(basis.weight @ np.sin(theta))
        slopes = (basis.weight * np.array([np.sin(theta), np.cos(theta)])) @ basis.heading
        return np.append(values, self.held @ x), np.vstack([slopes, self.held])

    def hessian(self, x: Vectors, force: Vectors) -> Vectors:
        """Second derivatives (n, n) of U − P (∫(1 − cos θ) − δ) − Q ∫ sin θ, force = (P, Q, …)."""
        basis, theta = self.basis, self.basis.heading @ x
        pull = basis.weight * (force[1] * np.sin(theta) - force[0] * np.cos(theta))
        return basis.stiffness + basis.heading.T @ (pull[:, None] * basis.heading)

    def residual(self, point: Point) -> tuple[Vectors, Vectors]:
        """Conditions of balance (n + 2 + r,), and their symmetric derivative by (x, forces)."""
        x, force = point.x, point.force
        values, slopes = self.conditions(x)
        balance = self.basis.stiffness @ x - point.couple * self.basis.turn - slopes.T @ force
        corner = np.zeros((len(values), len(values)))
        matrix = np.block([[self.hessian(x, force), -slopes.T], [-slopes, corner]])
        return np.concatenate([balance, -values]), matrix

    @property
    def couple_slope(self) -> Vectors:
        """Derivative of the residual by the couple (n + 2 + r,)."""
        return np.concatenate([-self.basis.turn, np.zeros(2 + len(self.held))])

    def gradient_norm(self, point: Point) -> float:
        """Largest component of the residual, in units of EI/L."""
        return float(np.abs(self.residual(point)[0]).max())

    def weakest(self, point: Point) -> tuple[float, Vectors]:
        """Lowest eigenvalue of U's second variation among shapes that keep the conditions.

        Per unit of ∫ δθ² ds, with its motion (n,); greater than 0 at a minimum.
        """
        slopes = self.conditions(point.x)[1]
        free = qr(slopes.T)[0][:, len(slopes) :]
        hessian = free.T @ self.hessian(point.x, point.force) @ free
        # a piece next to nothing long has next to no mass
        mass = free.T @ self.basis.mass @ free + _LEAST_MASS * np.eye(free.shape[1])
        values, motions = eigh(hessian, mass, subset_by_index=[0, 0])
        return float(values[0]), free @ motions[:, 0]

    def lowest_eigenvalue(self, point: Point) -> float:
        """Lowest eigenvalue alone."""
        return self.weakest(point)[0]


@dataclass(frozen=True)
class Point:
    """A shape x (n,), the forces (P, Q, …) and the couple, in balance or on the way to it."""

    x: Vectors
    force: Vectors
    couple: float
    iterations: int = 0

    @property
    def vector(self) -> Vectors:
        """Shape, forces and couple in one."""
        return np.concatenate([self.x, self.force, [self.couple]])

    def moved(self, move: Vectors) -> Point:
        """Move all three."""
        n, last = len(self.x), len(move) - 1
        return Point(
            self.x + move[:n],
            self.force + move[n:last],
            self.couple + float(move[last]),
            self.iterations + 1,
        )


def newton(balance: Balance, start: Point, border: Vectors, target: float) -> Point:
    """Solve for balance and border · (x, forces, couple) = target.

    A border of zeros but for the couple prescribes the couple.

    Raises
    ------
    NotConvergedError
        When Newton's method leaves the neighbourhood of ``start`` or does not settle.
    """
    point, size = start, float(np.linalg.norm(start.x))
    for _ in range(_MOST_ITERATIONS):
        values, matrix = balance.residual(point)
        missing = np.append(values, border @ point.vector - target)
        if _next_to_nothing(balance, missing, size):
            return point
        point = point.moved(_newton_step(balance, matrix, border, missing))
        step = float(np.linalg.norm(point.x - start.x))
        if not step <= _LARGEST_GROWTH * size:
            break
    raise NotConvergedError(
        f"the strip did not come to balance in {_MOST_ITERATIONS} steps at a couple of "
        f"{point.couple:g} EI/L and a shortening of {balance.shortening:g} L"
    )


def _next_to_nothing(balance: Balance, missing: Vectors, size: float) -> bool:
    """Whether what is missing to balance is rounding."""
    n = balance.basis.size
    # the conditions of the chord are of the order of the shape's square
    slack = np.where(np.arange(len(missing)) < n, _ROUNDING * size, _ROUNDING * size**2)
    slack[-1] = _ROUNDING
    return bool(np.all(np.abs(missing) <= slack))


def _newton_step(balance: Balance, matrix: Vectors, border: Vectors, missing: Vectors) -> Vectors:
    try:
        move = np.linalg.solve(bordered(balance, matrix, border), -missing)
    except np.linalg.LinAlgError as singular:
        raise NotConvergedError("the strip's balance does not tell the next step") from singular
    return np.asarray(move, dtype=np.float64)


def bordered(balance: Balance, matrix: Vectors, border: Vectors) -> Vectors:
    """Derivative of the residual by (x, forces, couple), with one more row."""
    return np.block([[matrix, balance.couple_slope[:, None]], [border[None, :]]])


def at_couple(balance: Balance, start: Point, couple: float) -> Point:
    """Solve for balance at a prescribed couple."""
    border = np.zeros(len(start.vector))
    border[-1] = 1
    return newton(balance, start, border, couple)
