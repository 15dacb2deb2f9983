"""Where two wires touch: they share a vertex, and may be bonded with their tangents parallel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.mesh.elements import Curvature
from solver.mesh.triangulation import Mesh, Wire
from solver.mesh.turn import Turn, TurnFunction, convex_part

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True)
class BondEnergy:
    """Penalty K (1 − cos ψ) on the angle ψ between the tangents of two wires at their contact.

    A tangent runs from the vertex before the contact to the one after it.

    Attributes
    ----------
    vertices : array (m, 4)
        Ends of the one wire's tangent, then of the other's, in the order in which they are parallel
        when flat.
    stiffness : array (m,)
        K, in units of E_f t R².
    """

    vertices: Indices
    stiffness: Vectors

    def energies(self, corners: Vectors) -> Vectors:
        """Energy (m,) of each bond."""
        return self.stiffness * (1 - _tangents(corners).invariants()[0])

    def derivatives(
        self, corners: Vectors, curvature: Curvature
    ) -> tuple[Vectors, Vectors, Vectors]:
        """Energies (m,), gradients (m, 12) and Hessians (m, 12, 12)."""
        turn = _tangents(corners)
        of = _misalignment(turn.invariants()[0], self.stiffness)
        gradient, hessian = turn.derivatives(of)
        if curvature is Curvature.CONVEX:
            hessian = convex_part(hessian)
        return of.f, gradient @ _FROM_ENDS, _FROM_ENDS.T @ hessian @ _FROM_ENDS


def _tangents(corners: Vectors) -> Turn:
    return Turn(corners[:, 1] - corners[:, 0], corners[:, 3] - corners[:, 2])


_FROM_ENDS = np.kron(np.array([[-1.0, 1.0, 0.0, 0.0], [0.0, 0.0, -1.0, 1.0]]), np.eye(3))
"""The two tangents (6) from their ends (12)."""


def _misalignment(c: Vectors, stiffness: Vectors) -> TurnFunction:
    """Give K (1 − c) and its derivatives."""
    zero = np.zeros_like(c)
    return TurnFunction(stiffness * (1 - c), -stiffness, zero, zero, zero, zero)


@dataclass(frozen=True, slots=True)
class Crossing:
    """A vertex that two wires share, with each wire's number and place along it."""

    vertex: int
    wires: tuple[int, int]
    places: tuple[int, int]


def contacts(wires: tuple[Wire, ...]) -> tuple[Crossing, ...]:
    """Vertices through which two wires run, in the order of their numbers."""
    vertex = np.concatenate([w.vertices for w in wires])
    wire = np.repeat(np.arange(len(wires)), [len(w.vertices) for w in wires])
    place = np.concatenate([np.arange(len(w.vertices)) for w in wires])
    order = np.argsort(vertex, kind="stable")
    same = np.flatnonzero(np.diff(vertex[order]) == 0)
    return tuple(
        Crossing(
            int(vertex[one]), (int(wire[one]), int(wire[two])), (int(place[one]), int(place[two]))
        )
        for one, two in zip(order[same], order[same + 1], strict=True)
    )


def _tangent_ends(wire: Wire, place: int) -> list[int]:
    count = len(wire.vertices)
    return [int(wire.vertices[(place + step) % count]) for step in (-1, 1)]


def bond_energy(mesh: Mesh, stiffness: float) -> BondEnergy:
    """Bond of every contact of a mesh's wires."""
    found = contacts(mesh.wires)
    rows = np.zeros((len(found), 4), dtype=np.int64)
    for row, contact in zip(rows, found, strict=True):
        one, other = (
            _tangent_ends(mesh.wires[w], p)
            for w, p in zip(contact.wires, contact.places, strict=True)
        )
        along = [mesh.points[ends[1]] - mesh.points[ends[0]] for ends in (one, other)]
        row[:] = one + (other if along[0] @ along[1] > 0 else other[::-1])
    return BondEnergy(rows, np.full(len(found), stiffness))
