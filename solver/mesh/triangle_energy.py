"""Fabric as constant-strain triangles: St. Venant–Kirchhoff, prestrain as rest shape.

The energies are those of `solver.membrane` on a shape that is linear in each triangle.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.mesh.elements import Curvature
from solver.mesh.triangulation import Mesh

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True)
class TriangleEnergy:
    """Triangles with energy density w = ½ eᵀ C e, e = (E₁₁, E₂₂, 2E₁₂).

    Attributes
    ----------
    vertices : array (m, 3)
    shape_gradients : array (m, 3, 2)
        Gradient, over the unstretched fabric, of each corner's hat function.
    areas : array (m,)
        Unstretched areas.
    stiffness : array (3, 3)
        C, in units of E_f.
    """

    vertices: Indices
    shape_gradients: Vectors
    areas: Vectors
    stiffness: Vectors

    def _deformation(self, corners: Vectors) -> Vectors:
        """Deformation gradient (m, 3, 2) from the unstretched fabric."""
        return np.swapaxes(corners, 1, 2) @ self.shape_gradients

    def stress(self, corners: Vectors) -> Vectors:
        """Second Piola–Kirchhoff stress (S₁₁, S₂₂, S₁₂) of each triangle, (m, 3), units of E_f."""
        return _strain(self._deformation(corners)) @ self.stiffness

    def energies(self, corners: Vectors) -> Vectors:
        """Energy (m,) of each triangle."""
        strain = _strain(self._deformation(corners))
        return self.areas / 2 * np.sum(strain * (strain @ self.stiffness), axis=1)

    def derivatives(
        self, corners: Vectors, curvature: Curvature
    ) -> tuple[Vectors, Vectors, Vectors]:
        """Energies (m,), gradients (m, 9) and Hessians (m, 9, 9)."""
        deformation = self._deformation(corners)
        strain = _strain(deformation)
        stress = strain @ self.stiffness
        energies = self.areas / 2 * np.sum(strain * stress, axis=1)
        slope = self._strain_slope(deformation)
        weighted = self.areas[:, None] * stress
        gradients = (weighted[:, None, :] @ slope)[:, 0]
        # C is factored once, so that the material part is a Gram matrix
        root = np.linalg.cholesky(self.stiffness)
        scaled = (np.sqrt(self.areas)[:, None, None] * root.T) @ slope
        hessians = np.swapaxes(scaled, 1, 2) @ scaled
        if curvature is Curvature.CONVEX:
            weighted = _tensile(weighted)
        self._add_geometric(hessians, weighted)
        return energies, gradients, hessians

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


def _strain(deformation: Vectors) -> Vectors:
    """Green–Lagrange strain (E₁₁, E₂₂, 2E₁₂), (m, 3)."""
    along_1, along_2 = deformation[:, :, 0], deformation[:, :, 1]
    strain = np.empty((len(deformation), 3))
    strain[:, 0] = (np.sum(along_1 * along_1, axis=1) - 1) / 2
    strain[:, 1] = (np.sum(along_2 * along_2, axis=1) - 1) / 2
    strain[:, 2] = np.sum(along_1 * along_2, axis=1)
    return strain


def principal(stress: Vectors) -> tuple[Vectors, Vectors]:
    """Smaller and larger principal value (m,) of plane tensors (S₁₁, S₂₂, S₁₂), (m, 3)."""
    mean = (stress[:, 0] + stress[:, 1]) / 2
    radius = np.hypot((stress[:, 0] - stress[:, 1]) / 2, stress[:, 2])
    return mean - radius, mean + radius


def _tensile(stress: Vectors) -> Vectors:
    """Stress (m, 3) with its compressive principal values set to 0."""
    low, high = principal(stress)
    kept_low, kept_high = np.maximum(low, 0), np.maximum(high, 0)
    # S⁺ = p 1 + q S has the principal values kept_low and kept_high
    spread = high - low
    q = np.where(spread > 0, (kept_high - kept_low) / np.where(spread > 0, spread, 1.0), 0.0)
    p = kept_high - q * high
    return q[:, None] * stress + p[:, None] * np.array([1.0, 1.0, 0.0])


def triangle_energy(mesh: Mesh, strain: float, stiffness: Vectors) -> TriangleEnergy:
    """Triangles of a mesh whose fabric was stretched by ``strain`` in all directions to lie flat.

    Parameters
    ----------
    strain : float
        ε: the unstretched fabric is smaller by 1/(1+ε) in every direction.
    stiffness : array (3, 3)
        C, in units of E_f.
    """
    p, q, r = (mesh.points[mesh.triangles[:, k]] for k in range(3))
    opposite = np.stack([r - q, p - r, q - p], axis=1)
    # a hat function's gradient is the opposite side, turned inward by a quarter, over twice the area
    turned = np.stack([-opposite[:, :, 1], opposite[:, :, 0]], axis=2)
    gradients = (1 + strain) * turned / (2 * mesh.areas)[:, None, None]
    return TriangleEnergy(
        vertices=mesh.triangles,
        shape_gradients=gradients,
        areas=mesh.areas / (1 + strain) ** 2,
        stiffness=stiffness,
    )
