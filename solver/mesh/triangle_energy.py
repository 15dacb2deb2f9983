"""Fabric as constant-strain triangles, with prestrain as rest shape.

Of plain fabric the energies are those of `solver.membrane` on a shape that is linear in each
triangle.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from solver.mesh.elements import Curvature
from solver.mesh.fabric_law import FabricLaw, Flags, StVenantKirchhoff
from solver.mesh.plane_tensor import tensile
from solver.mesh.tension_field import TensionField
from solver.mesh.triangulation import Mesh

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True)
class TriangleEnergy:
    """Triangles with an energy density that is a law of the strain.

    Attributes
    ----------
    vertices : array (m, 3)
    shape_gradients : array (m, 3, 2)
        Gradient, over the unstretched fabric, of each corner's hat function.
    areas : array (m,)
        Unstretched areas.
    law : FabricLaw
    """

    vertices: Indices
    shape_gradients: Vectors
    areas: Vectors
    law: FabricLaw

    def part(self, rows: Indices) -> Self:
        """Give the elements in these rows."""
        return replace(
            self,
            vertices=self.vertices[rows],
            shape_gradients=self.shape_gradients[rows],
            areas=self.areas[rows],
        )

    def _deformation(self, corners: Vectors) -> Vectors:
        """Deformation gradient (m, 3, 2) from the unstretched fabric."""
        return np.swapaxes(corners, 1, 2) @ self.shape_gradients

    def strain(self, corners: Vectors) -> Vectors:
        """Green–Lagrange strain (E₁₁, E₂₂, 2E₁₂) of each triangle, (m, 3)."""
        return green_lagrange(self._deformation(corners))

    def stress(self, corners: Vectors) -> Vectors:
        """Second Piola–Kirchhoff stress (S₁₁, S₂₂, S₁₂) of each triangle, (m, 3), units of E_f."""
        return self.law.stress(self.strain(corners))

    def smallest_stress(self, corners: Vectors) -> Vectors:
        """Smaller principal stress (m,) of each triangle, units of E_f."""
        return self.law.smallest_stress(self.strain(corners))

    def compressed(self, corners: Vectors) -> Flags:
        """Whether each triangle is compressed, or wrinkled instead, (m,)."""
        return self.law.compressed(self.strain(corners))

    def energies(self, corners: Vectors) -> Vectors:
        """Energy (m,) of each triangle."""
        return self.areas * self.law.density(self.strain(corners))

    def derivatives(
        self, corners: Vectors, curvature: Curvature
    ) -> tuple[Vectors, Vectors, Vectors]:
        """Energies (m,), gradients (m, 9) and Hessians (m, 9, 9)."""
        deformation = self._deformation(corners)
        strain = green_lagrange(deformation)
        steady = curvature is Curvature.STEADY
        density, stress, root = self.law.derivatives(strain, steady=steady)
        energies = self.areas * density
        slope = self._strain_slope(deformation)
        weighted = self.areas[:, None] * stress
        gradients = (weighted[:, None, :] @ slope)[:, 0]
        # with a root of the stiffness, the material part is a Gram matrix
        scaled = (np.sqrt(self.areas)[:, None, None] * root) @ slope
        hessians = np.swapaxes(scaled, 1, 2) @ scaled
        if curvature is Curvature.CONVEX:
            weighted = tensile(weighted)
        self._add_geometric(hessians, weighted)
        return energies, gradients, hessians

    def excess(self, corners: Vectors, move: Vectors, reached: Vectors) -> Vectors:
        """Pulls (m, 9) of the strain that a move brings beyond what is linear in it."""
        slope = self._strain_slope(self._deformation(corners))
        meant = self.strain(corners) + (slope @ move.reshape(-1, 9, 1))[:, :, 0]
        beyond = self.law.stress(self.strain(reached)) - self.law.stress(meant)
        return ((self.areas[:, None] * beyond)[:, None, :] @ slope)[:, 0]

    def _strain_slope(self, deformation: Vectors) -> Vectors:
        """Derivative (m, 3, 9) of (E₁₁, E₂₂, 2E₁₂) by the corners' positions."""
        along_1, along_2 = deformation[:, None, :, 0], deformation[:, None, :, 1]
        g_1, g_2 = self.shape_gradients[:, :, None, 0], self.shape_gradients[:, :, None, 1]
        slope = np.empty((len(deformation), 3, 3, 3))
        slope[:, 0] = g_1 * along_1
        slope[:, 1] = g_2 * along_2
        slope[:, 2] = g_1 * along_2 + g_2 * along_1
        return slope.reshape(-1, 3, 9)

    def _add_geometric(self, hessians: Vectors, stress: Vectors) -> None:
        """Add what the stress, times area, gives in all three components alike."""
        g = self.shape_gradients
        s = np.stack([stress[:, [0, 2]], stress[:, [2, 1]]], axis=1)
        between = g @ s @ np.swapaxes(g, 1, 2)
        blocks = hessians.reshape(-1, 3, 3, 3, 3)
        for component in range(3):
            blocks[:, :, component, :, component] += between


def green_lagrange(deformation: Vectors) -> Vectors:
    """Green–Lagrange strain (E₁₁, E₂₂, 2E₁₂), (m, 3), of deformation gradients (m, 3, 2)."""
    along_1, along_2 = deformation[:, :, 0], deformation[:, :, 1]
    strain = np.empty((len(deformation), 3))
    strain[:, 0] = (np.sum(along_1 * along_1, axis=1) - 1) / 2
    strain[:, 1] = (np.sum(along_2 * along_2, axis=1) - 1) / 2
    strain[:, 2] = np.sum(along_1 * along_2, axis=1)
    return strain


def triangle_energy(
    mesh: Mesh, strain: float, stiffness: Vectors, *, tension_field: bool = False
) -> TriangleEnergy:
    """Triangles of a mesh whose fabric was stretched by ``strain`` in all directions to lie flat.

    Parameters
    ----------
    strain : float
        ε: the unstretched fabric is smaller by 1/(1+ε) in every direction.
    stiffness : array (3, 3)
        From the strain (E₁₁, E₂₂, 2E₁₂) to the stress, in units of E_f.
    tension_field : bool
        Whether the fabric wrinkles instead of bearing compression.
    """
    p, q, r = (mesh.points[mesh.triangles[:, k]] for k in range(3))
    opposite = np.stack([r - q, p - r, q - p], axis=1)
    # a hat function's gradient: the opposite side, turned inward by a quarter, over twice the area
    turned = np.stack([-opposite[:, :, 1], opposite[:, :, 0]], axis=2)
    gradients = (1 + strain) * turned / (2 * mesh.areas)[:, None, None]
    return TriangleEnergy(
        vertices=mesh.triangles,
        shape_gradients=gradients,
        areas=mesh.areas / (1 + strain) ** 2,
        law=TensionField(stiffness) if tension_field else StVenantKirchhoff(stiffness),
    )
