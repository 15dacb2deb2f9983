"""Twist of the closed wires of a mesh.

A closed wire that was laid flat without twist is twisted by as many turns as its loop writhes, and
spreads them evenly (see `solver.twist`). Along a length L that costs 4π² β ρ Wr²/L: 2π β ρ Wr² for
a loop of perimeter 2π. The writhe of a chain is told by the area that its tangent encloses on the
sphere, Wr = area/2π − 1 for a loop that was simple when flat (Fuller, Proc. Natl. Acad. Sci. USA 75
(1978) 3557), as long as no tangent has come to point against the pole.

That area is a sum over the wire's vertices, and its square couples them all: each wire is one
element, its Hessian full.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from solver.checks import STRAYED, writhe
from solver.mesh.elements import Curvature
from solver.mesh.measures import area_vector
from solver.mesh.rod_energy import FROM_EDGES, WireStiffness
from solver.mesh.swept_area import SweptArea
from solver.mesh.triangulation import Mesh, Wire

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]

_TELLING_POINTS = 40


@dataclass(frozen=True)
class TwistEnergy:
    """Twist of closed wires of n vertices each (docs/theory.md, eq. (9), writhe by eq. (16)).

    Attributes
    ----------
    vertices : array (m, n)
        In their order along each wire.
    stiffness : array (m,)
        Energy of one turn, in units of E_f t R².
    """

    vertices: Indices
    stiffness: Vectors

    def part(self, rows: Indices) -> Self:
        """Give the elements in these rows."""
        return replace(self, vertices=self.vertices[rows], stiffness=self.stiffness[rows])

    def _swept(self, corners: Vectors) -> SweptArea:
        """Areas (m · n) from edge to edge, each loop's about its own axis."""
        along = np.roll(corners, -1, axis=1) - corners
        axes = np.array([area_vector(loop) for loop in corners])
        axes /= np.linalg.norm(axes, axis=1, keepdims=True)
        pole = np.repeat(axes, corners.shape[1], axis=0)
        before = np.roll(along, 1, axis=1)
        return SweptArea(before.reshape(-1, 3), along.reshape(-1, 3), pole)

    def writhe(self, corners: Vectors) -> Vectors:
        """Turns (m,) by which each wire at (m, n, 3) writhes."""
        return _turns(self._swept(corners), len(corners))

    def energies(self, corners: Vectors) -> Vectors:
        """Energy (m,) of each wire."""
        return self.stiffness * self.writhe(corners) ** 2

    def derivatives(
        self, corners: Vectors, curvature: Curvature
    ) -> tuple[Vectors, Vectors, Vectors]:
        """Energies (m,), gradients (m, 3n) and Hessians (m, 3n, 3n)."""
        wires, n = self.vertices.shape
        swept = self._swept(corners)
        turns = _turns(swept, wires)
        by_edges, bent = swept.derivatives()
        places = _places(n)
        slope = np.zeros((wires, 3 * n))
        for k, local in enumerate((by_edges @ FROM_EDGES).reshape(wires, n, 9).swapaxes(0, 1)):
            slope[:, places[k]] += local / (2 * np.pi)
        hessian = slope[:, :, None] * slope[:, None, :]
        if curvature is not Curvature.CONVEX:
            weight = np.repeat(turns, n)[:, None, None] / (2 * np.pi)
            local = (weight * (FROM_EDGES.T @ bent @ FROM_EDGES)).reshape(wires, n, 9, 9)
            for k in range(n):
                hessian[:, places[k][:, None], places[k]] += local[:, k]
        twice = 2 * self.stiffness
        hessian *= twice[:, None, None]
        return self.stiffness * turns**2, (twice * turns)[:, None] * slope, hessian


def twist_strays(energies: tuple[TwistEnergy, ...], positions: Vectors) -> bool:
    """Whether a wire's twist was reckoned from a writhe that is not its loop's.

    That by the tangent's area is out by 2 where the tangent has come to point against the pole.
    """
    return any(
        abs(turns - writhe(loop[:: max(1, len(loop) // _TELLING_POINTS)])) > STRAYED
        for energy in energies
        for loop, turns in zip(
            positions[energy.vertices], energy.writhe(positions[energy.vertices]), strict=True
        )
    )


def _turns(swept: SweptArea, wires: int) -> Vectors:
    return swept.area().reshape(wires, -1).sum(axis=1) / (2 * np.pi) - 1


def _places(n: int) -> Indices:
    """Unknowns (n, 9) of the vertices before, at and after each vertex of a wire."""
    at = np.arange(n)
    corners = np.stack([np.roll(at, 1), at, np.roll(at, -1)], axis=1)
    return (3 * corners[:, :, None] + np.arange(3)).reshape(n, 9)


def twist_stiffness(mesh: Mesh, wire: Wire, stiffness: WireStiffness, ratio: float) -> float:
    """Energy of one turn of twist in a wire, with ``ratio`` = ρ, in units of E_f t R²."""
    ends = mesh.points[wire.edges]
    length = float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum())
    return 4 * np.pi**2 * stiffness.beta * ratio / length


def twist_energies(mesh: Mesh, wires: tuple[WireStiffness, ...]) -> tuple[TwistEnergy, ...]:
    """Twist of a mesh's closed wires, those of different counts of vertices apart."""
    rows: dict[int, list[tuple[Indices, float]]] = {}
    for wire, own in zip(mesh.wires, wires, strict=True):
        if wire.closed and own.twist_ratio > 0:
            turn = twist_stiffness(mesh, wire, own, own.twist_ratio)
            rows.setdefault(len(wire.vertices), []).append((wire.vertices, turn))
    return tuple(
        TwistEnergy(np.array([v for v, _ in group]), np.array([turn for _, turn in group]))
        for _, group in sorted(rows.items())
    )
