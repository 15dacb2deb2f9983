"""Whether a solved saddle is a minimum among all smooth shapes, not only among saddles.

By symmetry the second variation falls into four classes, one for each pair of mirror parities; two
of them are equal, since a quarter turn swaps them. Motions that cost nothing are taken out: the six
rigid ones, and the turn of the fabric under the saddle, which an isotropic disc cannot feel.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.disc_basis import disc_basis
from solver.disc_functions import DiscFunction
from solver.loop_energy import loop_energy
from solver.scene import LoopScene
from solver.shape import Expansion, LoopShape, from_expansion
from solver.symmetry import Parity

Vectors = NDArray[np.float64]

CLASSES: tuple[tuple[Parity, Parity], ...] = ((0, 0), (1, 0), (1, 1))
"""The classes that differ; (0, 1) has the eigenvalues of (1, 0)."""


def _translation(component: int) -> Expansion:
    return {(component, DiscFunction(0, 0, "cos")): 1.0}


def _rotation(shape: LoopShape, first: int, second: int) -> Expansion:
    """Turn in the plane of two axes: first += −second, second += first."""
    out: Expansion = {}
    for (component, function), value in shape.expansion.items():
        if component == second:
            out[first, function] = -value
        elif component == first:
            out[second, function] = value
    return out


def _turn_of_fabric(shape: LoopShape) -> Expansion:
    """Derivative of the position by the angle in the disc."""
    return {
        (component, DiscFunction(f.m, f.k, "sin" if f.trig == "cos" else "cos")): (
            -f.m * value if f.trig == "cos" else f.m * value
        )
        for (component, f), value in shape.expansion.items()
    }


def free_motions(shape: LoopShape, symmetry: tuple[Parity, Parity]) -> tuple[Expansion, ...]:
    """Motions of one mirror class that leave the energy as it is."""
    return {
        (0, 0): (_translation(2),),
        (1, 0): (_translation(0), _rotation(shape, 0, 2)),
        (0, 1): (_translation(1), _rotation(shape, 1, 2)),
        (1, 1): (_rotation(shape, 0, 1), _turn_of_fabric(shape)),
    }[symmetry]


def class_hessian(
    scene: LoopScene, shape: LoopShape, degree: int, symmetry: tuple[Parity, Parity]
) -> tuple[Vectors, Vectors]:
    """Hessian (n, n) in one mirror class, and an orthonormal basis (n, f) of its free motions."""
    even = disc_basis(degree, (0, 0))
    basis = disc_basis(degree, symmetry)
    q = from_expansion(even.unknowns, shape.expansion)
    energy = loop_energy(scene, basis)
    hessian = energy.derivatives_around(even.gradient @ q, even.tangent @ q, even.second @ q)[2]
    free = np.stack(
        [from_expansion(basis.unknowns, motion) for motion in free_motions(shape, symmetry)], axis=1
    )
    left, singular, _ = np.linalg.svd(free, full_matrices=False)
    return hessian, left[:, singular > 1e-9 * singular[0]]


def lowest_eigenvalue(scene: LoopScene, shape: LoopShape, degree: int) -> float:
    """Lowest eigenvalue of the second variation, free motions taken out.

    It is the energy's curvature (units of E_f t) along a displacement whose mean square over the
    disc is 1; at least 0 for a minimum.
    """
    return min(
        float(np.linalg.eigvalsh(_without(*class_hessian(scene, shape, degree, symmetry)))[0])
        for symmetry in CLASSES
    )


def _without(hessian: Vectors, free: Vectors) -> Vectors:
    """Hessian with the span of ``free`` lifted out of the way of the lowest eigenvalue."""
    rest = np.eye(len(hessian)) - free @ free.T
    return rest @ hessian @ rest + float(np.trace(np.abs(hessian))) * free @ free.T
