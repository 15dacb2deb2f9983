"""Where couched wire runs, rebuilt from the needle points alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from patterns.locks import POINTS_PER_LOCK
from patterns.path import Vectors
from patterns.sewn_pieces import SewnPieces
from patterns.stitching import ROUNDING_MM

STEP_MM = 0.5
"""Rebuilt wire is a row of points no farther apart than this."""

_ROUNDS = 3
"""Tangents and centreline are improved from one another so often."""

_WIDER = 1.15
"""Stitches wider than the usual one by this factor reach over wire that was laid before."""

_SMALLEST_MM = 1e-9

_OPEN_MM = 2 * ROUNDING_MM
"""Distances that differ by less may be equal before they are rounded."""

_NARROWEST_MM = 0.3 - 2 * ROUNDING_MM

_FEWEST = 2 * POINTS_PER_LOCK + 3

Numbers = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True)
class Strand:
    """Wire that one block lays, as rebuilt.

    Attributes
    ----------
    block : int
        Index of the block in the plan.
    points_mm : array (n, 2)
        Along the centreline, about `STEP_MM` apart.
    station_mm : array (n,)
        Length along the strand.
    """

    block: int
    points_mm: Vectors
    station_mm: Numbers


def sewn_strand(block: int, needles_mm: Vectors, earlier: SewnPieces) -> Strand:
    """Rebuild the centreline between the needle points of a couching.

    The needle goes in on both sides of the wire in turn, as far from it on the one as on the other
    unless it has to reach over wire that was laid before; then only the other side tells where the
    wire runs. Stitches that do not zigzag are taken for the wire itself, for some machines swing
    the head on their own.

    Parameters
    ----------
    needles_mm
        Needle points (n, 2) in the order of sewing, locks included.
    earlier
        The wire that was laid before.
    """
    locked = len(needles_mm) >= _FEWEST
    row = needles_mm[POINTS_PER_LOCK:-POINTS_PER_LOCK] if locked else needles_mm
    if len(row) > 2 and _zigzags(row):
        row = _centreline(row, ~_reaching_over(row, earlier))
    dense = _smooth(row)
    station = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(dense, axis=0).T))])
    return Strand(block, dense, station)


def _cross(a: Vectors, b: Vectors) -> Numbers:
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def _zigzags(row: Vectors) -> bool:
    """Whether stitches turn left and right in turn, mostly, and by more than rounding makes them.

    A zigzag leaves the middle between the points before and after by its width, which is at least
    the needle's, the thinnest of which is 0.3 mm.
    """
    step = np.diff(row, axis=0)
    turn = _cross(step[:-1], step[1:])
    off = np.hypot(*(step[1:] - step[:-1]).T) / 2
    wide = float(np.median(off)) > _NARROWEST_MM
    return len(turn) < 2 or (wide and float(np.mean(turn[:-1] * turn[1:] < 0)) > 0.5)


def _reaching_over(needles: Vectors, earlier: SewnPieces) -> Flags:
    """Which needle points may lie beyond earlier wire.

    Of a stitch across such wire that end does which is nearer to it, for there it keeps the
    clearance; both may when rounding leaves it open.
    """
    beyond = np.zeros(len(needles), dtype=np.bool_)
    stitch = np.unique(earlier.crossed(needles[:-1], needles[1:])[0])
    if stitch.size:
        ends = np.stack([needles[stitch], needles[stitch + 1]])
        longest = float(np.hypot(*(ends[1] - ends[0]).T).max())
        begin, end = (earlier.distance_mm(one, longest) for one in ends)
        beyond[stitch[begin < end + _OPEN_MM]] = True
        beyond[stitch[end < begin + _OPEN_MM] + 1] = True
    beyond[[0, -1]] = False  # where the strand begins and ends is known only from these
    return beyond


def _centreline(needles: Vectors, sound: Flags) -> Vectors:
    """Move sound needle points square to the wire by the usual half-width of the couching."""
    along = np.empty_like(needles)
    along[1:-1] = needles[2:] - needles[:-2]
    along[0], along[-1] = along[1], along[-2]
    along = _unit(along)
    step = np.diff(needles, axis=0)
    across = np.empty_like(needles)
    across[1:-1] = step[:-1] - step[1:]
    across[0], across[-1] = -step[0], step[-1]
    side = np.sign(_cross(along, across))
    half = _half_width_mm(step, along)
    centre, tangent = needles[sound], along[sound]
    for _ in range(_ROUNDS):
        left = np.stack([-tangent[:, 1], tangent[:, 0]], axis=1)
        moved = needles[sound] - half * side[sound, None] * left
        centre, place = _merged(moved, tangent)
        tangent = _tangents(centre)[place]
    return centre


def _merged(row: Vectors, tangent: Vectors) -> tuple[Vectors, NDArray[np.int64]]:
    """Make one point of those that rounding may have exchanged along the wire.

    Both ends of a stitch square over the wire tell of one place on it.

    Returns
    -------
    array (m, 2)
        The points.
    array (n,)
        Which of them each point of the row is now.
    """
    advance = np.sum(np.diff(row, axis=0) * (tangent[1:] + tangent[:-1]) / 2, axis=1)
    place = np.concatenate([[0], np.cumsum(advance > _OPEN_MM)])
    total = np.zeros((int(place[-1]) + 1, 2))
    np.add.at(total, place, row)
    return total / np.bincount(place)[:, None], place


def _half_width_mm(step: Vectors, tangent: Vectors) -> float:
    half = np.abs(_cross(_unit(tangent[:-1] + tangent[1:]), step)) / 2
    usual = float(np.quantile(half, 0.3))
    return float(np.mean(half[half <= _WIDER * usual]))


def _tangents(row: Vectors) -> Vectors:
    """Unit tangents of the parabolas through every three points of a row."""
    step = np.diff(row, axis=0)
    if len(step) < 2:
        return _unit(np.broadcast_to(row[-1] - row[0], row.shape))
    size = np.maximum(np.hypot(step[:, 0], step[:, 1]), _SMALLEST_MM)[:, None]
    slope = step / size
    inner = (size[1:] * slope[:-1] + size[:-1] * slope[1:]) / (size[1:] + size[:-1])
    first, last = 2 * slope[0] - inner[0], 2 * slope[-1] - inner[-1]
    return _unit(np.concatenate([first[None], inner, last[None]]))


def _unit(vectors: Vectors) -> Vectors:
    size = np.hypot(vectors[:, 0], vectors[:, 1])[:, None]
    return vectors / np.where(size > 0, size, 1.0)


def _smooth(row: Vectors) -> Vectors:
    """Points of cubic Hermite pieces through a row of points."""
    if len(row) < 3:
        return row
    tangent = _tangents(row)
    chord = np.hypot(*np.diff(row, axis=0).T)
    count = np.maximum(np.ceil(chord / STEP_MM), 1).astype(np.int64)
    piece = np.repeat(np.arange(len(chord)), count)
    first = np.repeat(np.cumsum(count) - count, count)
    u = ((np.arange(len(piece)) - first) / count[piece])[:, None]
    size = chord[piece][:, None]
    start, end = row[piece], row[piece + 1]
    curve = (
        (1 + 2 * u) * (1 - u) ** 2 * start
        + u * (1 - u) ** 2 * size * tangent[piece]
        + u**2 * (3 - 2 * u) * end
        - u**2 * (1 - u) * size * tangent[piece + 1]
    )
    return np.concatenate([curve, row[-1:]])
