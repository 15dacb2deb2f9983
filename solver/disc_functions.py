"""Smooth functions on the unit disc: r^m P_k^(0,m)(2r² − 1) times cos mθ or sin mθ.

They are Zernike's polynomials: polynomials in x and y of degree m + 2k, orthogonal over the disc.
Here they are scaled so that the mean of the square over the disc is 1.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.special import eval_jacobi

Vectors = NDArray[np.float64]
Trig = Literal["cos", "sin"]


@dataclass(frozen=True, slots=True)
class DiscFunction:
    """One function; ``m`` ≥ 0 waves around the disc, ``k`` ≥ 0 zeros along the radius.

    That of docs/theory.md, eq. (7), or its sine.
    """

    m: int
    k: int
    trig: Trig

    @property
    def degree(self) -> int:
        """Degree of the polynomial."""
        return self.m + 2 * self.k

    @property
    def edge_value(self) -> float:
        """Radial factor at the edge, r = 1, where P_k^(0,m) is 1."""
        return math.sqrt((1 if self.m == 0 else 2) * (self.degree + 1))

    def radial(self, r: Vectors) -> tuple[Vectors, Vectors]:
        """Radial factor and its derivative at ``r``, scaled to mean square 1 over the disc."""
        m, k = self.m, self.k
        norm = self.edge_value
        x = 2 * r * r - 1
        jacobi = eval_jacobi(k, 0, m, x)
        # d/dx P_k^(a,b) = (k+a+b+1)/2 P_(k-1)^(a+1,b+1)   (DLMF 18.9.15)
        slope = (k + m + 1) / 2 * eval_jacobi(k - 1, 1, m + 1, x) if k > 0 else np.zeros_like(x)
        power = r**m
        power_slope = m * r ** (m - 1) if m > 0 else np.zeros_like(r)
        return norm * power * jacobi, norm * (power_slope * jacobi + power * slope * 4 * r)

    def radial_curvature(self, r: Vectors) -> Vectors:
        """Second derivative of the radial factor at 0 < r < 1.

        By Zernike's equation for degree n, (1 − r²) R″ + (1/r − 3r) R′ + (n(n+2) − m²/r²) R = 0
        (Bhatia and Wolf, Proc. Camb. Phil. Soc. 50 (1954) 40).
        """
        radial, slope = self.radial(r)
        n, m = self.degree, self.m
        rest = (1 / r - 3 * r) * slope + (n * (n + 2) - (m / r) ** 2) * radial
        return -rest / (1 - r * r)

    def angular(self, theta: Vectors, derivative: int = 0) -> Vectors:
        """Angular factor, or its first to third derivative, at angles ``theta``."""
        quarter_turns = derivative + (0 if self.trig == "cos" else 3)
        return self.m**derivative * np.cos(self.m * theta + quarter_turns * np.pi / 2)

    def value(self, r: Vectors, theta: Vectors) -> Vectors:
        """Values at polar coordinates."""
        return self.radial(r)[0] * self.angular(theta)

    def gradient(self, r: Vectors, theta: Vectors) -> tuple[Vectors, Vectors]:
        """Derivatives along x and y at polar coordinates, r > 0."""
        radial, slope = self.radial(r)
        along_r = slope * self.angular(theta)
        along_theta = radial / r * self.angular(theta, 1)
        c, s = np.cos(theta), np.sin(theta)
        return c * along_r - s * along_theta, s * along_r + c * along_theta

    def second(self, r: Vectors, theta: Vectors) -> tuple[Vectors, Vectors, Vectors]:
        """Second derivatives by xx, xy and yy at polar coordinates, 0 < r < 1."""
        radial, slope = self.radial(r)
        along = self.radial_curvature(r) * self.angular(theta)
        mixed = (slope / r - radial / r**2) * self.angular(theta, 1)
        across = slope / r * self.angular(theta) + radial / r**2 * self.angular(theta, 2)
        c, s = np.cos(theta), np.sin(theta)
        both = 2 * c * s * mixed
        return (
            c * c * along - both + s * s * across,
            c * s * (along - across) + (c * c - s * s) * mixed,
            s * s * along + both + c * c * across,
        )
