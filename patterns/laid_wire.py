"""Wire on the fabric, made ready to be asked how near to it a point is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely
from numpy.typing import NDArray

from patterns.path import Line, Piece, Vectors, WirePath

SEARCH_TOLERANCE_MM = 0.05
"""Chords with which pieces are looked up; distances are then taken from the true pieces."""

Lengths = NDArray[np.float64]


@dataclass(frozen=True)
class LaidWire:
    """Centrelines of wire; made by `laid_wire`.

    Attributes
    ----------
    tree : shapely.STRtree
        The pieces, as polylines within `SEARCH_TOLERANCE_MM`.
    is_arc : array of bool (n,)
        Whether a piece is an arc.
    shape : array (n, 5)
        Of an arc centre x, y, radius, start angle, sweep (mm, rad); of a line zeros.
    ends : array (n, 2, 2)
        First and last point of the pieces.
    radius_mm : array (n,)
        Half the diameter of the wire of each piece.
    like_mm : float
        Distances are as if to wire of this radius: a thicker wire is nearer by the difference.
    """

    tree: shapely.STRtree
    is_arc: NDArray[np.bool_]
    shape: Vectors
    ends: Vectors
    radius_mm: Lengths
    like_mm: float = 0.0

    def like(self, wire_diameter_mm: float) -> LaidWire:
        """Measure distances as if to the centreline of wire of a diameter."""
        return replace(self, like_mm=wire_diameter_mm / 2)

    def distance_mm(self, points_mm: Vectors, reach_mm: float) -> Lengths:
        """Distance (n,) from points (n, 2) to the nearest centreline; infinite beyond the reach."""
        thicker = self.radius_mm - self.like_mm
        reach = reach_mm + max(float(thicker.max(initial=0.0)), 0.0) + SEARCH_TOLERANCE_MM
        which, piece = self.tree.query(
            shapely.points(points_mm), predicate="dwithin", distance=reach
        )
        arc = self.is_arc[piece]
        exact = np.empty(len(which))
        point, shape, ends = points_mm[which], self.shape[piece], self.ends[piece]
        exact[arc] = _to_arcs(point[arc], shape[arc], ends[arc])
        exact[~arc] = _to_lines(point[~arc], ends[~arc])
        exact -= thicker[piece]
        nearest = np.full(len(points_mm), np.inf)
        np.minimum.at(nearest, which, exact)
        nearest[nearest > reach_mm] = np.inf
        return nearest


def laid_wire(*paths: WirePath, wire_diameter_mm: float = 0.0) -> LaidWire:
    """Make paths of one wire ready for `LaidWire.distance_mm`, measured to its centreline."""
    pieces = [piece for path in paths for piece in path.pieces]
    outlines = [WirePath((piece,)).line_string(SEARCH_TOLERANCE_MM) for piece in pieces]
    return LaidWire(
        shapely.STRtree(outlines),
        np.array([not isinstance(piece, Line) for piece in pieces]),
        np.array([_shape(piece) for piece in pieces]),
        np.array([[outline.coords[0], outline.coords[-1]] for outline in outlines]),
        np.full(len(pieces), wire_diameter_mm / 2),
        wire_diameter_mm / 2,
    )


def all_laid(parts: Sequence[LaidWire]) -> LaidWire:
    """Put wires that are ready together, without making them ready again.

    Distances are measured as for the last of them.
    """
    return LaidWire(
        shapely.STRtree(np.concatenate([part.tree.geometries for part in parts])),
        np.concatenate([part.is_arc for part in parts]),
        np.concatenate([part.shape for part in parts]),
        np.concatenate([part.ends for part in parts]),
        np.concatenate([part.radius_mm for part in parts]),
        parts[-1].like_mm,
    )


def _shape(piece: Piece) -> tuple[float, float, float, float, float]:
    if isinstance(piece, Line):
        return 0.0, 0.0, 0.0, 0.0, 0.0
    return (
        piece.centre_x_mm,
        piece.centre_y_mm,
        piece.radius_mm,
        piece.start_rad,
        piece.sweep_rad,
    )


def _to_lines(point: Vectors, ends: Vectors) -> Lengths:
    """Give the distance of points to line segments, pair by pair."""
    start, along = ends[:, 0], ends[:, 1] - ends[:, 0]
    part = ((point - start) * along).sum(axis=1) / (along**2).sum(axis=1)
    return np.hypot(*(point - start - np.clip(part, 0.0, 1.0)[:, None] * along).T)


def _to_arcs(point: Vectors, shape: Vectors, ends: Vectors) -> Lengths:
    """Give the distance of points to arcs, pair by pair."""
    x, y = (point - shape[:, :2]).T
    radius, start, sweep = shape[:, 2:].T
    turn = np.mod(np.sign(sweep) * (np.arctan2(y, x) - start), 2 * np.pi)
    to_circle = np.abs(np.hypot(x, y) - radius)
    away = point[:, None] - ends
    to_ends = np.hypot(away[..., 0], away[..., 1]).min(axis=1)
    return np.where(turn <= np.abs(sweep), to_circle, to_ends)
