"""Where passes of rebuilt wire come together, and whether cover stitches part them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from patterns.plan import UNITS_PER_MM, BlockKind, StitchPlan
from patterns.sewn_pieces import APART_MM, SewnPieces
from patterns.sewn_wire import STEP_MM, Strand
from patterns.stitching import ROUNDING_MM

REBUILT_MM = 2 * ROUNDING_MM
"""How far off the distance of two rebuilt wires may be."""

_BARE_MM = 0.5 * STEP_MM

Numbers = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Meeting:
    """A stretch in which a pass of wire lies on, or touches, an earlier one.

    Attributes
    ----------
    x_mm, y_mm : float
        Its middle, or that of the part without a cover.
    under, over : int
        The blocks that lay the two passes.
    under_mm, over_mm : float
        Where along those strands.
    insulated : bool
        Whether cover stitches sewn between the two cross the lower one all along.
    """

    x_mm: float
    y_mm: float
    under: int
    over: int
    under_mm: float
    over_mm: float
    insulated: bool


def meetings(
    strands: tuple[Strand, ...],
    diameter_mm: Mapping[int, float],
    followed: Mapping[int, int],
    plan: StitchPlan,
    largest_gap_mm: float,
) -> tuple[Meeting, ...]:
    """Find every place where passes of wire come within contact of one another.

    Parameters
    ----------
    diameter_mm
        Wire diameter of the strand of each block.
    followed
        For the block of a strand that continues another, the block of that other.
    """
    if not strands:
        return ()
    laid = SewnPieces([strand.points_mm for strand in strands])
    cover = _satin(plan, laid, strands)
    pairs = _pairs(strands, laid, diameter_mm, followed)
    found: list[Meeting] = []
    for over, strand in enumerate(strands):
        for under in np.unique(pairs.under[pairs.over == over]).tolist():
            own = pairs.of(over, under)
            sewn = cover[under][1]
            between = (sewn > strands[under].block) & (sewn < strand.block)
            crossed = np.sort(cover[under][0][between])
            found.extend(
                _meeting(strands[under], strand.block, stretch, crossed, largest_gap_mm)
                for stretch in _stretches(own)
            )
    return tuple(found)


@dataclass(frozen=True)
class _Pairs:
    """Places on one strand (over) with the places on earlier wire (under) near them."""

    over: Indices
    under: Indices
    over_mm: Numbers
    under_mm: Numbers

    def among(self, which: Indices | NDArray[np.bool_]) -> _Pairs:
        """Some of them, or in another order."""
        return _Pairs(
            self.over[which], self.under[which], self.over_mm[which], self.under_mm[which]
        )

    def of(self, over: int, under: int) -> _Pairs:
        """Those of two strands."""
        return self.among((self.over == over) & (self.under == under))


def _pairs(
    strands: tuple[Strand, ...],
    laid: SewnPieces,
    diameter_mm: Mapping[int, float],
    followed: Mapping[int, int],
) -> _Pairs:
    """Pair the points of strands with pieces of earlier wire, their own included, they touch.

    Every point starts a piece, but for the last of a strand, which is half a millimetre from one.
    """
    diameter = np.array([diameter_mm[one.block] for one in strands])
    widest = float(diameter.max()) + REBUILT_MM
    later, earlier = laid.near_one_another(widest)
    over, under = laid.row[later], laid.row[earlier]
    pairs = _Pairs(over, under, laid.begin_mm[later], laid.middle_mm[earlier])
    reach = (diameter[over] + diameter[under]) / 2 + REBUILT_MM
    near = laid.to_pieces_mm(laid.start_mm[later], earlier) <= reach
    return pairs.among(near & (_along_mm(pairs, strands, followed) > APART_MM))


def _along_mm(pairs: _Pairs, strands: tuple[Strand, ...], followed: Mapping[int, int]) -> Numbers:
    """How far apart places are along their wire; infinite on two wires."""
    index = {strand.block: k for k, strand in enumerate(strands)}
    before = np.array([index.get(followed.get(strand.block, -1), -1) for strand in strands])
    length = np.array([strand.station_mm[-1] for strand in strands])
    same, joined = pairs.under == pairs.over, pairs.under == before[pairs.over]
    through = pairs.over_mm + length[pairs.under] - pairs.under_mm
    own = np.abs(pairs.over_mm - pairs.under_mm)
    return np.where(same, own, np.where(joined, through, np.inf))


def _stretches(pairs: _Pairs) -> Iterator[_Pairs]:
    """Cut pairs where they jump along either wire."""
    order = np.argsort(pairs.over_mm, kind="stable")
    ordered = pairs.among(order)
    jump = (np.diff(ordered.over_mm) > 2 * STEP_MM) | (np.abs(np.diff(ordered.under_mm)) > APART_MM)
    for own in np.split(np.arange(len(order)), np.flatnonzero(jump) + 1):
        yield ordered.among(own)


def _meeting(
    lower: Strand,
    over: int,
    stretch: _Pairs,
    crossed_mm: Numbers,
    largest_gap_mm: float,
) -> Meeting:
    begin, end = float(stretch.under_mm.min()), float(stretch.under_mm.max())
    bare = _longest_bare(begin, end, crossed_mm, largest_gap_mm)
    insulated = bare is None or (bare[1] - bare[0] < _BARE_MM and begin < end)
    middle = sum(bare) / 2 if bare is not None else (begin + end) / 2
    nearest = int(np.argmin(np.abs(stretch.under_mm - middle)))
    x, y = lower.points_mm[np.searchsorted(lower.station_mm, middle)].tolist()
    on = float(stretch.over_mm[nearest])
    return Meeting(x, y, lower.block, over, middle, on, insulated)


def _longest_bare(
    begin_mm: float, end_mm: float, crossed_mm: Numbers, largest_gap_mm: float
) -> tuple[float, float] | None:
    """Longest part of a stretch in a gap between crossings that is longer than allowed."""
    inside = slice(
        *np.searchsorted(crossed_mm, (begin_mm - largest_gap_mm, end_mm + largest_gap_mm))
    )
    edges = np.concatenate([[-np.inf], crossed_mm[inside], [np.inf]])
    wide = np.flatnonzero(np.diff(edges) > largest_gap_mm)
    parts = [(max(begin_mm, edges[k]), min(end_mm, edges[k + 1])) for k in wide]
    parts = [(float(a), float(b)) for a, b in parts if b >= a]
    return max(parts, key=lambda part: part[1] - part[0], default=None)


def _satin(
    plan: StitchPlan, laid: SewnPieces, strands: tuple[Strand, ...]
) -> list[tuple[Numbers, Indices]]:
    """For each strand where cover stitches cross it, and the blocks of those stitches."""
    stations: list[list[Numbers]] = [[np.empty(0)] for _ in strands]
    blocks: list[list[Indices]] = [[np.empty(0, dtype=np.int64)] for _ in strands]
    for k, block in enumerate(plan.blocks):
        if block.kind is not BlockKind.COVER:
            continue
        runs = [run.needles / UNITS_PER_MM for run in block.runs]
        start = np.concatenate([np.empty((0, 2)), *(run[:-1] for run in runs)])
        end = np.concatenate([np.empty((0, 2)), *(run[1:] for run in runs)])
        _, piece, share = laid.crossed(start, end)
        at = laid.begin_mm[piece] + share * laid.size_mm[piece]
        for strand in np.unique(laid.row[piece]).tolist():
            own = at[laid.row[piece] == strand]
            stations[strand].append(own)
            blocks[strand].append(np.full(len(own), k))
    return [(np.concatenate(s), np.concatenate(b)) for s, b in zip(stations, blocks, strict=True)]
