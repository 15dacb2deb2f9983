"""Stretching energy of the fabric, St. Venant–Kirchhoff, with prestrain as rest-shape data."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.float64]


@dataclass(frozen=True)
class Membrane:
    """Fabric of which every line was stretched by (1 + strain) to lie flat in the unit disc.

    Attributes
    ----------
    strain : float
        ε.
    a, b : float
        Coefficients of w = a Tr(E²) + b (Tr E)², from `solver.reading.density_coefficients`.
    """

    strain: float
    a: float
    b: float

    def green_lagrange(self, gradient: Vectors) -> Vectors:
        """Strain E, (…, 2, 2), of deformation gradients (…, 3, 2) relative to the flat disc."""
        stretched = (1 + self.strain) ** 2 * np.swapaxes(gradient, -1, -2) @ gradient
        return (stretched - np.eye(2)) / 2

    def stress(self, strain: Vectors) -> Vectors:
        """Second Piola–Kirchhoff stress ∂w/∂E, (…, 2, 2), in units of E_f."""
        trace = np.trace(strain, axis1=-2, axis2=-1)[..., None, None]
        return 2 * self.a * strain + 2 * self.b * trace * np.eye(2)

    def energy(self, gradient: Vectors, area: Vectors) -> float:
        """∫ w dA0 over points with deformation gradients (P, 3, 2) and flat areas (P,)."""
        strain = self.green_lagrange(gradient)
        trace = np.trace(strain, axis1=-2, axis2=-1)
        density = self.a * np.sum(strain * strain, axis=(-2, -1)) + self.b * trace * trace
        return float(np.sum(area * density) / (1 + self.strain) ** 2)

    def derivatives(
        self, gradient: Vectors, area: Vectors, maps: Vectors
    ) -> tuple[float, Vectors, Vectors]:
        """Energy, gradient (n,) and Hessian (n, n) in unknowns q with ``gradient = maps @ q``.

        Parameters
        ----------
        gradient : array (P, 3, 2)
        area : array (P,)
            Flat areas.
        maps : array (P, 3, 2, n)
        """
        n = maps.shape[-1]
        strain = self.green_lagrange(gradient)
        stress = self.stress(strain)
        # dE_jk/dq = (1+ε)²/2 (F^T G + G^T F), and the (1+ε)² cancels that of dA0 = dA/(1+ε)²
        first_piola = gradient @ stress
        slope = (area[:, None, None] * first_piola).ravel() @ maps.reshape(-1, n)
        turned = np.swapaxes(gradient, -1, -2) @ maps.reshape(len(area), 3, 2 * n)
        turned = turned.reshape(len(area), 2, 2, n)
        strain_slope = (turned + np.swapaxes(turned, 1, 2)) / 2
        root = np.sqrt(2 * self.a * area)[:, None, None, None]
        shear = (root * strain_slope).reshape(-1, n)
        swell = strain_slope[:, 0, 0] + strain_slope[:, 1, 1]
        material = shear.T @ shear + swell.T @ ((2 * self.b * area)[:, None] * swell)
        weighted = area[:, None, None, None] * np.einsum("pjk,pckn->pcjn", stress, maps)
        geometric = maps.reshape(-1, n).T @ weighted.reshape(-1, n)
        hessian = (1 + self.strain) ** 2 * material + geometric
        return self.energy(gradient, area), slope, (hessian + hessian.T) / 2
