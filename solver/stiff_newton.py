"""Newton's method for wires that hardly stretch.

The tension N of a stiff wire is k times a tiny strain, which the unknowns give badly until the very
end. So N is an unknown of its own here, N/k = λ − 1 being one more equation. Newton's step for both
is that of the energy's Hessian with the tension of the step before,

    (H₀ + k λ'ᵀ λ' + N λ'') p = −g,    N ← k (λ − 1 + λ' p),

whose convergence does not depend on k. There is no safeguard: it is for good first guesses, and
says when it fails.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dgesv, dpotrf

from solver.free_motions import drift
from solver.loop_energy import LoopEnergy
from solver.newton import Minimum

Vectors = NDArray[np.float64]

_MOST_STEPS = 14
_LONGEST_STEP = 1.0
_SHORTEST_STEP = 1e-9
_SMALL_GRADIENT = 1e-8


def tension_of(energy: LoopEnergy, q: Vectors) -> Vectors:
    """Tension (…, Q) of the wire of shapes q (…, n) by its stretch."""
    tangent = energy.basis.along_edge(q)[..., :3]
    return energy.rod.force_ahead(tangent, np.zeros_like(tangent), energy.speed)


def stiff_minimum(
    energy: LoopEnergy, start: Vectors, tension: Vectors, *, roughly: float = 0.0
) -> Minimum | None:
    """Find the minimum near ``start`` (n,), or None when the steps lead elsewhere.

    Parameters
    ----------
    tension : array (Q,)
        A first guess of the wire's, in units of E_f t R; 0 if nothing is known.
    roughly : float
        Length of the last step if that is near enough; 0 for as near as rounding allows. Value,
        gradient and Hessian are then those before that step.
    """
    q, force, before = start, tension, math.inf
    level = None if energy.basis.space == "saddle" else drift(energy.basis)
    for steps in range(_MOST_STEPS):
        value, slope, hessian = energy.derivatives(q, force)
        hessian = hessian if level is None else hessian + level
        _, p, info = dgesv(hessian, -slope)[1:]
        length = math.sqrt(p @ p)
        if info != 0 or not length <= _LONGEST_STEP:
            return None
        norm = math.sqrt(slope @ slope)
        if length <= _SHORTEST_STEP and (norm <= _SMALL_GRADIENT or length > before / 4):
            found = Minimum(q, value, norm, hessian, steps, steps + 1, True)
            return found if dpotrf(hessian)[1] == 0 else None
        if length <= roughly:
            found = Minimum(q + p, value, norm, hessian, steps + 1, steps + 1, True)
            return found if dpotrf(hessian)[1] == 0 else None
        tangent = energy.basis.along_edge(q)[..., :3]
        change = energy.basis.along_edge(p)[..., :3]
        force = energy.rod.force_ahead(tangent, change, energy.speed)
        q, before = q + p, length
    return None
