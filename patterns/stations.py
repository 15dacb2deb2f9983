"""Where along a wire the needle goes in: evenly between junctions, closer on bends."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from patterns.path import WirePath
from patterns.stitching import Stitching

ROUND_OFF = 1e-6
"""A stretch longer than a whole number of steps by less than this takes no stitch more."""

Lengths = NDArray[np.float64]


@dataclass(frozen=True)
class Pace:
    """Arclength measured in stitches: one is an interval long, or turns by the largest angle.

    Attributes
    ----------
    at_mm : array (n,)
        Arclengths at which pieces of the wire end, from 0.
    stitches : array (n,)
        Stitches from the start of the wire to there, not whole.
    """

    at_mm: Lengths
    stitches: Lengths

    def of(self, s_mm: Lengths) -> Lengths:
        """Stitches up to arclengths."""
        return np.interp(s_mm, self.at_mm, self.stitches)

    def back(self, stitches: Lengths) -> Lengths:
        """Arclengths after so many stitches."""
        return np.interp(stitches, self.stitches, self.at_mm)


def pace(path: WirePath, stitching: Stitching) -> Pace:
    """Measure a wire in stitches: where it bends by 1 / R, one is no longer than R times the angle.

    Both limits are kept over any stretch, for the measure is the integral of the larger density.
    """
    length = np.array([piece.length_mm for piece in path.pieces])
    curvature = np.array([abs(piece.curvature_per_mm) for piece in path.pieces])
    turn = np.radians(stitching.couching_angle_deg)
    density = np.maximum(1 / stitching.couching_interval_mm, curvature / turn)
    return Pace(_from_zero(length), _from_zero(length * density))


def _from_zero(steps: Lengths) -> Lengths:
    return np.concatenate([[0.0], np.cumsum(steps)])


@dataclass(frozen=True)
class Stations:
    """Needle stations in stitches (see `Pace`).

    Attributes
    ----------
    at : array (n,)
        In rising order; a junction stands there twice, for the stitch that crosses the wire in it.
    play : array (n,)
        How far each may move along the wire so that two neighbours stay a stitch apart; 0 at the
        ends and in junctions.
    """

    at: Lengths
    play: Lengths


def even_stations(begin: float, end: float, junctions: Lengths, share: float) -> Stations:
    """Divide a stretch evenly between its junctions.

    Parameters
    ----------
    begin, end
        Of the stretch, in stitches.
    junctions
        Where the needle goes in on both sides of the wire, in stitches; those outside do not count.
    share
        Largest step, in stitches.
    """
    inside = np.sort(junctions[(junctions > begin + share / 2) & (junctions < end - share / 2)])
    at: list[Lengths] = []
    play: list[Lengths] = []
    for a, b in pairwise([begin, *inside.tolist(), end]):
        steps = max(1, int(np.ceil((b - a) / share - ROUND_OFF)))
        at.append(np.linspace(a, b, steps + 1))
        room = np.full(steps + 1, max(0.0, (1 - (b - a) / steps) / 2))
        room[[0, -1]] = 0.0
        play.append(room)
    return Stations(np.concatenate(at), np.concatenate(play))


def farthest_steps(free: NDArray[np.bool_], at: Lengths, step: float) -> NDArray[np.int64] | None:
    """Go from the first place to the last over free ones, as far as a step reaches each time.

    Going as far as one can finds a way if there is one. A short last step is evened out.

    Parameters
    ----------
    free
        Places (n,) that may be stepped on; first and last count as free.
    at
        Where they lie (n,), rising.
    step
        Largest step.

    Returns
    -------
    array of int or None
        Indices of the places that are stepped on; None when there is no way.
    """
    last = len(at) - 1
    latest_free = np.maximum.accumulate(np.where(free, np.arange(last + 1), 0))
    way = [0]
    while way[-1] < last:
        reach = int(np.searchsorted(at, at[way[-1]] + step + ROUND_OFF, side="right")) - 1
        following = last if reach == last else int(latest_free[reach])
        if following <= way[-1]:
            return None
        way.append(following)
    if len(way) > 2:
        way[-2] = _evened(way, free, at, step)
    return np.array(way)


def _evened(way: list[int], free: NDArray[np.bool_], at: Lengths, step: float) -> int:
    """Free place nearest to the middle of the last two steps, a step from both of their ends."""
    before, middle, last = at[way[-3]], (at[way[-3]] + at[way[-1]]) / 2, at[way[-1]]
    near = free & (at <= before + step + ROUND_OFF) & (at >= last - step - ROUND_OFF)
    near &= (at > before) & (at < last)
    found = np.flatnonzero(near)
    return int(found[np.argmin(np.abs(at[found] - middle))])
