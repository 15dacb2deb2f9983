"""Functions of the lengths of two vectors and of their product, and their derivatives.

Bending of a wire and the bond of two tangents are both of this kind.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.float64]


@dataclass(frozen=True)
class TurnFunction:
    """Values (m,) and derivatives of f(p, q, d) with p = |u|, q = |v|, d = u·v; f_dd = 0."""

    f: Vectors
    f_p: Vectors
    f_q: Vectors
    f_d: Vectors
    f_pp: Vectors
    f_pq: Vectors
    f_qq: Vectors
    f_pd: Vectors
    f_qd: Vectors


@dataclass(frozen=True)
class Turn:
    """Pairs of vectors u, v (m, 3) and their invariants."""

    u: Vectors
    v: Vectors

    def invariants(self) -> tuple[Vectors, Vectors, Vectors]:
        """Give |u|, |v| and u·v, each (m,)."""
        p, q = np.linalg.norm(self.u, axis=1), np.linalg.norm(self.v, axis=1)
        return p, q, np.sum(self.u * self.v, axis=1)

    def derivatives(self, of: TurnFunction) -> tuple[Vectors, Vectors]:
        """Gradient (m, 6) and Hessian (m, 6, 6) by the components of u and v."""
        p, q, _ = self.invariants()
        m = len(p)
        slopes = np.zeros((m, 3, 6))  # of p, q and d
        slopes[:, 0, :3] = self.u / p[:, None]
        slopes[:, 1, 3:] = self.v / q[:, None]
        slopes[:, 2, :3], slopes[:, 2, 3:] = self.v, self.u
        first = np.stack([of.f_p, of.f_q, of.f_d], axis=1)
        gradient = (first[:, None, :] @ slopes)[:, 0]
        second = np.zeros((m, 3, 3))
        second[:, 0, 0], second[:, 1, 1] = of.f_pp, of.f_qq
        second[:, 0, 1] = second[:, 1, 0] = of.f_pq
        second[:, 0, 2] = second[:, 2, 0] = of.f_pd
        second[:, 1, 2] = second[:, 2, 1] = of.f_qd
        # a length's own Hessian is (1 − û ûᵀ)/p, that of the product couples u with v
        second[:, 0, 0] -= of.f_p / p
        second[:, 1, 1] -= of.f_q / q
        hessian = np.swapaxes(slopes, 1, 2) @ second @ slopes
        for c in range(3):
            hessian[:, c, c] += of.f_p / p
            hessian[:, 3 + c, 3 + c] += of.f_q / q
            hessian[:, c, 3 + c] += of.f_d
            hessian[:, 3 + c, c] += of.f_d
        return gradient, hessian


def convex_part(hessians: Vectors) -> Vectors:
    """Symmetric matrices (m, n, n) with their negative eigenvalues set to 0."""
    values, modes = np.linalg.eigh(hessians)
    return (modes * np.maximum(values, 0)[:, None, :]) @ np.swapaxes(modes, 1, 2)
