"""Energy of the wire: bending by its curvature, and a stiff stretch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.float64]


@dataclass(frozen=True)
class Rod:
    """A wire along a curve x(s), s being arclength when it is not stretched.

    Bending energy β ∮ κ² dl and stretch energy (k/2) ∮ (|x'| − 1)² ds.
    """

    beta: float
    axial_stiffness: float

    def _densities(self, a: Vectors, b: Vectors, c: Vectors) -> tuple[Vectors, Vectors]:
        """Bending and stretch energy per unit of s; a = x'·x', b = x''·x'', c = x'·x''.

        κ² dl/ds = |x' × x''|² / |x'|⁵ = (a b − c²) a^(−5/2).
        """
        bending = self.beta * (a * b - c * c) * a**-2.5
        return bending, self.axial_stiffness / 2 * (np.sqrt(a) - 1) ** 2

    def energies(self, tangent: Vectors, second: Vectors, arc: Vectors) -> tuple[float, float]:
        """Bending and stretch energy of points with derivatives (Q, 3) and weights (Q,)."""
        bending, stretch = self._densities(*_invariants(tangent, second))
        return float(arc @ bending), float(arc @ stretch)

    def derivatives(
        self,
        tangent: Vectors,
        second: Vectors,
        arc: Vectors,
        tangent_map: Vectors,
        second_map: Vectors,
    ) -> tuple[float, Vectors, Vectors]:
        """Energy, gradient (n,) and Hessian (n, n) in unknowns that move the derivatives linearly.

        Parameters
        ----------
        tangent, second : array (Q, 3)
        arc : array (Q,)
        tangent_map, second_map : array (Q, 3, n)
        """
        n = tangent_map.shape[-1]
        a, b, c = _invariants(tangent, second)
        beta, k = self.beta, self.axial_stiffness
        # first and second derivatives of the densities by the invariants
        f_a = beta * (-1.5 * b * a**-2.5 + 2.5 * c * c * a**-3.5) + k / 2 * (1 - a**-0.5)
        f_b = beta * a**-1.5
        f_c = -2 * beta * c * a**-2.5
        f_aa = beta * (3.75 * b * a**-3.5 - 8.75 * c * c * a**-4.5) + k / 4 * a**-1.5
        f_ab = -1.5 * beta * a**-2.5
        f_ac = 5 * beta * c * a**-3.5
        f_cc = -2 * beta * a**-2.5
        # slopes of the invariants, each (Q, n)
        a_q = 2 * np.einsum("qc,qcn->qn", tangent, tangent_map)
        b_q = 2 * np.einsum("qc,qcn->qn", second, second_map)
        c_q = np.einsum("qc,qcn->qn", tangent, second_map)
        c_q += np.einsum("qc,qcn->qn", second, tangent_map)
        slope = (arc * f_a) @ a_q + (arc * f_b) @ b_q + (arc * f_c) @ c_q

        def product(weight: Vectors, left: Vectors, right: Vectors) -> Vectors:
            scaled = (arc * weight).reshape(-1, *(1,) * (right.ndim - 1)) * right
            return left.reshape(-1, n).T @ scaled.reshape(-1, n)

        half = (
            product(f_aa / 2, a_q, a_q)
            + product(f_ab, a_q, b_q)
            + product(f_ac, a_q, c_q)
            + product(f_cc / 2, c_q, c_q)
            + product(f_a, tangent_map, tangent_map)
            + product(f_b, second_map, second_map)
            + product(f_c, tangent_map, second_map)
        )
        return sum(self.energies(tangent, second, arc)), slope, half + half.T


def _invariants(tangent: Vectors, second: Vectors) -> tuple[Vectors, Vectors, Vectors]:
    """Give x'·x', x''·x'' and x'·x''."""
    return (
        np.sum(tangent * tangent, axis=-1),
        np.sum(second * second, axis=-1),
        np.sum(tangent * second, axis=-1),
    )
