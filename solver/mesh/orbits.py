"""Of elements that mirror each other, one that counts for all."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from solver.mesh.elements import Curvature, Elements, Stretching
from solver.mesh.mirror import Mirrors

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True)
class CountedElements:
    """Elements of which each counts several times.

    Attributes
    ----------
    elements : Elements
    counts : array (m,)
        For how many each of them stands.
    """

    elements: Elements
    counts: Vectors

    @property
    def vertices(self) -> Indices:
        """Vertices (m, a) of each element."""
        return self.elements.vertices

    def part(self, rows: Indices) -> Self:
        """Give the elements in these rows."""
        return type(self)(self.elements.part(rows), self.counts[rows])

    def energies(self, corners: Vectors) -> Vectors:
        """Energy (m,) of all for which each element stands."""
        return self.counts * self.elements.energies(corners)

    def derivatives(
        self, corners: Vectors, curvature: Curvature
    ) -> tuple[Vectors, Vectors, Vectors]:
        """Energies (m,), gradients (m, 3a) and Hessians (m, 3a, 3a), times the counts."""
        energies, gradients, hessians = self.elements.derivatives(corners, curvature)
        once = self.counts[:, None]
        return self.counts * energies, once * gradients, once[:, None] * hessians

    def excess(self, corners: Vectors, move: Vectors, reached: Vectors) -> Vectors:
        """Pulls (m, 3a), times the counts; see `solver.mesh.elements.Stretching`."""
        if not isinstance(self.elements, Stretching):
            return np.zeros((len(corners), corners[0].size))
        return self.counts[:, None] * self.elements.excess(corners, move, reached)


def one_of_each(elements: Elements, mirrors: Mirrors) -> CountedElements:
    """Elements of which none is another's image, each counting for its images too.

    Raises
    ------
    ValueError
        When an image of an element is no element.
    """
    # a sum of random numbers of its vertices tells an element, in whatever order they stand
    numbers = np.random.default_rng(0).integers(2**62, size=mirrors.images.shape[1])
    first, second = mirrors.images
    ways = (np.arange(len(first)), first, second, first[second])
    names = np.stack([numbers[way[elements.vertices]].sum(axis=1) for way in ways])
    chosen = np.flatnonzero(names[0] == names.min(axis=0))
    ordered = np.sort(names[:, chosen], axis=0)
    counts = 1 + np.count_nonzero(np.diff(ordered, axis=0), axis=0)
    if counts.sum() != len(elements.vertices):
        raise ValueError("the image of an element is no element")
    return CountedElements(elements.part(chosen), counts.astype(np.float64))
