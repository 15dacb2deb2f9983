"""Where along a wire a point lies, and how far beside it: exact, and quick for many points."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from patterns.cell_table import Indices, counted
from patterns.path import Line, Piece, Vectors, WirePath
from patterns.piece_cells import PieceCells

Numbers = NDArray[np.float64]


@dataclass(frozen=True)
class Nearest:
    """The nearest places on a wire, one for each of n points; each array is (n,).

    Attributes
    ----------
    distance_mm : array
        Distance to the centreline; infinite where no wire lies within reach.
    station_mm : array
        Arclength of the nearest place; NaN where there is none.
    side_mm : array
        Distance square to the wire, positive on its left. It is smaller in size than
        ``distance_mm`` only for points beyond an end of the wire. NaN where there is none.
    """

    distance_mm: Numbers
    station_mm: Numbers
    side_mm: Numbers

    @property
    def overshoot_mm(self) -> Numbers:
        """How far each point lies beyond an end of the wire, along it; 0 beside the wire."""
        return np.sqrt(np.maximum(self.distance_mm**2 - self.side_mm**2, 0.0))


class WireIndex:
    """The pieces of a path as arrays, with the cells they pass through.

    Parameters
    ----------
    path : WirePath
        The wire's centreline.
    farther_mm : array (pieces,) or float, optional
        How much farther along the wire places of each piece are counted than the lengths of the
        pieces make it: of several wires, the gaps from one to the next.
    """

    def __init__(self, path: WirePath, farther_mm: Numbers | float = 0.0) -> None:
        self.length_mm = path.length_mm
        self.pieces = path.pieces
        self._length = np.array([piece.length_mm for piece in path.pieces])
        self._start = np.cumsum(self._length) - self._length + farther_mm
        self._curvature = np.array([piece.curvature_per_mm for piece in path.pieces])
        rows = np.array([_numbers(piece) for piece in path.pieces])
        self._anchor, self._angle = rows[:, :2], rows[:, 2]
        self._cells = PieceCells(path.pieces)

    def at(self, s_mm: Numbers) -> Vectors:
        """Give the points (n, 2) at arclengths ``s_mm`` (n,)."""
        piece = np.searchsorted(self._start, s_mm, side="right") - 1
        point, _ = self._places(piece, s_mm - self._start[piece])
        return point

    def pairs(self, start_mm: Vectors, end_mm: Vectors, reach_mm: float) -> tuple[Indices, Indices]:
        """Pair straight edges with all pieces within ``reach_mm``, and some that are farther off.

        Parameters
        ----------
        start_mm, end_mm : array (n, 2)
            Ends of the edges.

        Returns
        -------
        edge, piece : arrays (m,)
            Indices of the pairs; of long edges some stand there twice.
        """
        length = np.hypot(*(end_mm - start_mm).T)
        count = np.maximum(np.ceil(length / reach_mm).astype(np.int64), 1)
        edge, rank = counted(count)
        share = ((rank + 0.5) / count[edge])[:, None]
        places = start_mm[edge] + share * (end_mm - start_mm)[edge]
        which, piece = self._cells.near(places, 1.5 * reach_mm)
        return edge[which], piece

    @cached_property
    def targets_mm(self) -> Vectors:
        """Of each piece (n, 3, 2) the ends and, of an arc, the centre.

        The place on a straight edge that is nearest to a piece it does not cross is an end of the
        edge or the foot of one of these.
        """
        ends = self._cells.ends_mm
        third = np.where(self._curvature[:, None] != 0, self._anchor, ends[:, 0])
        return np.concatenate([ends, third[:, None]], axis=1)

    def distance_mm(self, points_mm: Vectors, piece: Indices) -> Numbers:
        """Distance (m,) of point i (m, 2) from its piece i (m,)."""
        return self._cells.distance_mm(points_mm, piece)

    def nearest(
        self,
        points_mm: Vectors,
        reach_mm: float,
        away_from: tuple[Numbers, float] | None = None,
        among: NDArray[np.bool_] | None = None,
    ) -> Nearest:
        """Find the nearest place on the wire for each point within a reach.

        Parameters
        ----------
        points_mm : array (n, 2)
            The points.
        reach_mm : float
            Farther wire is not looked for.
        away_from : (array (n,), float), optional
            Arclengths, one a point, and a length: pieces whose nearest place is not farther than
            that along the wire are left out.
        among : array of bool (pieces,), optional
            Pieces that are looked at.
        """
        which, piece, distance = self._eligible(points_mm, reach_mm, away_from, among)
        result = Nearest(*(np.full(len(points_mm), fill) for fill in (np.inf, np.nan, np.nan)))
        if not len(which):
            return result
        first = np.flatnonzero(np.diff(which, prepend=-1))
        least = np.repeat(
            np.minimum.reduceat(distance, first), np.diff(np.append(first, len(which)))
        )
        best = np.flatnonzero(distance == least)
        best = best[np.diff(which[best], prepend=-1) != 0]
        found, piece = which[best], piece[best]
        result.distance_mm[found] = distance[best]
        _, along, result.side_mm[found] = self.to_pieces(points_mm[found], piece)
        result.station_mm[found] = along + self._start[piece]
        return result

    def within(
        self,
        points_mm: Vectors,
        reach_mm: float,
        away_from: tuple[Numbers, float] | None = None,
        among: NDArray[np.bool_] | None = None,
    ) -> tuple[Indices, Indices]:
        """Pair points with all pieces within reach; what is left out is as in `nearest`.

        Returns
        -------
        point, piece : arrays (m,)
            Indices of the pairs.
        """
        which, piece, _ = self._eligible(points_mm, reach_mm, away_from, among)
        return which, piece

    def _eligible(
        self,
        points_mm: Vectors,
        reach_mm: float,
        away_from: tuple[Numbers, float] | None,
        among: NDArray[np.bool_] | None,
    ) -> tuple[Indices, Indices, Numbers]:
        """Pairs of points, in order, and pieces; with distance."""
        which, piece = self._cells.near(points_mm, reach_mm)
        if among is not None:
            which, piece = which[among[piece]], piece[among[piece]]
        distance = self.distance_mm(points_mm[which], piece)
        eligible = distance <= reach_mm
        which, piece, distance = which[eligible], piece[eligible], distance[eligible]
        if away_from is None:
            return which, piece, distance
        _, along, _ = self.to_pieces(points_mm[which], piece)
        apart = np.abs(along + self._start[piece] - away_from[0][which]) > away_from[1]
        return which[apart], piece[apart], distance[apart]

    def to_pieces(self, points_mm: Vectors, piece: Indices) -> tuple[Numbers, Numbers, Numbers]:
        """Distance, arclength within the piece and signed offset of point i from its piece i."""
        arc = self._curvature[piece] != 0
        away = points_mm - self._anchor[piece]
        along = np.empty(len(piece))
        along[arc] = self._along_arcs(away[arc], piece[arc])
        along[~arc] = self._along_lines(away[~arc], piece[~arc])
        foot, tangent = self._places(piece, along)
        away = points_mm - foot
        side = tangent[:, 0] * away[:, 1] - tangent[:, 1] * away[:, 0]
        return np.hypot(away[:, 0], away[:, 1]), along, side

    def _along_arcs(self, from_centre: Vectors, piece: Indices) -> Numbers:
        curvature = self._curvature[piece]
        angle = np.arctan2(from_centre[:, 1], from_centre[:, 0]) - self._angle[piece]
        turned = np.mod(np.sign(curvature) * angle, 2 * np.pi)
        sweep = self._length[piece] * np.abs(curvature)
        end = np.where(turned - sweep < 2 * np.pi - turned, sweep, 0.0)
        return np.where(turned <= sweep, turned, end) / np.abs(curvature)

    def _along_lines(self, from_start: Vectors, piece: Indices) -> Numbers:
        angle = self._angle[piece]
        along = from_start[:, 0] * np.cos(angle) + from_start[:, 1] * np.sin(angle)
        return np.clip(along, 0.0, self._length[piece])

    def _places(self, piece: Indices, along_mm: Numbers) -> tuple[Vectors, Vectors]:
        """Points and unit tangents at arclengths within pieces."""
        curvature = self._curvature[piece]
        angle = self._angle[piece] + along_mm * curvature
        ray = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        turn = np.sign(curvature)[:, None]
        across = turn * np.stack([-ray[:, 1], ray[:, 0]], axis=1)
        radius = 1 / np.where(curvature == 0, np.inf, np.abs(curvature))
        reach = np.where(curvature == 0, along_mm, radius)
        return self._anchor[piece] + reach[:, None] * ray, np.where(turn == 0, ray, across)


def _numbers(piece: Piece) -> tuple[float, float, float]:
    """Start and direction of a line; centre and first angle of an arc."""
    if isinstance(piece, Line):
        direction = np.arctan2(piece.y1_mm - piece.y0_mm, piece.x1_mm - piece.x0_mm)
        return piece.x0_mm, piece.y0_mm, float(direction)
    return piece.centre_x_mm, piece.centre_y_mm, piece.start_rad
