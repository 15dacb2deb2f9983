"""Motions that leave a loop's energy as it is: the rigid ones, and the turn of isotropic fabric."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from solver.disc_basis import DiscBasis
from solver.disc_functions import DiscFunction
from solver.shape import Expansion, LoopShape, from_expansion

Vectors = NDArray[np.float64]


def translation(component: int) -> Expansion:
    """Shift along one axis."""
    return {(component, DiscFunction(0, 0, "cos")): 1.0}


def rotation(shape: Expansion, first: int, second: int) -> Expansion:
    """Turn a shape in the plane of two axes: first += −second, second += first."""
    out: Expansion = {}
    for (component, function), value in shape.items():
        if component == second:
            out[first, function] = -value
        elif component == first:
            out[second, function] = value
    return out


def turn_of_fabric(shape: Expansion) -> Expansion:
    """Derivative of the position by the angle in the disc."""
    return {
        (component, DiscFunction(f.m, f.k, "sin" if f.trig == "cos" else "cos")): (
            -f.m * value if f.trig == "cos" else f.m * value
        )
        for (component, f), value in shape.items()
    }


@lru_cache(maxsize=128)
def _all_maps(basis: DiscBasis, motions: DiscBasis) -> tuple[Vectors, Vectors]:
    """The seven motions as functions of the shape: constant (7, m) and linear part (7, m, n)."""
    linear = np.zeros((7, motions.size, basis.size))
    held: dict[tuple[int, DiscFunction], list[tuple[int, float]]] = {}
    for row, written in enumerate(motions.unknowns):
        for term in written:
            held.setdefault((term.component, term.function), []).append((row, term.weight))
    for i, unknown in enumerate(basis.unknowns):
        shape = LoopShape((unknown,), np.ones(1)).expansion
        found = [rotation(shape, *axes) for axes in ((0, 1), (0, 2), (1, 2))]
        for k, motion in enumerate([*found, turn_of_fabric(shape)]):
            for key, value in motion.items():
                for row, weight in held.get(key, ()):
                    linear[3 + k, row, i] += weight * value
    constant = np.zeros((7, motions.size))
    for k in range(3):
        constant[k] = from_expansion(motions.unknowns, translation(k))
    return constant, linear


@lru_cache(maxsize=128)
def motion_maps(basis: DiscBasis, motions: DiscBasis, isotropic: bool) -> tuple[Vectors, Vectors]:
    """Free motions as functions of the shape: constant (f, m) and linear part (f, m, n).

    Parameters
    ----------
    basis : DiscBasis
        Of the shapes, n unknowns.
    motions : DiscBasis
        In which the motions are written, m unknowns; those of which it holds nothing are left out.
    isotropic : bool
        Whether a circular loop cannot feel which way its fabric is turned.
    """
    constant, linear = _all_maps(basis, motions)
    kept = np.flatnonzero(np.abs(constant).any(axis=1) | np.abs(linear).any(axis=(1, 2)))
    kept = kept if isotropic else kept[kept < 6]
    return constant[kept], linear[kept]


def free_motions_of(
    basis: DiscBasis, motions: DiscBasis, q: Vectors, *, isotropic: bool
) -> Vectors:
    """Free motions (…, f, m) of shapes q (…, n), each of length 1; some may be the same."""
    return _of_length_1(*motion_maps(basis, motions, isotropic), q)


def all_motions_of(basis: DiscBasis, motions: DiscBasis, q: Vectors) -> Vectors:
    """Three shifts, three turns in xy, xz and yz, and the fabric's turn of a shape q (n,), (7, m).

    Each has length 1, or is 0 where the motions' basis holds nothing of it.
    """
    return _of_length_1(*_all_maps(basis, motions), q)


def _of_length_1(constant: Vectors, linear: Vectors, q: Vectors) -> Vectors:
    free = constant + (linear @ q[..., None, :, None])[..., 0]
    return free / np.maximum(np.sqrt(np.sum(free * free, axis=-1, keepdims=True)), 1e-300)


@lru_cache(maxsize=128)
def drift(basis: DiscBasis) -> Vectors:
    """Matrix (n, n) that holds back the shift along z, which costs nothing where it is an unknown.

    Added to the Hessian it acts on Newton's steps alone, not on the energy, so that it does not
    change where they end.
    """
    level = [u[0].component == 2 and u[0].function.degree == 0 for u in basis.unknowns]
    return np.diag(np.array(level, dtype=float))


def orthonormal(free: Vectors) -> Vectors:
    """Orthonormal basis (m, r) of the span of motions (f, m)."""
    left, singular, _ = np.linalg.svd(free.T, full_matrices=False)
    return left[:, singular > 1e-9]


def lifted(hessian: Vectors, free: Vectors) -> Vectors:
    """Hessians (…, m, m) with free motions (…, f, m) out of the way of the lowest eigenvalue.

    These are given the stiffness of the stiffest, which leaves the others' as it is.
    """
    stiffness = np.abs(np.diagonal(hessian, axis1=-2, axis2=-1)).sum(axis=-1)[..., None, None]
    return hessian + stiffness * (np.swapaxes(free, -1, -2) @ free)
