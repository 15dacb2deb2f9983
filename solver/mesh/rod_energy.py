"""A wire as a chain of straight edges: bending at its vertices, stiff springs along its edges."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from solver.mesh.elements import Curvature
from solver.mesh.triangulation import Mesh
from solver.mesh.turn import Turn, TurnFunction, convex_part

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True)
class BendingEnergy:
    """Bending β ∮ (κ − κ0)² dl as β (2φ/s − κ0)² s/2 at each vertex between two edges.

    φ is the angle between the edges and s the sum of their lengths: a turn by φ over a length of
    s/2. Surface Evolver's ``sqcurve_string`` is the same up to fourth order in φ. As in
    `solver.rod`, κ0 points where κ does.

    Attributes
    ----------
    vertices : array (m, 3)
        Before, at and after each vertex.
    beta, natural_curvature : array (m,)
        β and κ0.
    """

    vertices: Indices
    beta: Vectors
    natural_curvature: Vectors

    def part(self, rows: Indices) -> Self:
        """Give the elements in these rows."""
        return replace(
            self,
            vertices=self.vertices[rows],
            beta=self.beta[rows],
            natural_curvature=self.natural_curvature[rows],
        )

    def energies(self, corners: Vectors) -> Vectors:
        """Energy (m,) of each vertex."""
        turn = _edges(corners)
        half = sum(turn.lengths()) / 2
        return self.beta * (turn.angle() / half - self.natural_curvature) ** 2 * half

    def derivatives(
        self, corners: Vectors, curvature: Curvature
    ) -> tuple[Vectors, Vectors, Vectors]:
        """Energies (m,), gradients (m, 9) and Hessians (m, 9, 9)."""
        turn = _edges(corners)
        of = _bending(turn, self.beta, self.natural_curvature)
        gradient, hessian = turn.derivatives(of)
        if curvature is Curvature.CONVEX:
            hessian = convex_part(hessian)
        return of.f, gradient @ FROM_EDGES, FROM_EDGES.T @ hessian @ FROM_EDGES


@dataclass(frozen=True)
class AxialEnergy:
    """Springs (k/2)(l − l₀)²/l₀ along the edges of wires.

    Attributes
    ----------
    vertices : array (m, 2)
    stiffness : array (m,)
        k = E_w A_w, in units of E_f t R.
    rest : array (m,)
        l₀.
    """

    vertices: Indices
    stiffness: Vectors
    rest: Vectors

    def part(self, rows: Indices) -> Self:
        """Give the elements in these rows."""
        return replace(
            self, vertices=self.vertices[rows], stiffness=self.stiffness[rows], rest=self.rest[rows]
        )

    def energies(self, corners: Vectors) -> Vectors:
        """Energy (m,) of each edge."""
        length = np.linalg.norm(corners[:, 1] - corners[:, 0], axis=1)
        return self.stiffness / 2 * (length - self.rest) ** 2 / self.rest

    def derivatives(
        self, corners: Vectors, curvature: Curvature
    ) -> tuple[Vectors, Vectors, Vectors]:
        """Energies (m,), gradients (m, 6) and Hessians (m, 6, 6)."""
        along = corners[:, 1] - corners[:, 0]
        length = np.linalg.norm(along, axis=1)
        unit = along / length[:, None]
        force = self.stiffness * (length / self.rest - 1)
        across = force / length
        if curvature is Curvature.CONVEX:
            across = np.maximum(across, 0)
        dyad = unit[:, :, None] * unit[:, None, :]
        block = (self.stiffness / self.rest - across)[:, None, None] * dyad
        block += across[:, None, None] * np.eye(3)
        pull = force[:, None] * unit
        hessian = np.concatenate(
            [np.concatenate([block, -block], axis=2), np.concatenate([-block, block], axis=2)],
            axis=1,
        )
        energies = self.stiffness / 2 * (length - self.rest) ** 2 / self.rest
        return energies, np.concatenate([-pull, pull], axis=1), hessian

    def excess(self, corners: Vectors, move: Vectors, reached: Vectors) -> Vectors:
        """Pulls (m, 6) of the stretch that a move brings beyond what is linear in it."""
        along = corners[:, 1] - corners[:, 0]
        length = np.linalg.norm(along, axis=1)
        unit = along / length[:, None]
        meant = length + np.sum(unit * (move[:, 1] - move[:, 0]), axis=1)
        beyond = np.linalg.norm(reached[:, 1] - reached[:, 0], axis=1) - meant
        pull = (self.stiffness * beyond / self.rest)[:, None] * unit
        return np.concatenate([-pull, pull], axis=1)


def _edges(corners: Vectors) -> Turn:
    return Turn(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 1])


FROM_EDGES = np.kron(np.array([[-1.0, 1.0, 0.0], [0.0, -1.0, 1.0]]), np.eye(3))
"""The two edge vectors (6) from the three corners (9)."""


def _bending(turn: Turn, beta: Vectors, kappa_0: Vectors) -> TurnFunction:
    """Give 2 β φ²/s − 2 β κ0 φ + β κ0² s/2 and its derivatives by cos φ and s."""
    phi, (_, s) = turn.angle(), turn.invariants()
    scale = 2 * beta / s
    small = phi < _SMALL_ANGLE
    sine = np.where(small, 1.0, np.sin(phi))
    # φ/sin φ and (sin φ − φ cos φ)/sin³ φ, by their series where φ is small
    ratio = np.where(small, 1 + phi**2 / 6, phi / sine)
    second = np.where(small, 1 / 3, (sine - phi * np.cos(phi)) / sine**3)
    f, f_c = scale * phi**2, -2 * scale * ratio
    # a straight wire gives its own curvature no direction: the angle is kept from vanishing
    bent = np.sin(np.maximum(phi, _STRAIGHT))
    own = 2 * beta * kappa_0
    return TurnFunction(
        f=f - own * phi + beta * kappa_0**2 * s / 2,
        f_c=f_c + own / bent,
        f_s=-f / s + beta * kappa_0**2 / 2,
        f_cc=2 * scale * second + own * np.cos(phi) / bent**3,
        f_cs=-f_c / s,
        f_ss=2 * f / s**2,
    )


_SMALL_ANGLE = 3e-3
_STRAIGHT = 1e-6


@dataclass(frozen=True, slots=True)
class WireStiffness:
    """β, k = E_w A_w/(E_f t R), κ0 and ρ of one wire; as in `solver.scene.LoopScene`."""

    beta: float
    axial_stiffness: float
    natural_curvature: float = 0.0
    twist_ratio: float = 0.0


def rod_energies(
    mesh: Mesh, stiffness: tuple[WireStiffness, ...]
) -> tuple[BendingEnergy, AxialEnergy]:
    """Bending and springs of a mesh's wires, unstretched as they lie flat."""
    corners = [wire.corners for wire in mesh.wires]
    edges = [wire.edges for wire in mesh.wires]
    ends = np.concatenate(edges)

    def spread(values: list[float], over: list[Indices]) -> Vectors:
        return np.repeat(values, [len(rows) for rows in over])

    bending = BendingEnergy(
        np.concatenate(corners),
        spread([s.beta for s in stiffness], corners),
        spread([s.natural_curvature for s in stiffness], corners),
    )
    rest = np.linalg.norm(mesh.points[ends[:, 1]] - mesh.points[ends[:, 0]], axis=1)
    return bending, AxialEnergy(ends, spread([s.axial_stiffness for s in stiffness], edges), rest)
