"""How the force of a loop that is held at a pitch changes with what it is made of.

The loop minimises its energy with its crests held at the distance g: its gradient is −F c, with c
the slope of that distance by the unknowns. Differentiating both the balance and the hold gives
H dq + c dF = −∂g/∂p dp and c·dq = dg, one linear system for all parameters.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.disc_basis import disc_basis, position_map
from solver.errors import SceneError
from solver.free_motions import drift
from solver.held_equilibrium import HeldEquilibrium
from solver.loop_energy import loop_energy
from solver.plates import Pitch
from solver.sensitivity import PARAMETERS, gradient_slopes
from solver.symmetry import ALIGNED

Vectors = NDArray[np.float64]

PITCH = "pitch"


def force_sensitivities(found: HeldEquilibrium) -> dict[str, float]:
    """Derivatives of the force (units of E_f t R) by `PARAMETERS` and by ``"pitch"``.

    Raises
    ------
    SceneError
        When the loop is not held at a pitch alone, or is none that `sensitivities` can do.
    """
    scene, hold = found.scene, found.hold
    if not isinstance(hold, Pitch) or hold.width is not None:
        raise SceneError("the force's sensitivities are those of a loop held at a pitch alone")
    if not scene.isotropic_circle or scene.natural_curvature > 0 or scene.alpha > 0:
        raise SceneError(
            "sensitivities are those of a circle of straight wire on isotropic fabric without "
            "bending: axis_ratio and modulus_ratio 1, natural_curvature and alpha 0"
        )
    basis = disc_basis(found.degree, ALIGNED)
    q = found.shape.coefficients
    crest = 2 * position_map(basis.unknowns, np.ones(1), np.zeros(1))[0, 0]
    n = len(q)
    system = np.zeros((n + 1, n + 1))
    system[:n, :n] = loop_energy(scene, basis).derivatives(q)[2] + drift(basis)
    system[:n, n] = system[n, :n] = crest
    right = np.zeros((n + 1, len(PARAMETERS) + 1))
    slopes = gradient_slopes(scene, basis, q)
    right[:n, :-1] = -np.stack([slopes[key] for key in PARAMETERS], axis=1)
    right[n, -1] = 1.0
    by = np.linalg.solve(system, right)[n]
    return dict(zip((*PARAMETERS, PITCH), by.tolist(), strict=True))
