"""A slight pull to the plane, which picks among shapes that differ by free hinges.

Parts that hang together by joints alone turn about them at no cost; on a table, the weight of
fabric and wire would lay them flat. Springs so weak that they change no shape do the same.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from solver.mesh.elements import Curvature
from solver.mesh.triangulation import Mesh

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]

_UP = np.diag([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class LevellingEnergy:
    """Springs (s/2) z² on each vertex.

    Attributes
    ----------
    vertices : array (m, 1)
    stiffness : array (m,)
        s, in units of E_f t.
    """

    vertices: Indices
    stiffness: Vectors

    def part(self, rows: Indices) -> Self:
        """Give the elements in these rows."""
        return replace(self, vertices=self.vertices[rows], stiffness=self.stiffness[rows])

    def energies(self, corners: Vectors) -> Vectors:
        """Energy (m,) of each vertex."""
        return self.stiffness / 2 * corners[:, 0, 2] ** 2

    def derivatives(
        self, corners: Vectors, curvature: Curvature
    ) -> tuple[Vectors, Vectors, Vectors]:
        """Energies (m,), gradients (m, 3) and Hessians (m, 3, 3), which are convex."""
        del curvature
        pull = self.stiffness[:, None] * corners[:, 0] @ _UP
        return self.energies(corners), pull, self.stiffness[:, None, None] * _UP


def levelling_energy(mesh: Mesh, stiffness: float) -> LevellingEnergy:
    """Springs on all vertices, of that stiffness for each loop's area."""
    everything = np.arange(len(mesh.points))[:, None]
    return LevellingEnergy(everything, stiffness * mesh.vertex_weights / np.pi)
