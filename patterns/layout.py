"""Where the loops lie on the stretched fabric, and which of them touch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from patterns.errors import PatternError

TANGENCY_TOLERANCE_MM = 1e-6
"""Two loops touch when the distance of their centres is the sum of their radii to within this."""


@dataclass(frozen=True, slots=True)
class Loop:
    """One circle of wire, in the stretched plane.

    Attributes
    ----------
    x_mm, y_mm : float
        Centre; y points away from the operator.
    diameter_mm : float
        Diameter of the wire's centreline.
    """

    x_mm: float
    y_mm: float
    diameter_mm: float

    @property
    def radius_mm(self) -> float:
        """Radius of the wire's centreline."""
        return self.diameter_mm / 2


@dataclass(frozen=True, slots=True)
class Contact:
    """A point in which two loops touch from outside.

    Attributes
    ----------
    first, second : int
        Indices into `Layout.loops`, ``first < second``.
    x_mm, y_mm : float
        The touching point.
    """

    first: int
    second: int
    x_mm: float
    y_mm: float


@dataclass(frozen=True, slots=True)
class Layout:
    """Loops and the points in which they touch; made by `tangent_layout`."""

    loops: tuple[Loop, ...]
    contacts: tuple[Contact, ...]


def tangent_layout(loops: tuple[Loop, ...]) -> Layout:
    """Find the contacts of a set of loops.

    Raises
    ------
    PatternError
        When two loops overlap; the message names the pair and the distance of their centres.
    """
    centre = np.array([(loop.x_mm, loop.y_mm) for loop in loops])
    radius = np.array([loop.radius_mm for loop in loops])
    contacts: list[Contact] = []
    for i in range(len(loops)):
        distance = np.hypot(*(centre[i + 1 :] - centre[i]).T)
        gap = distance - radius[i] - radius[i + 1 :]
        if np.any(gap < -TANGENCY_TOLERANCE_MM):
            j = i + 1 + int(np.argmin(gap))
            raise PatternError(
                f"loops {i} and {j} overlap: their centres are {distance[j - i - 1]:.6g} mm apart, "
                f"and their radii add up to {radius[i] + radius[j]:.6g} mm"
            )
        for j in i + 1 + np.flatnonzero(gap <= TANGENCY_TOLERANCE_MM):
            x, y = centre[i] + (centre[j] - centre[i]) * radius[i] / (radius[i] + radius[j])
            contacts.append(Contact(i, int(j), float(x), float(y)))
    return Layout(loops, tuple(contacts))
