"""The fabric's energy in a small space of shapes, as the polynomial that it is.

On isotropic fabric in a circular loop the energy is a polynomial of the fourth degree in the
unknowns. With C = Fᵀ F, s = 1 + ε and w = a Tr E² + b (Tr E)², E = (s² C − I)/2,

    ∫ w dA0 = s²/4 (a ∫ Tr C² dA + b ∫ (Tr C)² dA) − (a/2 + b) ∫ Tr C dA + π (a/2 + b)/s².

The three integrals are tabulated once as symmetric tensors; what a scene costs after that is a
product of a matrix and a vector, or of two matrices for many shapes at once.

Unknowns move points in the plane or along z, and C is the sum of what either do alone. So half of
the tensors' entries are 0: a derivative by two unknowns of one kind holds no product of two kinds,
and the other way round.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from solver.disc_basis import DiscBasis

Vectors = NDArray[np.float64]
_Pairs = tuple[NDArray[np.intp], NDArray[np.intp]]

LARGEST = 24
"""With more unknowns the tensor takes more time than the integration that it replaces."""


@dataclass(frozen=True, eq=False)
class QuarticTable:
    """Second derivatives along m motions of the integrals above, at shapes of n unknowns.

    Attributes
    ----------
    first, second : array of int (p,)
        The p = n(n+1)/2 products q[first] q[second] in which these derivatives are linear, those of
        one kind first.
    unpack : array of int (m, m)
        Where each entry of a symmetric matrix stands in its list of m(m+1)/2 entries.
    metric : array (m, m)
        ∫ Tr C dA is k·metric·k of a motion k.
    alike, mixed : array (2r, s)
        Symmetric tensors of ∫ Tr C² dA and, below, of ∫ (Tr C)² dA, by r pairs of motions and s
        products, those of one kind and those of two.
    """

    first: NDArray[np.intp]
    second: NDArray[np.intp]
    unpack: NDArray[np.intp]
    metric: Vectors
    alike: Vectors
    mixed: Vectors

    def applied(self, q: Vectors, shear: Vectors, swell: Vectors) -> Vectors:
        """Tensor shear ∫ Tr C² dA + swell ∫ (Tr C)² dA applied twice to shapes (…, n), (…, m, m).

        The two weights are arrays (…, 1).
        """
        products = q[..., self.first] * q[..., self.second]
        count = self.alike.shape[1]
        parts: list[Vectors] = []
        for own, tensors in (
            (products[..., :count], self.alike),
            (products[..., count:], self.mixed),
        ):
            listed, rows = own @ tensors.T, len(tensors) // 2
            parts.append(shear * listed[..., :rows] + swell * listed[..., rows:])
        return np.concatenate(parts, axis=-1)[..., self.unpack]


def _cauchy_green(left: Vectors, right: Vectors) -> Vectors:
    """C11, C22 and √2 C12 (P, 3, k, l) of two shapes each, from gradients (P, 3, 2, ·)."""
    product = np.einsum("pcik,pcjl->pijkl", left, right, optimize=True)
    both = (product[:, 0, 1] + product[:, 1, 0]) / np.sqrt(2)
    return np.stack([product[:, 0, 0], product[:, 1, 1], both], axis=1)


def _pairs(gradient: Vectors) -> tuple[_Pairs, _Pairs]:
    """Pairs i ≤ j of unknowns with gradients (P, 3, 2, n): those of one kind, those of two."""
    rises = np.abs(gradient[:, 2]).max(axis=(0, 1)) > 0
    i, j = np.triu_indices(len(rises))
    mixed = rises[i] != rises[j]
    return (i[~mixed], j[~mixed]), (i[mixed], j[mixed])


def _symmetric(
    own: Vectors,
    cross: Vectors,
    other: Vectors,
    weight: Vectors,
    pairs: Iterable[tuple[_Pairs, _Pairs]],
) -> Iterator[Vectors]:
    """Symmetric tensors of ∫ D·D from D (P, d, m, m), (P, d, m, n) and (P, d, n, n).

    Rows are pairs i ≤ j of motions, columns pairs k ≤ l of shapes. A product of different
    coefficients stands for two.
    """
    m, n = cross.shape[-2:]
    weighted = weight[:, None, None]
    scaled = (np.sqrt(weighted)[..., None] * cross).reshape(-1, m * n)
    crossed = (scaled.T @ scaled).reshape(m, n, m, n)
    for (i, j), (first, second) in pairs:
        listed = (weighted * other[..., first, second]).reshape(-1, len(first))
        straight = own[..., i, j].reshape(-1, len(i)).T @ listed
        left, right = i[:, None], j[:, None]
        turned = crossed[left, first, right, second] + crossed[left, second, right, first]
        yield (straight + turned) * np.where(first == second, 1 / 3, 2 / 3)


def tabulate(motions: Vectors, shapes: Vectors, area: Vectors) -> QuarticTable:
    """Tabulate the integrals for m motions around shapes of n unknowns.

    Parameters
    ----------
    motions : array (P, 3, 2, m)
        Derivatives of the position along x and y at P points.
    shapes : array (P, 3, 2, n)
    area : array (P,)
    """
    m = motions.shape[-1]
    pairs = [
        _cauchy_green(motions, motions),
        _cauchy_green(motions, shapes),
        _cauchy_green(shapes, shapes),
    ]
    pairs[0] = (pairs[0] + np.swapaxes(pairs[0], -1, -2)) / 2
    pairs[2] = (pairs[2] + np.swapaxes(pairs[2], -1, -2)) / 2
    traces = [pair[:, :1] + pair[:, 1:2] for pair in pairs]
    rows, columns = _pairs(motions), _pairs(shapes)
    (i, j), (first, second) = (np.concatenate(kinds, axis=1) for kinds in (rows, columns))
    unpack = np.zeros((m, m), dtype=np.intp)
    unpack[i, j] = unpack[j, i] = np.arange(len(i))
    shear, swell = (
        _symmetric(own, cross, other, area, zip(rows, columns, strict=True))
        for own, cross, other in (pairs, traces)
    )
    alike, mixed = (np.concatenate(both) for both in zip(shear, swell, strict=True))
    return QuarticTable(
        first=first,
        second=second,
        unpack=unpack,
        metric=np.einsum("p,pkl->kl", area, traces[0][:, 0]),
        alike=alike,
        mixed=mixed,
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
        scale = (1 + self.strain) ** 2 / 4
        shear, swell = (np.asarray(scale * weight)[..., None] for weight in (self.a, self.b))
        return self.table.applied(q, shear, swell)

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
