"""Bending of the fabric as the SESAME paper has it: α ∫ H² dA over the deformed surface.

H = (κ₁ + κ₂)/2 is the mean curvature: with it the paper's coefficient E_f t³/(6(1−ν²)) (Eq. 1) is
that of a thin plate, whose energy is D/2 ∫ ((κ₁ + κ₂)² − 2(1−ν) κ₁κ₂) dA, D = E_f t³/(12(1−ν²)).
Surface Evolver, with which the paper solves, has the same H and the same area.

The plate's second part, −(1−ν) α/2 ∫ K dA with K = κ₁κ₂, is not in the paper's energy. A saddle has
K < 0, so that it would pay for that too; `gauss_integral` tells how much.

A surface with x_u, x_v, x_uu, x_uv and x_vv has, in any parameters,

    H = p/(2 W³),  p = G x_uu·N − 2F x_uv·N + E x_vv·N,  N = x_u × x_v,  W = |N|,

with E, F and G its first fundamental form (do Carmo, Differential Geometry, section 3.3), so that
H² dA = p²/(4 W⁵) du dv: docs/theory.md, eq. (13); the section there tells what α does.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.float64]

_ALTERNATING = np.zeros((3, 3, 3))
for _i, _j, _k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
    _ALTERNATING[_i, _j, _k], _ALTERNATING[_i, _k, _j] = 1.0, -1.0


@dataclass(frozen=True)
class _Forms:
    """E, F, G, x_uu·N, x_uv·N and x_vv·N of P points, (P, 6), and their derivatives.

    Attributes
    ----------
    values : array (P, 6)
    slopes : array (P, 6, 5, 3)
        By the components of x_u, x_v, x_uu, x_uv and x_vv.
    """

    values: Vectors
    slopes: Vectors

    def turned(self, weights: Vectors, jet: Vectors) -> Vectors:
        """Sum of the second derivatives (P, 5, 3, 5, 3) of all six, times weights (P, 6)."""
        out = np.zeros((len(jet), 5, 3, 5, 3))
        for (i, j), weight in zip(_METRIC, _metric_weights(weights), strict=True):
            for axis in range(3):
                out[:, i, axis, j, axis] += weight
        for k in (0, 1, 2):
            weight = weights[:, 3 + k, None]
            by_u = np.einsum("pc,abc->pab", weight * jet[:, 1], _ALTERNATING)
            by_v = -np.einsum("pc,abc->pab", weight * jet[:, 0], _ALTERNATING)
            both = np.einsum("pa,abc->pbc", weight * jet[:, 2 + k], _ALTERNATING)
            for one, other, block in ((2 + k, 0, by_u), (2 + k, 1, by_v), (0, 1, both)):
                out[:, one, :, other] += block
                out[:, other, :, one] += np.swapaxes(block, 1, 2)
        return out


_METRIC = ((0, 0), (0, 1), (1, 0), (1, 1))
"""Blocks in which E, F (twice) and G have second derivatives."""


def _metric_weights(weights: Vectors) -> tuple[Vectors, Vectors, Vectors, Vectors]:
    return 2 * weights[:, 0], weights[:, 1], weights[:, 1], 2 * weights[:, 2]


def _forms(jet: Vectors) -> _Forms:
    """Forms of points with x_u, x_v, x_uu, x_uv and x_vv, (P, 5, 3)."""
    u, v, bends = jet[:, 0], jet[:, 1], jet[:, 2:]
    normal = np.cross(u, v)
    products = [np.sum(one * other, axis=1) for one, other in ((u, u), (u, v), (v, v))]
    heights = np.sum(bends * normal[:, None], axis=2)
    slopes = np.zeros((len(jet), 6, 5, 3))
    slopes[:, 0, 0], slopes[:, 1, 0], slopes[:, 1, 1], slopes[:, 2, 1] = 2 * u, v, u, 2 * v
    slopes[:, 3:, 0] = np.cross(v[:, None], bends)
    slopes[:, 3:, 1] = np.cross(bends, u[:, None])
    for k in range(3):
        slopes[:, 3 + k, 2 + k] = normal
    return _Forms(np.concatenate([np.stack(products, axis=1), heights], axis=1), slopes)


_IN_P = ((2, 3, 1.0), (1, 4, -2.0), (0, 5, 1.0))
"""p as a sum of products of two forms and a factor."""


def _density(values: Vectors) -> tuple[Vectors, Vectors, Vectors]:
    """Give p²/(4 W⁵), its slope (P, 6) and its curvature (P, 6, 6) by the forms (P, 6)."""
    count = len(values)
    p, by_p, twice = np.zeros(count), np.zeros((count, 6)), np.zeros((6, 6))
    for i, j, factor in _IN_P:
        p += factor * values[:, i] * values[:, j]
        by_p[:, i], by_p[:, j] = factor * values[:, j], factor * values[:, i]
        twice[i, j] = twice[j, i] = factor
    w = values[:, 0] * values[:, 2] - values[:, 1] ** 2
    by_w, bent = np.zeros((count, 6)), np.zeros((6, 6))
    by_w[:, 0], by_w[:, 1], by_w[:, 2] = values[:, 2], -2 * values[:, 1], values[:, 0]
    bent[0, 2], bent[2, 0], bent[1, 1] = 1.0, 1.0, -2.0
    # f = p² w^(−5/2)/4
    root = w**-2.5 / 4
    f_p, f_w = 2 * p * root, -2.5 * p**2 * root / w
    slope = f_p[:, None] * by_p + f_w[:, None] * by_w
    f_pw, f_ww = -5 * p * root / w, 8.75 * p**2 * root / w**2
    mixed = by_p[:, :, None] * by_w[:, None, :]
    curvature = (
        (2 * root)[:, None, None] * by_p[:, :, None] * by_p[:, None, :]
        + f_pw[:, None, None] * (mixed + np.swapaxes(mixed, 1, 2))
        + f_ww[:, None, None] * by_w[:, :, None] * by_w[:, None, :]
        + f_p[:, None, None] * twice
        + f_w[:, None, None] * bent
    )
    return p**2 * root, slope, curvature


@dataclass(frozen=True)
class FabricBending:
    """Fabric that resists mean curvature (docs/theory.md, eq. (13)).

    Attributes
    ----------
    alpha : float
        α = t²/(6R²(1−ν²)), stiffness in units of E_f t R².
    """

    alpha: float

    def energy(self, jet: Vectors, area: Vectors) -> float:
        """α ∫ H² dA over points with derivatives (P, 5, 3) and weights du dv (P,)."""
        return self.alpha * float(area @ _density(_forms(jet).values)[0])

    def derivatives(
        self, jet: Vectors, area: Vectors, maps: Vectors
    ) -> tuple[float, Vectors, Vectors]:
        """Energy, gradient (n,) and Hessian (n, n) in unknowns q with ``jet = maps @ q``.

        Parameters
        ----------
        jet : array (P, 5, 3)
            x_u, x_v, x_uu, x_uv and x_vv.
        area : array (P,)
            Weights du dv.
        maps : array (P, 5, 3, n)
        """
        points, n = len(area), maps.shape[-1]
        forms = _forms(jet)
        value, slope, curvature = _density(forms.values)
        weight = self.alpha * area
        slopes = forms.slopes.reshape(points, 6, 15)
        by_jet = (slope[:, None, :] @ slopes)[:, 0]
        hessian = np.swapaxes(slopes, 1, 2) @ curvature @ slopes
        hessian += forms.turned(slope, jet).reshape(points, 15, 15)
        listed = maps.reshape(points, 15, n)
        weighted = (weight[:, None, None] * hessian) @ listed
        flat = maps.reshape(-1, n)
        total = flat.T @ weighted.reshape(-1, n)
        gradient = (weight[:, None] * by_jet).ravel() @ flat
        return float(weight @ value), gradient, (total + total.T) / 2


def finest_wrinkle(stress: float, alpha: float) -> float:
    """Wave number, in units of 1/R, above which fabric of a principal stress cannot buckle.

    A wave of number k and small height w gains w² k² σ/2 from a compressive stress σ and pays
    α w² k⁴/4 for its curvature. Infinite where nothing resists bending.
    """
    compression = max(0.0, -stress)
    if compression == 0:
        return 0.0
    return math.sqrt(2 * compression / alpha) if alpha > 0 else math.inf


def gauss_integral(jet: Vectors, area: Vectors) -> float:
    """∫ K dA (docs/theory.md, eq. (15)) over points with derivatives (P, 5, 3), weights (P,)."""
    e, f, g, along, mixed, across = _forms(jet).values.T
    return float(area @ ((along * across - mixed**2) / (e * g - f * f) ** 1.5))
