"""A wire's centreline: straight lines and circular arcs, one after the other."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray
from shapely import LineString

Vectors = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Line:
    """A straight piece from (x0_mm, y0_mm) to (x1_mm, y1_mm)."""

    x0_mm: float
    y0_mm: float
    x1_mm: float
    y1_mm: float

    @property
    def length_mm(self) -> float:
        """Length of the piece."""
        return float(np.hypot(self.x1_mm - self.x0_mm, self.y1_mm - self.y0_mm))

    @property
    def curvature_per_mm(self) -> float:
        """Signed curvature: none."""
        return 0.0

    def at(self, s_mm: Vectors) -> tuple[Vectors, Vectors]:
        """Points and unit tangents, each (n, 2), at arclengths ``s_mm`` (n,)."""
        start = np.array([self.x0_mm, self.y0_mm])
        tangent = (np.array([self.x1_mm, self.y1_mm]) - start) / self.length_mm
        return start + s_mm[:, None] * tangent, np.broadcast_to(tangent, (len(s_mm), 2)).copy()


@dataclass(frozen=True, slots=True)
class Arc:
    """A circular piece; ``sweep_rad`` is positive when it runs counter-clockwise."""

    centre_x_mm: float
    centre_y_mm: float
    radius_mm: float
    start_rad: float
    sweep_rad: float

    @property
    def length_mm(self) -> float:
        """Length of the piece."""
        return self.radius_mm * abs(self.sweep_rad)

    @property
    def curvature_per_mm(self) -> float:
        """Signed curvature, positive to the left."""
        return float(np.copysign(1 / self.radius_mm, self.sweep_rad))

    def at(self, s_mm: Vectors) -> tuple[Vectors, Vectors]:
        """Points and unit tangents, each (n, 2), at arclengths ``s_mm`` (n,)."""
        turn = np.copysign(1.0, self.sweep_rad)
        angle = self.start_rad + turn * s_mm / self.radius_mm
        outward = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        tangent = turn * np.stack([-outward[:, 1], outward[:, 0]], axis=1)
        return np.array([self.centre_x_mm, self.centre_y_mm]) + self.radius_mm * outward, tangent


Piece = Line | Arc


@dataclass(frozen=True, slots=True)
class WirePath:
    """Pieces laid end to end."""

    pieces: tuple[Piece, ...]

    @property
    def length_mm(self) -> float:
        """Length along the wire."""
        return sum(piece.length_mm for piece in self.pieces)

    @property
    def smallest_radius_mm(self) -> float:
        """Smallest bend radius; infinite for a straight path."""
        largest = max(abs(piece.curvature_per_mm) for piece in self.pieces)
        return 1 / largest if largest > 0 else float("inf")

    def at(self, s_mm: ArrayLike) -> tuple[Vectors, Vectors]:
        """Points and unit tangents, each (n, 2), at ``s_mm`` (n,) along the path or at its ends."""
        s = np.clip(np.atleast_1d(np.asarray(s_mm, dtype=float)), 0.0, self.length_mm)
        ends = np.cumsum([piece.length_mm for piece in self.pieces])
        which = np.minimum(np.searchsorted(ends, s, side="left"), len(self.pieces) - 1)
        point, tangent = np.empty((len(s), 2)), np.empty((len(s), 2))
        order = np.argsort(which, kind="stable")
        found, begin = np.unique(which[order], return_index=True)
        for k, here in zip(found, np.split(order, begin[1:]), strict=False):
            start = ends[k] - self.pieces[k].length_mm
            point[here], tangent[here] = self.pieces[k].at(s[here] - start)
        return point, tangent

    def joints(self) -> tuple[Vectors, Vectors]:
        """Jump of position (mm) and of tangent between pieces, each (n - 1,); 0 when smooth."""
        gaps: list[float] = []
        kinks: list[float] = []
        for before, after in pairwise(self.pieces):
            p, t = before.at(np.array([before.length_mm]))
            q, u = after.at(np.array([0.0]))
            gaps.append(float(np.hypot(*(p - q)[0])))
            kinks.append(float(np.hypot(*(t - u)[0])))
        return np.array(gaps), np.array(kinks)

    def polyline(self, tolerance_mm: float = 0.005) -> Vectors:
        """Points (n, 2) of a polyline whose chords stay within ``tolerance_mm`` of the path."""
        points: list[Vectors] = []
        for piece in self.pieces:
            steps = 1
            if isinstance(piece, Arc):
                largest_turn = 2 * np.arccos(max(0.0, 1 - tolerance_mm / piece.radius_mm))
                steps = max(1, int(np.ceil(abs(piece.sweep_rad) / largest_turn)))
            here, _ = piece.at(np.linspace(0.0, piece.length_mm, steps + 1))
            points.append(here if not points else here[1:])
        return np.concatenate(points)

    def line_string(self, tolerance_mm: float = 0.005) -> LineString:
        """Give the path as a shapely line, to within ``tolerance_mm``."""
        return LineString(self.polyline(tolerance_mm))
