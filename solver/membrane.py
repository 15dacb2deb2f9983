"""Stretching energy of the fabric, St. Venant–Kirchhoff, with prestrain as rest-shape data."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.float64]

_UNIT = np.eye(2)
_LISTED = np.array([0, 2, 2, 1])
"""Where 11, 12, 21 and 22 stand among the strains and stresses of `Membrane.stiffness`."""


@dataclass(frozen=True)
class Membrane:
    """Fabric of which every line was stretched by (1 + strain) to lie flat in the loop.

    Points of the flat ellipse are those of the unit disc, scaled by its semi-axes; deformation
    gradients and areas are taken relative to the unit disc.

    Attributes
    ----------
    strain : float
        ε.
    a, b : float
        Coefficients of w = a Tr(E²) + b (Tr E)², from `solver.reading.density_coefficients`.
    semi_axes : tuple of float
        Of the flat loop along x and y.
    moduli : tuple of float
        Factors E1, E2 of an orthotropic fabric: the stiffness along x is 2(a+b) E1, that along y
        2(a+b) E2, that in shear a √(E1 E2), and what couples the two directions stays 2b.
    """

    strain: float
    a: float
    b: float
    semi_axes: tuple[float, float] = (1.0, 1.0)
    moduli: tuple[float, float] = (1.0, 1.0)

    @property
    def stretch(self) -> Vectors:
        """Factors (2,) by which derivatives along the unit disc's x and y grow."""
        return (1 + self.strain) / np.array(self.semi_axes)

    @property
    def stiffness(self) -> Vectors:
        """Matrix (3, 3) from the strains E11, E22, 2 E12 to the stresses S11, S22, S12."""
        along, across = self.moduli
        q, coupling = 2 * (self.a + self.b), 2 * self.b
        shear = self.a * math.sqrt(along * across)
        return np.array([[q * along, coupling, 0], [coupling, q * across, 0], [0, 0, shear]])

    def green_lagrange(self, gradient: Vectors) -> Vectors:
        """Strain E, (…, 2, 2), of deformation gradients (…, 3, 2) relative to the unit disc."""
        stretched = gradient * self.stretch
        return (np.swapaxes(stretched, -1, -2) @ stretched - _UNIT) / 2

    def stress(self, strain: Vectors) -> Vectors:
        """Second Piola–Kirchhoff stress ∂w/∂E, (…, 2, 2), in units of E_f."""
        tensor = self.stiffness[_LISTED[:, None], _LISTED]
        return (strain.reshape(*strain.shape[:-2], 4) @ tensor).reshape(strain.shape)

    def _rest(self, area: Vectors) -> Vectors:
        """Unstretched areas of areas of the unit disc."""
        return area * (math.prod(self.semi_axes) / (1 + self.strain) ** 2)

    def energy(self, gradient: Vectors, area: Vectors) -> float:
        """∫ w dA0 over points with deformation gradients (P, 3, 2) and disc areas (P,)."""
        strain = self.green_lagrange(gradient)
        density = np.einsum("...jk,...jk->...", strain, self.stress(strain)) / 2
        return float(self._rest(area) @ density)

    def derivatives(
        self, gradient: Vectors, area: Vectors, maps: Vectors
    ) -> tuple[float, Vectors, Vectors]:
        """Energy, gradient (n,) and Hessian (n, n) in unknowns q with ``gradient = maps @ q``.

        Parameters
        ----------
        gradient : array (P, 3, 2)
        area : array (P,)
            Areas of the unit disc.
        maps : array (P, 3, 2, n)
        """
        points, n = len(area), maps.shape[-1]
        rest, metric = self._rest(area), np.outer(self.stretch, self.stretch)
        strain = self.green_lagrange(gradient)
        stress = self.stress(strain)
        energy = float(rest @ np.sum(strain * stress, axis=(-2, -1)) / 2)
        weighted_stress = rest[:, None, None] * metric * stress
        slope = (gradient @ weighted_stress).ravel() @ maps.reshape(-1, n)
        # dE_jk/dq = (F^T G + G^T F)/2, rows and columns scaled by the stretch
        turned = np.swapaxes(gradient, -1, -2) @ maps.reshape(points, 3, 2 * n)
        turned = turned.reshape(points, 2, 2, n) * metric[:, :, None]
        strain_slope = np.stack(
            [turned[:, 0, 0], turned[:, 1, 1], turned[:, 0, 1] + turned[:, 1, 0]], axis=1
        )
        stiff = (rest[:, None, None] * self.stiffness) @ strain_slope
        material = strain_slope.reshape(-1, n).T @ stiff.reshape(-1, n)
        geometric = maps.reshape(-1, n).T @ (weighted_stress[:, None] @ maps).reshape(-1, n)
        hessian = material + geometric
        return energy, slope, (hessian + hessian.T) / 2
