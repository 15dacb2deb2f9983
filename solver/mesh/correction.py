"""Steps along curved valleys: what a straight step stretches is taken back.

A straight step that turns a wire's edges by an angle lengthens them by its square. That is little,
but the wire is stiff: the energy rises where the quadratic model says it falls, and steps shrink to
what the curvature of the valley allows. The second-order correction known from constrained
minimisation (Nocedal and Wright, Numerical Optimization, 2nd ed., section 15.6, on the Maratos
effect) brings the stretch back to what is linear in the step: by the factorised matrix at hand, and
along the slopes where the step began, so that soft motions are left alone.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.mesh.krylov import QuadraticModel
from solver.mesh.mesh_energy import Energy

Vectors = NDArray[np.float64]

_MOST_CORRECTIONS = 3
_CONTRACTION = 0.5
"""A correction that is not so much smaller than the one before leads nowhere."""
_LARGEST = 0.5
"""Correction of any vertex, in units of R."""
_GOOD_PART = 0.7
"""Part of the promised fall in energy that needs no further correction."""


@dataclass(frozen=True)
class Move:
    """Displacement (n, 3) of all vertices, and the energy where it leads."""

    displacement: Vectors
    value: float


def corrected(
    energy: Energy, model: QuadraticModel, positions: Vectors, move: Move, wanted: float
) -> Move:
    """Bend a move until the energy is down to what was wanted, or no correction helps.

    Parameters
    ----------
    model : QuadraticModel
        At ``positions``.
    wanted : float
        Energy that the model promises at the end of the move.
    """
    now = energy.value(positions)
    enough = now + _GOOD_PART * (wanted - now)
    best, bent, before = move, move.displacement, math.inf
    for _ in range(_MOST_CORRECTIONS):
        if best.value <= enough:
            break
        pull = energy.excess(positions, move.displacement, positions + bent)
        correction = -model.inverse(pull)
        size = -float(correction @ pull)
        if not size < _CONTRACTION * before or np.abs(correction).max() > _LARGEST:
            break
        before, bent = size, bent + correction.reshape(-1, 3)
        value = energy.value(positions + bent)
        best = Move(bent, value) if not best.value <= value else best
    return best
