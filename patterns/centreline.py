"""Couching by a head that swings its needle: the file holds places on the wire."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from patterns.couching import check_span
from patterns.errors import NoRoomError
from patterns.laid_wire import LaidWire
from patterns.locks import with_locks
from patterns.path import Vectors, WirePath
from patterns.stations import Lengths, Pace, farthest_steps, pace
from patterns.stitching import Stitching

GRID_MM = 0.05
"""Distance of the places along the wire at which room for the needle is looked for."""

ROUND_OFF_MM = 1e-6


def swing_points(point_mm: Vectors, tangent: Vectors, swing_mm: float) -> Vectors:
    """Both needle points of swings, to the left and to the right of the wire: (2, n, 2) in mm."""
    left = swing_mm / 2 * np.stack([-tangent[:, 1], tangent[:, 0]], axis=1)
    return np.stack([point_mm + left, point_mm - left])


def swung_couching(
    path: WirePath,
    span_mm: tuple[float, float],
    laid: LaidWire,
    *,
    clear_mm: float,
    swing_mm: float,
    stitching: Stitching,
    junctions_mm: Lengths,
) -> Vectors:
    """Tie down a stretch of wire in one run of places on its centreline, locked at both ends.

    No side is chosen, so both needle points of every swing must miss all wire. Near a junction
    some places have wire where the needle swings to; the steps go over them.

    Parameters
    ----------
    path, span_mm, laid, clear_mm, junctions_mm
        As in `patterns.couching.couching`.
    swing_mm
        From needle point to needle point.

    Returns
    -------
    Vectors
        Places (n, 2) in mm.

    Raises
    ------
    PatternError
        When the span holds no stitch.
    NoRoomError
        When no row of places, an interval apart or closer, lets the needle miss all wire.
    """
    check_span(span_mm, stitching)
    place = _Places(path, laid, clear_mm, swing_mm)
    measure = pace(path, stitching)
    crossed = junctions_mm[place.free(junctions_mm)]
    inside = crossed[(crossed > span_mm[0]) & (crossed < span_mm[1])]
    knots = [span_mm[0], *np.sort(inside).tolist(), span_mm[1]]
    steps = [_steps(place, measure, a, b)[1:] for a, b in pairwise(knots)]
    stations = np.concatenate([knots[:1], *steps])
    stations = with_locks(stations, stitching.lock_length_mm)
    blocked = ~place.free(stations)
    if np.any(blocked):
        raise _no_room(path, float(stations[int(np.argmax(blocked))]), swing_mm)
    return path.at(stations)[0]


@dataclass(frozen=True)
class _Places:
    """Where along a wire the needle may swing."""

    path: WirePath
    laid: LaidWire
    clear_mm: float
    swing_mm: float

    def free(self, at_mm: Lengths) -> NDArray[np.bool_]:
        """Whether both needle points of swings miss all wire."""
        needles = swing_points(*self.path.at(at_mm), self.swing_mm).reshape(-1, 2)
        distance = self.laid.distance_mm(needles, self.clear_mm)
        return np.all(distance.reshape(2, -1) >= self.clear_mm - ROUND_OFF_MM, axis=0)


def _steps(place: _Places, measure: Pace, begin_mm: float, end_mm: float) -> Lengths:
    """Give stations from one knot to the next: even ones where those are free."""
    begin, end = measure.of(np.array([begin_mm, end_mm]))
    even = measure.back(np.linspace(begin, end, int(np.ceil(end - begin - ROUND_OFF_MM)) + 1))
    if np.all(place.free(even[1:-1])):
        return even
    grid = np.linspace(begin_mm, end_mm, int(np.ceil((end_mm - begin_mm) / GRID_MM)) + 1)
    free = place.free(grid)
    way = farthest_steps(free, measure.of(grid), 1.0)
    if way is None:
        raise _no_way(place, grid, free)
    return grid[way]


def _no_way(place: _Places, grid_mm: Lengths, free: NDArray[np.bool_]) -> NoRoomError:
    """Name the longest stretch in which the needle may not swing."""
    passed = np.concatenate([grid_mm[:1], grid_mm[free], grid_mm[-1:]])
    longest = int(np.argmax(np.diff(passed)))
    x, y = place.path.at(passed[longest : longest + 2].mean())[0][0]
    return NoRoomError(
        f"no place for the needle that swings by machine.swing_mm = {place.swing_mm:g} mm across "
        f"the wire near ({x:.2f}, {y:.2f}) mm: for {np.diff(passed)[longest]:.2f} mm of it other "
        f"wire lies where the needle goes in; a stitching.couching_interval_mm longer than that, a "
        f'wider swing or machine.couching = "zigzag" would make room'
    )


def _no_room(path: WirePath, at_mm: float, swing_mm: float) -> NoRoomError:
    x, y = path.at(at_mm)[0][0]
    return NoRoomError(
        f"no place to lock the wire at ({x:.2f}, {y:.2f}) mm: other wire lies where the needle "
        f"goes in, {swing_mm / 2:g} mm beside it"
    )
