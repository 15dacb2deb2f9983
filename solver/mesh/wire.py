"""A wire as a chain of a mesh's vertices, and where it lies flat."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from solver.mesh.curve import PlaneCurve

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True)
class Track:
    """The plane curve along which a chain lies flat, and the parameter (n,) of each vertex."""

    curve: PlaneCurve
    parameters: Vectors

    @property
    def between(self) -> Vectors:
        """Parameters (e,) in the middle of each edge; round a closed curve they go on beyond 1."""
        following = np.roll(self.parameters, -1)
        if not self.curve.closed:
            return ((self.parameters + following) / 2)[:-1]
        following[-1] += 1
        return (self.parameters + following) / 2

    def refined(self) -> Track:
        """Give the same with a vertex more on each edge."""
        return Track(self.curve, interleaved(self.parameters, self.between))


def interleaved(values: NDArray[np.generic], between: NDArray[np.generic]) -> NDArray[Any]:
    """Values with those between each and the next, of which there may be one less."""
    out = np.empty(len(values) + len(between), dtype=values.dtype)
    out[::2], out[1::2] = values, between
    return out


@dataclass(frozen=True)
class Wire:
    """A wire along the edges from each vertex to the next, back to the first when closed.

    Attributes
    ----------
    vertices : array (n,)
    closed : bool
    track : Track or None
        Where it lies flat; without one its region says.
    """

    vertices: Indices
    closed: bool = True
    track: Track | None = None

    @property
    def edges(self) -> Indices:
        """Vertices (e, 2) at the ends of each edge, in the wire's order."""
        following = np.roll(self.vertices, -1)
        edges = np.stack([self.vertices, following], axis=1)
        return edges if self.closed else edges[:-1]

    @property
    def corners(self) -> Indices:
        """Vertices (c, 3) before, at and after each vertex at which the wire can bend."""
        before, after = np.roll(self.vertices, 1), np.roll(self.vertices, -1)
        corners = np.stack([before, self.vertices, after], axis=1)
        return corners if self.closed else corners[1:-1]

    def midway(self, values: Vectors) -> Vectors:
        """Values (e, d) in the middle of each edge from those at all vertices, by cubics.

        A wire's bending would feel the kinks of a linear interpolation.
        """
        along = values[self.vertices]
        if self.closed:
            before, after = np.roll(along, 1, axis=0), np.roll(along, -1, axis=0)
            return (9 * (along + after) - before - np.roll(along, -2, axis=0)) / 16
        if len(along) < 4:
            return (along[:-1] + along[1:]) / 2
        inner = (9 * (along[1:-2] + along[2:-1]) - along[:-3] - along[3:]) / 16
        first = (5 * along[:1] + 15 * along[1:2] - 5 * along[2:3] + along[3:4]) / 16
        last = (5 * along[-1:] + 15 * along[-2:-1] - 5 * along[-3:-2] + along[-4:-3]) / 16
        return np.concatenate([first, inner, last])
