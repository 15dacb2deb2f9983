"""Whether a held shape is a minimum among all shapes that its contacts allow.

The second variation is that of the Lagrangian: on top of the energy's, each contact adds λ s sᵀ/k,
for the touching point moves along the wire (`touching`). Motions must leave the contacts where they
are. By the two mirrors it falls into four classes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.circle import telling_degree
from solver.disc_basis import DiscBasis, position_map
from solver.edge_rows import edge_rows
from solver.free_motions import all_motions_of
from solver.plates import Contact, Pitch, Plates
from solver.scene import LoopScene
from solver.stability import classes_of, hessian_along, motions, wire_curvature
from solver.symmetry import ALIGNED, Mirrors

Vectors = NDArray[np.float64]

_TURNS = ((0, 1), (0, 2), (1, 2))
"""Planes of the rotations, in the order of `free_motions.all_motions_of`."""


@dataclass(frozen=True, slots=True)
class HeldStability:
    """Lowest eigenvalues with turns of the loop as a whole taken out, and with them."""

    upright: float
    tilting: float


def _contact_rows(
    basis: DiscBasis, component: int, contacts: tuple[Contact, ...]
) -> tuple[Vectors, Vectors]:
    """Rows (k, m) by which motions move the touching points, and (k, m) of the wire's slope there.

    The second are scaled by the root of λ/k, and 0 for points that do not move along the wire.
    """
    wire = edge_rows(basis, component)
    rows, slopes = np.empty((2, len(contacts), basis.size))
    for i, contact in enumerate(contacts):
        angle = np.array([contact.angle_rad])
        on_wire, slope, _ = wire.at(angle)
        slopes[i] = slope[0] * math.sqrt(contact.force / contact.bend)
        radius = np.array([contact.radius])
        within = contact.radius < 1
        inside = position_map(basis.unknowns, radius, angle)[:, component] if within else on_wire
        rows[i] = inside[0]
    return rows, slopes


def _pitch_rows(basis: DiscBasis, mirrors: Mirrors, pitch: Pitch) -> Vectors:
    """Rows (k, m) by which motions change the prescribed distances."""
    held = [(0, 0.0)] + ([(1, np.pi / 2)] if pitch.width is not None else [])
    # a motion that a mirror changes in sign moves both ends of a distance the same way
    kept = [edge_rows(basis, c).at(np.array([a]))[0] for c, a in held if mirrors[c] == 0]
    return np.concatenate([np.zeros((0, basis.size)), *kept])


def _allowed(rows: Vectors) -> Vectors:
    """Orthonormal motions (m, m − a) that rows (k, m) of rank a allow."""
    _, singular, turned = np.linalg.svd(rows, full_matrices=True)
    rank = int(np.sum(singular > 1e-9 * max(1.0, singular.max(initial=0.0))))
    return turned[rank:].T


def _lowest(hessian: Vectors, free: Vectors, allowed: Vectors) -> float:
    stiffness = np.abs(np.diagonal(hessian)).sum()
    within = allowed.T @ (hessian + stiffness * (free.T @ free)) @ allowed
    return float(np.linalg.eigvalsh(within)[0])


def _costless(hold: Plates | Pitch, *, touching: bool, isotropic: bool) -> NDArray[np.bool_]:
    """Which of the three translations, three turns and the fabric's turn the hold cannot feel."""
    shifts, turns = np.ones(3, dtype=bool), np.ones(3, dtype=bool)
    if touching and isinstance(hold, Plates):
        shifts[hold.axis.component] = False
        turns = np.array([hold.axis.component not in plane for plane in _TURNS])
    elif touching:
        turns[:] = False
    # bonds hold points of the wire, and feel how the fabric in the loop is turned
    fabric = isotropic and not (touching and isinstance(hold, Pitch))
    return np.concatenate([shifts, turns, [fabric]])


def held_stability(
    scene: LoopScene,
    hold: Plates | Pitch,
    basis: DiscBasis,
    q: Vectors,
    contacts: tuple[Contact, ...],
    *,
    stress: float,
    compression: float,
) -> HeldStability:
    """Find the lowest eigenvalues at a shape q (n,) of a basis with two mirrors.

    Parameters
    ----------
    contacts : tuple of Contact
        Forces as of the Lagrangian: those of all mirror images together.
    stress : float
        Smallest principal stress of the fabric, units of E_f.
    compression : float
        Largest of the wire, units of E_f t R: it bends in no more than n waves,
        n (n + 1) = compression/2β.
    """
    waves = math.ceil(math.sqrt(max(compression, 0.0) / (2 * scene.beta)))
    highest = min(basis.degree + 1, max(telling_degree(scene, stress, basis.degree), waves))
    touching = bool(contacts) or isinstance(hold, Pitch)
    costless = _costless(hold, touching=touching, isotropic=scene.isotropic_circle)
    # bonds hold the wire's tangents too, and so the saddle's axes in the loop
    turns = np.array([False] * 3 + [True] * 3 + [isinstance(hold, Pitch)])
    upright, tilting = math.inf, math.inf
    classes = classes_of(ALIGNED)
    listed = [motions(basis, ALIGNED, symmetry, highest) for symmetry in classes]
    wire = wire_curvature(scene, listed[0], q)
    for symmetry, moves in zip(classes, listed, strict=True):
        hessian = hessian_along(scene, moves, q, wire, tabulated=False)
        if isinstance(hold, Plates):
            rows, slopes = _contact_rows(moves.basis, hold.axis.component, contacts)
            hessian = hessian + slopes.T @ slopes
        else:
            rows = _pitch_rows(moves.basis, symmetry.in_plane[0], hold)
        allowed = _allowed(rows)
        whole = all_motions_of(basis, moves.basis, q)
        lowest = _lowest(hessian, whole[costless], allowed)
        tilting = min(tilting, lowest)
        stopped = turns & ~costless & whole.any(axis=-1)
        if stopped.any():
            lowest = _lowest(hessian, whole[costless | turns], allowed)
        upright = min(upright, lowest)
    return HeldStability(upright, tilting)
