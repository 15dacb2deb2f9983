"""What every family of elements offers to the assembly."""

from __future__ import annotations

from enum import Enum, auto
from typing import Protocol, Self, runtime_checkable

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]


class Curvature(Enum):
    """Which second derivatives an element gives.

    ``CONVEX`` leaves out what can be negative, element by element, so that the sum is positive
    semidefinite: a direction of descent far from a minimum. ``STEADY`` adds some of the stiffness
    that wrinkled fabric would have when taut: a step that forgets it overshoots.
    """

    TRUE = auto()
    CONVEX = auto()
    STEADY = auto()


class Elements(Protocol):
    """A family of m elements, each of them a function of the positions of a vertices."""

    @property
    def vertices(self) -> Indices:
        """Vertices (m, a) of each element, all different."""
        ...

    def part(self, rows: Indices) -> Self:
        """Give the elements in these rows."""
        ...

    def energies(self, corners: Vectors) -> Vectors:
        """Energy (m,) of each element at its corners' positions (m, a, 3)."""
        ...

    def derivatives(
        self, corners: Vectors, curvature: Curvature
    ) -> tuple[Vectors, Vectors, Vectors]:
        """Energies (m,), gradients (m, 3a) and Hessians (m, 3a, 3a)."""
        ...


@runtime_checkable
class Stretching(Protocol):
    """A family whose energy is a function of stretches, which grow with the square of a turn."""

    def excess(self, corners: Vectors, move: Vectors, reached: Vectors) -> Vectors:
        """Pulls (m, 3a) of the stretch that a move brings beyond what is linear in it.

        Parameters
        ----------
        corners, move : array (m, a, 3)
            Where the elements were, and where they were meant to go from there.
        reached : array (m, a, 3)
            Where they are; the pulls act along their stretches' slopes at ``corners``.
        """
        ...
