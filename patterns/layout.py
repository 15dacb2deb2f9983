"""Where the loops lie on the stretched fabric, and which of them touch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from patterns.errors import PatternError

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

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
    centre = np.array([(loop.x_mm, loop.y_mm) for loop in loops]).reshape(-1, 2)
    radius = np.array([loop.radius_mm for loop in loops])
    i, j = _neighbours(centre, radius)
    distance = np.hypot(*(centre[j] - centre[i]).T)
    gap = distance - radius[i] - radius[j]
    if np.any(gap < -TANGENCY_TOLERANCE_MM):
        k = int(np.argmin(gap))
        raise PatternError(
            f"loops {i[k]} and {j[k]} overlap: their centres are {distance[k]:.6g} mm apart, "
            f"and their radii add up to {radius[i[k]] + radius[j[k]]:.6g} mm"
        )
    near = gap <= TANGENCY_TOLERANCE_MM
    i, j = i[near], j[near]
    point = centre[i] + (centre[j] - centre[i]) * (radius[i] / (radius[i] + radius[j]))[:, None]
    return Layout(
        loops,
        tuple(
            Contact(int(a), int(b), float(x), float(y))
            for a, b, (x, y) in zip(i, j, point, strict=True)
        ),
    )


def _neighbours(centre: Floats, radius: Floats) -> tuple[Indices, Indices]:
    """Pairs of loops (first < second, in order) whose bounding boxes come together."""
    half = (radius + TANGENCY_TOLERANCE_MM)[:, None]
    boxes = shapely.box(*(centre - half).T, *(centre + half).T)
    i, j = shapely.STRtree(boxes).query(boxes)
    i, j = i[i < j], j[i < j]
    order = np.lexsort((j, i))
    return i[order], j[order]
