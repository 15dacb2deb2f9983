"""The fabric's energy in a small space of shapes, as the polynomial that it is.

On isotropic fabric in a circular loop the energy is a polynomial of the fourth degree in the
unknowns. With C = Fᵀ F, s = 1 + ε and w = a Tr E² + b (Tr E)², E = (s² C − I)/2,

    ∫ w dA0 = s²/4 (a ∫ Tr C² dA + b ∫ (Tr C)² dA) − (a/2 + b) ∫ Tr C dA + π (a/2 + b)/s².

The three integrals are tabulated once as symmetric tensors; what a scene costs after that is a
product of a matrix and a vector, or of two matrices for many shapes at once.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from solver.disc_basis import DiscBasis

Vectors = NDArray[np.float64]

LARGEST = 24
"""With more unknowns the tensor takes more time than the integration that it replaces."""


@dataclass(frozen=True, eq=False)
class QuarticTable:
    """Second derivatives along m motions of the integrals above, at shapes of n unknowns.

    Attributes
    ----------
    first, second : array of int (p,)
        The p = n(n+1)/2 products q[first] q[second] in which these derivatives are linear.
    twice : array (p,)
        2 where the factors differ, else 1.
    unpack : array of int (m, m)
        Where each entry of a symmetric matrix stands in its list of m(m+1)/2 entries.
    metric : array (m, m)
        ∫ Tr C dA is k·metric·k of a motion k.
    tensors : array (m(m+1), p)
        Symmetric tensors of ∫ Tr C² dA and, below, of ∫ (Tr C)² dA.
    """

    first: NDArray[np.intp]
    second: NDArray[np.intp]
    twice: Vectors
    unpack: NDArray[np.intp]
    metric: Vectors
    tensors: Vectors

    def products(self, q: Vectors) -> Vectors:
        """Products (…, p) of the coefficients (…, n) of a shape."""
        return q[..., self.first] * q[..., self.second] * self.twice


def _cauchy_green(left: Vectors, right: Vectors) -> Vectors:
    """C11, C22 and √2 C12 (P, 3, k, l) of two shapes each, from gradients (P, 3, 2, ·)."""
    product = np.einsum("pcik,pcjl->pijkl", left, right, optimize=True)
    both = (product[:, 0, 1] + product[:, 1, 0]) / np.sqrt(2)
    return np.stack([product[:, 0, 0], product[:, 1, 1], both], axis=1)


def _symmetric(own: Vectors, cross: Vectors, other: Vectors, weight: Vectors) -> Vectors:
    """Symmetric tensor of ∫ D·D from D (P, d, m, m), (P, d, m, n) and (P, d, n, n), by pairs.

    Rows are the pairs i ≤ j of motions, columns the pairs k ≤ l of shapes.
    """
    m, n = cross.shape[-2:]
    (i, j), (first, second) = np.triu_indices(m), np.triu_indices(n)
    weighted = weight[:, None, None]
    listed = (weighted * other[..., first, second]).reshape(-1, len(first))
    straight = own[..., i, j].reshape(-1, len(i)).T @ listed
    scaled = (np.sqrt(weighted)[..., None] * cross).reshape(-1, m * n)
    crossed = (scaled.T @ scaled).reshape(m, n, m, n)
    left, right = i[:, None], j[:, None]
    pairs = crossed[left, first, right, second] + crossed[left, second, right, first]
    return (straight + pairs) / 3


def tabulate(motions: Vectors, shapes: Vectors, area: Vectors) -> QuarticTable:
    """Tabulate the integrals for m motions around shapes of n unknowns.

    Parameters
    ----------
    motions : array (P, 3, 2, m)
        Derivatives of the position along x and y at P points.
    shapes : array (P, 3, 2, n)
    area : array (P,)
    """
    m, n = motions.shape[-1], shapes.shape[-1]
    pairs = [
        _cauchy_green(motions, motions),
        _cauchy_green(motions, shapes),
        _cauchy_green(shapes, shapes),
    ]
    pairs[0] = (pairs[0] + np.swapaxes(pairs[0], -1, -2)) / 2
    pairs[2] = (pairs[2] + np.swapaxes(pairs[2], -1, -2)) / 2
    traces = [pair[:, :1] + pair[:, 1:2] for pair in pairs]
    first, second = np.triu_indices(n)
    rows = np.triu_indices(m)
    unpack = np.zeros((m, m), dtype=np.intp)
    unpack[rows] = np.arange(len(rows[0]))
    unpack = np.maximum(unpack, unpack.T)
    tensors = [_symmetric(own, cross, other, area) for own, cross, other in (pairs, traces)]
    return QuarticTable(
        first=first,
        second=second,
        twice=np.where(first == second, 1.0, 2.0),
        unpack=unpack,
        metric=np.einsum("p,pkl->kl", area, traces[0][:, 0]),
        tensors=np.concatenate(tensors),
    )


@lru_cache(maxsize=16)
def shape_table(basis: DiscBasis) -> QuarticTable:
    """Give the table of the shapes of a basis themselves."""
    return tabulate(basis.gradient, basis.gradient, basis.area)


@dataclass(frozen=True, eq=False)
class FabricPolynomial:
    """The energy of one fabric, or of many, as a polynomial.

    Attributes
    ----------
    table : QuarticTable
    strain, a, b : float or array (B,)
        As those of `solver.membrane.Membrane`.
    """

    table: QuarticTable
    strain: float | Vectors
    a: float | Vectors
    b: float | Vectors

    def _quartic(self, q: Vectors) -> Vectors:
        """The symmetric tensor applied twice to q, (…, m, m)."""
        table = self.table
        scale = (1 + self.strain) ** 2 / 4
        listed = table.products(q) @ table.tensors.T
        half = listed.shape[-1] // 2
        weighted = np.asarray(scale * self.a)[..., None] * listed[..., :half]
        weighted += np.asarray(scale * self.b)[..., None] * listed[..., half:]
        return weighted[..., table.unpack]

    def hessian(self, q: Vectors) -> Vectors:
        """Second derivatives (…, m, m) along the motions, at shapes q (…, n)."""
        return 12 * self._quartic(q) - self._linear() * self.table.metric

    def _linear(self) -> Vectors:
        return np.asarray(self.a + 2 * self.b)[..., None, None]

    def derivatives(self, q: Vectors) -> tuple[Vectors, Vectors, Vectors]:
        """Energy (…,), gradient (…, n) and Hessian (…, n, n) of shapes q (…, n)."""
        half = self.a / 2 + self.b
        quartic = self._quartic(q)
        metric = self._linear() * self.table.metric
        by_quartic = (quartic @ q[..., None])[..., 0]
        by_metric = (metric @ q[..., None])[..., 0]
        rest = np.pi * half / (1 + self.strain) ** 2
        value = np.sum(q * (by_quartic - by_metric / 2), axis=-1) + rest
        return value, 4 * by_quartic - by_metric, 12 * quartic - metric
