"""A wire's centreline: straight lines and circular arcs, one after the other."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

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


@dataclass(frozen=True)
class WirePath:
    """Pieces laid end to end."""

    pieces: tuple[Piece, ...]

    @cached_property
    def length_mm(self) -> float:
        """Length along the wire."""
        return sum(piece.length_mm for piece in self.pieces)

    @cached_property
    def smallest_radius_mm(self) -> float:
        """Smallest bend radius; infinite for a straight path."""
        largest = max(abs(piece.curvature_per_mm) for piece in self.pieces)
        return 1 / largest if largest > 0 else float("inf")

    @cached_property
    def _ends_mm(self) -> Vectors:
        """Arclength (n,) at the end of each piece."""
        return np.cumsum([piece.length_mm for piece in self.pieces])

    @cached_property
    def _bends(self) -> Vectors:
        """Of each piece (n, 7) anchor x, y, first angle, curvature, length and direction x, y.

        Of an arc the anchor is the centre, from which its first point is seen at that angle; of a
        line it is the start. An arc has no direction, a line no angle.
        """
        return np.array([_bend(piece) for piece in self.pieces])

    def at(self, s_mm: ArrayLike) -> tuple[Vectors, Vectors]:
        """Points and unit tangents, each (n, 2), at ``s_mm`` (n,) along the path or at its ends."""
        s = np.clip(np.atleast_1d(np.asarray(s_mm, dtype=float)), 0.0, self.length_mm)
        which = np.searchsorted(self._ends_mm, s, side="left")
        which = np.minimum(which, len(self.pieces) - 1)
        return self._on_pieces(which, s - (self._ends_mm[which] - self._bends[which, 4]))

    def _on_pieces(self, which: NDArray[np.int64], along: Vectors) -> tuple[Vectors, Vectors]:
        """Points and unit tangents at lengths along pieces."""
        x, y, first, curvature, _, ahead_x, ahead_y = self._bends[which].T
        angle = first + along * curvature
        bent, turn = curvature != 0, np.sign(curvature)
        ray_x, ray_y = (
            np.where(bent, np.cos(angle), ahead_x),
            np.where(bent, np.sin(angle), ahead_y),
        )
        reach = np.where(bent, 1 / np.where(bent, np.abs(curvature), 1.0), along)
        point = np.stack([x + reach * ray_x, y + reach * ray_y], axis=1)
        across = np.stack([-turn * ray_y, turn * ray_x], axis=1)
        return point, np.where(bent[:, None], across, np.stack([ray_x, ray_y], axis=1))

    def joints(self) -> tuple[Vectors, Vectors]:
        """Jump of position (mm) and of tangent between pieces, each (n - 1,); 0 when smooth."""
        index = np.arange(len(self.pieces))
        ends, leaves = self._on_pieces(index[:-1], self._bends[:-1, 4])
        starts, sets_out = self._on_pieces(index[1:], np.zeros(len(index) - 1))
        return np.hypot(*(ends - starts).T), np.hypot(*(leaves - sets_out).T)

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


def _bend(piece: Piece) -> tuple[float, ...]:
    if isinstance(piece, Arc):
        centre = piece.centre_x_mm, piece.centre_y_mm
        return *centre, piece.start_rad, piece.curvature_per_mm, piece.length_mm, 0.0, 0.0
    (start,), (ahead,) = piece.at(np.zeros(1))
    return *start.tolist(), 0.0, 0.0, piece.length_mm, *ahead.tolist()
