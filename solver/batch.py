"""Energies, stresses and stiffnesses of many circular loops, one array operation for all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.disc_basis import DiscBasis
from solver.free_motions import free_motions_of, lifted
from solver.quartic import FabricPolynomial, QuarticTable, shape_table
from solver.reading import density_coefficients
from solver.rod import Rod, by_unknowns
from solver.scene import LoopScene
from solver.stability import classes_of, motions

Vectors = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class LoopBatch:
    """B circular loops on isotropic fabric, wires without a curvature of their own.

    Attributes
    ----------
    strain, a, b, beta, axial_stiffness : array (B,)
        As those of `solver.membrane.Membrane` and `solver.rod.Rod`.
    """

    strain: Vectors
    a: Vectors
    b: Vectors
    beta: Vectors
    axial_stiffness: Vectors

    @classmethod
    def of(cls, scenes: Sequence[LoopScene]) -> LoopBatch:
        """Take the numbers of scenes."""
        a, b = np.array([density_coefficients(s.poisson, s.reading) for s in scenes]).T
        return cls(
            np.array([s.strain for s in scenes]),
            a,
            b,
            np.array([s.beta for s in scenes]),
            np.array([s.axial_stiffness for s in scenes]),
        )

    def part(self, index: Indices) -> LoopBatch:
        """Give some of them."""
        return LoopBatch(
            self.strain[index],
            self.a[index],
            self.b[index],
            self.beta[index],
            self.axial_stiffness[index],
        )

    @property
    def rod(self) -> Rod:
        """Their wires."""
        return Rod(self.beta[:, None], self.axial_stiffness[:, None])

    def fabric(self, table: QuarticTable) -> FabricPolynomial:
        """Their fabric, along the motions of a table."""
        return FabricPolynomial(table, self.strain, self.a, self.b)

    def derivatives(
        self, basis: DiscBasis, q: Vectors, force: Vectors | None = None
    ) -> tuple[Vectors, Vectors, Vectors]:
        """Energies (B,), gradients (B, n) and Hessians (B, n, n), as of `LoopEnergy`."""
        fabric = self.fabric(shape_table(basis)).derivatives(q)
        wire = self.rod.derivatives(basis.along_edge(q), basis.arc, basis.edge, force=force)
        return fabric[0] + wire[0], fabric[1] + wire[1], fabric[2] + wire[2]

    def smallest_stress(self, basis: DiscBasis, q: Vectors) -> Vectors:
        """Smallest principal stress (B,) of each fabric, units of E_f."""
        flat = basis.gradient.reshape(-1, basis.size)
        gradient = (q @ flat.T).reshape(len(q), -1, 3, 2)
        g = np.swapaxes(gradient, -1, -2) @ gradient * ((1 + self.strain) ** 2)[:, None, None, None]
        along, across, shear = g[..., 0, 0], g[..., 1, 1], g[..., 0, 1]
        trace = (along + across) / 2 - 1
        least = trace / 2 - np.hypot((along - across) / 4, shear / 2)
        stress = 2 * self.a[:, None] * least + 2 * self.b[:, None] * trace
        return stress.min(axis=1)

    def weakest_stiffness(self, basis: DiscBasis, q: Vectors, highest: int) -> Vectors:
        """Lowest eigenvalue (B,) among motions up to a degree, as `weakest_motion` finds it."""
        listed = [motions(basis, "saddle", symmetry, highest) for symmetry in classes_of("saddle")]
        edge = (q @ listed[0].edge.reshape(-1, basis.size).T).reshape(len(q), -1, 6)
        wire = self.rod.along(edge, listed[0].basis.arc)[2]
        found = np.full(len(q), np.inf)
        for moves in listed:
            hessian = by_unknowns(wire, moves.basis.edge) + self.fabric(moves.table).hessian(q)
            free = free_motions_of(basis, moves.basis, q, isotropic=True)
            found = np.minimum(found, np.linalg.eigvalsh(lifted(hessian, free))[:, 0])
        return found
