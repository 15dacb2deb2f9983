"""Newton's method for a loop that is held: by plates that only push, or at prescribed places.

At the minimum the energy's slope is met by forces, g + Σ λ c = 0, with λ ≥ 0 where plates push and
λ = 0 where nothing touches. Each step solves the quadratic programme of the Lagrangian's Hessian
H + Σ λ s sᵀ/k and the linear models of what may touch, by an active set: points that would pass a
plate are added to it, points that would be pulled are taken out. Nothing is softened, so that what
is left at the end is rounding. The wire's tension is an unknown of its own (`stiff_newton`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dgesv, dpotrf

from solver.free_motions import drift
from solver.loop_energy import LoopEnergy
from solver.newton import Minimum
from solver.plates import Contact
from solver.touching import Touches

Vectors = NDArray[np.float64]
Finder = Callable[[Vectors], Touches]

_MOST_STEPS = 30
_MOST_CHANGES = 60
_LONGEST_STEP = 0.3
_SHORTEST_STEP = 1e-9
_SMALL_GRADIENT = 1e-8
_ROUNDING = 1e-10


@dataclass(frozen=True, eq=False)
class HeldMinimum:
    """A minimum under contact.

    ``force`` (k,) are the λ of ``touches``: of mirror images, together. The minimum's gradient and
    Hessian are the Lagrangian's.
    """

    minimum: Minimum
    tension: Vectors
    touches: Touches
    force: Vectors


def _bordered(hessian: Vectors, slope: Vectors, touches: Touches) -> Vectors | None:
    """Step and forces (n + a,) of a quadratic model with a linear equalities."""
    n, a = len(slope), len(touches.excess)
    matrix = np.zeros((n + a, n + a))
    matrix[:n, :n] = hessian
    matrix[n:, :n] = touches.rows
    matrix[:n, n:] = touches.rows.T
    _, solution, info = dgesv(matrix, -np.concatenate([slope, touches.excess]))[1:]
    return solution if info == 0 and np.isfinite(solution).all() else None


def pushed_step(
    hessian: Vectors, slope: Vectors, touches: Touches, active: NDArray[np.bool_]
) -> tuple[Vectors, Vectors] | None:
    """Step (n,) and forces (k,) ≥ 0 at the minimum of a quadratic model among linear inequalities.

    ``active`` (k,) is a guess of which of them are met as equalities. None when the guess leads
    nowhere.
    """
    n, active = len(slope), active.copy()
    for _ in range(_MOST_CHANGES):
        found = _bordered(hessian, slope, touches.chosen(active))
        if found is None:
            return None
        force = np.zeros(len(active))
        force[active] = found[n:]
        if force.min(initial=0.0) < 0:
            active[int(np.argmin(force))] = False
            continue
        beyond = np.where(active, -1.0, touches.excess + touches.rows @ found[:n])
        if beyond.max(initial=-1.0) <= _ROUNDING:
            return found[:n], force
        active[int(np.argmax(beyond))] = True
    return None


def _step(
    hessian: Vectors, slope: Vectors, touches: Touches, force: Vectors, *, unilateral: bool
) -> tuple[Vectors, Vectors] | None:
    if unilateral:
        return pushed_step(hessian, slope, touches, (force > 0) | (touches.excess > 0))
    found = _bordered(hessian, slope, touches)
    return None if found is None else (found[: len(slope)], found[len(slope) :])


def convex_along(hessian: Vectors, rows: Vectors) -> bool:
    """Whether a Hessian (n, n) is positive definite along motions that rows (a, n) allow.

    The others are given more than the stiffness of the stiffest (Debreu, Econometrica 20 (1952)
    295: a form is positive where R p = 0 if, and only if, H + σ Rᵀ R is for some large σ).
    """
    stiffest = float(np.abs(np.diagonal(hessian)).sum())
    return dpotrf(hessian + stiffest * (rows.T @ rows))[1] == 0


def held_minimum(
    energy: LoopEnergy,
    start: Vectors,
    find: Finder,
    *,
    tension: Vectors,
    before: Sequence[Contact] = (),
    unilateral: bool = True,
    roughly: float = 0.0,
) -> HeldMinimum | None:
    """Find the minimum near ``start`` (n,), or None when the steps lead elsewhere.

    Parameters
    ----------
    find : callable
        What touches, or is held, at a shape.
    tension : array (Q,)
        A first guess of the wire's.
    before : sequence of Contact
        Those of a neighbouring solution.
    unilateral : bool
        Whether the forces only push.
    roughly : float
        Length of the last step if that is near enough; 0 for as near as rounding allows.
    """
    q, stretched, hold = start, tension, drift(energy.basis)
    touches = find(q)
    force = touches.forces_of(before)
    enough = max(_SMALL_GRADIENT, 1e-11 * _stiffness(energy))
    for steps in range(_MOST_STEPS):
        value, slope, hessian = energy.derivatives(q, stretched)
        hessian += hold + touches.curvature(force)
        found = _step(hessian, slope, touches, force, unilateral=unilateral)
        if found is None:
            return None
        p, pushes = found
        length = float(np.linalg.norm(p))
        norm = float(np.linalg.norm(slope + pushes @ touches.rows))
        settled = length <= _SHORTEST_STEP and norm <= enough
        if settled or length <= roughly:
            pressed = pushes > 0 if unilateral else np.ones(len(pushes), dtype=bool)
            convex = convex_along(hessian, touches.rows[pressed])
            near = q if settled else q + p
            minimum = Minimum(near, value, norm, hessian, steps, steps + 1, settled)
            found = HeldMinimum(minimum, stretched, touches.chosen(pressed), pushes[pressed])
            return found if convex else None
        if not np.isfinite(length):
            return None
        p = p * min(1.0, _LONGEST_STEP / length)
        tangent, change = (energy.basis.along_edge(v)[..., :3] for v in (q, p))
        stretched = energy.rod.force_ahead(tangent, change, energy.speed)
        q, known = q + p, touches.contacts(pushes)
        touches = find(q)
        force = touches.forces_of(known) if unilateral else pushes
    return None


def _stiffness(energy: LoopEnergy) -> float:
    return float(max(np.max(energy.rod.beta), np.max(energy.rod.axial_stiffness)))
