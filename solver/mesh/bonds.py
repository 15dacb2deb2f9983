"""Where two wires touch: they share a vertex, and may be bonded with their tangents parallel."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Self

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

    Attributes
    ----------
    vertices : array (m, a)
    stiffness : array (m,)
        K, in units of E_f t R².
    tangents : array (m, 2, a) or (1, 2, a)
        Both tangents as sums of the vertices' positions, parallel when flat; by default between
        the first two vertices, and between the last two.
    """

    vertices: Indices
    stiffness: Vectors
    tangents: Vectors = field(default_factory=lambda: _BETWEEN_ENDS)

    def part(self, rows: Indices) -> Self:
        """Give the elements in these rows."""
        shape = (len(self.vertices), *self.tangents.shape[1:])
        return replace(
            self,
            vertices=self.vertices[rows],
            stiffness=self.stiffness[rows],
            tangents=np.broadcast_to(self.tangents, shape)[rows],
        )

    def energies(self, corners: Vectors) -> Vectors:
        """Energy (m,) of each bond."""
        return self.stiffness * (1 - self._turn(corners).invariants()[0])

    def derivatives(
        self, corners: Vectors, curvature: Curvature
    ) -> tuple[Vectors, Vectors, Vectors]:
        """Energies (m,), gradients (m, 3a) and Hessians (m, 3a, 3a)."""
        turn = self._turn(corners)
        of = _misalignment(turn.invariants()[0], self.stiffness)
        gradient, hessian = turn.derivatives(of)
        if curvature is Curvature.CONVEX:
            hessian = convex_part(hessian)
        from_corners = np.kron(self.tangents, np.eye(3))
        slope = (gradient[:, None, :] @ from_corners)[:, 0]
        return of.f, slope, np.swapaxes(from_corners, 1, 2) @ hessian @ from_corners

    def _turn(self, corners: Vectors) -> Turn:
        tangents = self.tangents @ corners
        return Turn(tangents[:, 0], tangents[:, 1])


_BETWEEN_ENDS = np.array([[[-1.0, 1.0, 0.0, 0.0], [0.0, 0.0, -1.0, 1.0]]])


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


def _neighbours(wire: Wire, place: int) -> list[int]:
    count = len(wire.vertices)
    return [int(wire.vertices[(place + step) % count]) for step in (-1, 1)]


def _tangent_weights(points: Vectors, before: int, at: int, after: int) -> Vectors:
    """Weights (3,) of the vertices before, after and at a contact in the tangent there.

    It is that of the parabola through the three, so that edges of different length do not turn it:
    the differences on both sides, each weighted by the other's length. On a circle it is exact.
    """
    back, ahead = (float(np.linalg.norm(points[k] - points[at])) for k in (before, after))
    return np.array([-ahead / back, back / ahead, ahead / back - back / ahead])


def bond_energy(mesh: Mesh, stiffness: float, loose: frozenset[int] = frozenset()) -> BondEnergy:
    """Bond of every contact of a mesh's wires, but those at ``loose`` vertices.

    Two elements stand in a row where three wires share a contact.
    """
    found = [contact for contact in contacts(mesh.wires) if contact.vertex not in loose]
    rows = np.zeros((len(found), 5), dtype=np.int64)
    tangents = np.zeros((len(found), 2, 5))
    for row, own, contact in zip(rows, tangents, found, strict=True):
        for k, (wire, place) in enumerate(zip(contact.wires, contact.places, strict=True)):
            ends = _neighbours(mesh.wires[wire], place)
            row[2 * k : 2 * k + 2] = ends
            own[k, [2 * k, 2 * k + 1, 4]] = _tangent_weights(
                mesh.points, ends[0], contact.vertex, ends[1]
            )
        row[4] = contact.vertex
        one, other = own @ mesh.points[row]
        own[1] *= np.sign(one @ other)
    return BondEnergy(rows, np.full(len(found), stiffness), tangents)
