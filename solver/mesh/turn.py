"""Functions of the angle between two vectors and of their lengths, and their derivatives.

Bending of a wire and the bond of two tangents are both of this kind.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.float64]


@dataclass(frozen=True)
class TurnFunction:
    """Values (m,) and derivatives of f(c, s), c the cosine of the angle, s the sum of lengths."""

    f: Vectors
    f_c: Vectors
    f_s: Vectors
    f_cc: Vectors
    f_cs: Vectors
    f_ss: Vectors


@dataclass(frozen=True)
class Turn:
    """Pairs of vectors u, v (m, 3)."""

    u: Vectors
    v: Vectors

    def lengths(self) -> tuple[Vectors, Vectors]:
        """Give |u| and |v|, each (m,)."""
        return np.linalg.norm(self.u, axis=1), np.linalg.norm(self.v, axis=1)

    def invariants(self) -> tuple[Vectors, Vectors]:
        """Cosine of the angle between u and v, and |u| + |v|, each (m,)."""
        p, q = self.lengths()
        return np.sum(self.u * self.v, axis=1) / (p * q), p + q

    def angle(self) -> Vectors:
        """Angle (m,) between u and v; the arc cosine would lose the digits of small ones."""
        across = np.linalg.norm(np.cross(self.u, self.v), axis=1)
        return np.arctan2(across, np.sum(self.u * self.v, axis=1))

    def derivatives(self, of: TurnFunction) -> tuple[Vectors, Vectors]:
        """Gradient (m, 6) and Hessian (m, 6, 6) by the components of u and v."""
        p, q = self.lengths()
        c, _ = self.invariants()
        first, second = _by_lengths_and_product(of, p, q, c)
        slopes = np.zeros((len(p), 3, 6))
        slopes[:, 0, :3] = self.u / p[:, None]
        slopes[:, 1, 3:] = self.v / q[:, None]
        slopes[:, 2, :3], slopes[:, 2, 3:] = self.v, self.u
        gradient = (first[:, None, :] @ slopes)[:, 0]
        # a length's own Hessian is (1 − û ûᵀ)/p, that of the product couples u with v
        second[:, 0, 0] -= first[:, 0] / p
        second[:, 1, 1] -= first[:, 1] / q
        hessian = np.swapaxes(slopes, 1, 2) @ second @ slopes
        for k in range(3):
            hessian[:, k, k] += first[:, 0] / p
            hessian[:, 3 + k, 3 + k] += first[:, 1] / q
            hessian[:, k, 3 + k] += first[:, 2]
            hessian[:, 3 + k, k] += first[:, 2]
        return gradient, hessian


def _by_lengths_and_product(
    of: TurnFunction, p: Vectors, q: Vectors, c: Vectors
) -> tuple[Vectors, Vectors]:
    """First (m, 3) and second (m, 3, 3) derivatives of f by p = |u|, q = |v| and d = u·v."""
    zero, one = np.zeros_like(p), np.ones_like(p)
    c_1 = np.stack([-c / p, -c / q, 1 / (p * q)], axis=1)
    s_1 = np.stack([one, one, zero], axis=1)
    c_2 = np.stack(
        [
            np.stack([2 * c / p**2, c / (p * q), -1 / (p * p * q)], axis=1),
            np.stack([c / (p * q), 2 * c / q**2, -1 / (p * q * q)], axis=1),
            np.stack([-1 / (p * p * q), -1 / (p * q * q), zero], axis=1),
        ],
        axis=1,
    )
    first = of.f_c[:, None] * c_1 + of.f_s[:, None] * s_1
    mixed = c_1[:, :, None] * s_1[:, None, :]
    second = (
        of.f_c[:, None, None] * c_2
        + of.f_cc[:, None, None] * c_1[:, :, None] * c_1[:, None, :]
        + of.f_cs[:, None, None] * (mixed + np.swapaxes(mixed, 1, 2))
        + of.f_ss[:, None, None] * s_1[:, :, None] * s_1[:, None, :]
    )
    return first, second


def convex_part(hessians: Vectors) -> Vectors:
    """Symmetric matrices (m, n, n) with their negative eigenvalues set to 0."""
    values, modes = np.linalg.eigh(hessians)
    return (modes * np.maximum(values, 0)[:, None, :]) @ np.swapaxes(modes, 1, 2)
