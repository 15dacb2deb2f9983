"""Where passes of rebuilt wire come together, and whether cover stitches part them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from shapely import STRtree, points
from shapely import distance as distance_between

from patterns.plan import UNITS_PER_MM, BlockKind, StitchPlan
from patterns.sewn_wire import STEP_MM, Strand, crossing_share, segments
from patterns.stitching import ROUNDING_MM

REBUILT_MM = 2 * ROUNDING_MM
"""How far off the distance of two rebuilt wires may be."""

APART_MM = 4.0
"""Places nearer to one another along one wire than this are one stretch of it."""

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


@dataclass(frozen=True)
class _Laid:
    """The straight pieces of all strands together."""

    tree: STRtree
    strand: Indices
    begin_mm: Numbers
    size_mm: Numbers


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
    laid = _laid(strands)
    cover = _satin(plan, laid, strands)
    found: list[Meeting] = []
    for over, strand in enumerate(strands):
        pairs = _pairs(strands, over, laid, diameter_mm, followed)
        for under in np.unique(pairs.strand).tolist():
            own = pairs.of(under)
            sewn = cover[under][1]
            between = (sewn > strands[under].block) & (sewn < strand.block)
            crossed = np.sort(cover[under][0][between])
            found.extend(
                _meeting(strands[under], strand.block, stretch, crossed, largest_gap_mm)
                for stretch in _stretches(own)
            )
    return tuple(found)


def _laid(strands: tuple[Strand, ...]) -> _Laid:
    pieces = [strand.segments() for strand in strands]
    return _Laid(
        STRtree(np.concatenate(pieces)),
        np.repeat(np.arange(len(strands)), [len(own) for own in pieces]),
        np.concatenate([strand.station_mm[:-1] for strand in strands]),
        np.concatenate([np.diff(strand.station_mm) for strand in strands]),
    )


@dataclass(frozen=True)
class _Pairs:
    """Places on one strand (over) with the places on others (under) near them."""

    strand: Indices
    over_mm: Numbers
    under_mm: Numbers

    def of(self, under: int) -> _Pairs:
        """Those with one strand."""
        own = self.strand == under
        return _Pairs(self.strand[own], self.over_mm[own], self.under_mm[own])


def _pairs(
    strands: tuple[Strand, ...],
    over: int,
    laid: _Laid,
    diameter_mm: Mapping[int, float],
    followed: Mapping[int, int],
) -> _Pairs:
    """Pair the points of a strand with pieces of it and of earlier strands that they touch."""
    strand = strands[over]
    diameter = np.array([diameter_mm[one.block] for one in strands])
    reach = (diameter + diameter[over]) / 2 + REBUILT_MM
    places = np.asarray(points(strand.points_mm), dtype=np.object_)
    point, piece = laid.tree.query(places, predicate="dwithin", distance=float(reach.max()))
    earlier = laid.strand[piece] <= over
    point, piece = point[earlier], piece[earlier]
    under = laid.strand[piece]
    on = strand.station_mm[point]
    at = laid.begin_mm[piece] + laid.size_mm[piece] / 2
    near = _distance(places[point], laid.tree.geometries[piece]) <= reach[under]
    before = followed.get(strand.block)
    lengths = np.array([one.station_mm[-1] for one in strands])
    joined = np.array([one.block == before for one in strands])[under]
    along = np.where(
        under == over, np.abs(on - at), np.where(joined, on + lengths[under] - at, np.inf)
    )
    kept = near & (along > APART_MM) & ((under != over) | (at < on))
    return _Pairs(under[kept], on[kept], at[kept])


def _distance(a: NDArray[np.object_], b: NDArray[np.object_]) -> Numbers:

    return np.asarray(distance_between(a, b), dtype=np.float64)


def _stretches(pairs: _Pairs) -> Iterator[_Pairs]:
    """Cut pairs where they jump along either wire."""
    order = np.argsort(pairs.over_mm, kind="stable")
    ordered = _Pairs(pairs.strand[order], pairs.over_mm[order], pairs.under_mm[order])
    jump = (np.diff(ordered.over_mm) > 2 * STEP_MM) | (np.abs(np.diff(ordered.under_mm)) > APART_MM)
    for own in np.split(np.arange(len(order)), np.flatnonzero(jump) + 1):
        yield _Pairs(ordered.strand[own], ordered.over_mm[own], ordered.under_mm[own])


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
    plan: StitchPlan, laid: _Laid, strands: tuple[Strand, ...]
) -> list[tuple[Numbers, Indices]]:
    """For each strand where cover stitches cross it, and the blocks of those stitches."""
    stations: list[list[Numbers]] = [[np.empty(0)] for _ in strands]
    blocks: list[list[Indices]] = [[np.empty(0, dtype=np.int64)] for _ in strands]
    for k, block in enumerate(plan.blocks):
        if block.kind is not BlockKind.COVER:
            continue
        runs = [segments(run.needles / UNITS_PER_MM) for run in block.runs]
        stitches = np.concatenate([np.empty(0, dtype=np.object_), *runs])
        stitch, piece = laid.tree.query(stitches, predicate="intersects")
        share = crossing_share(laid.tree.geometries[piece], stitches[stitch])
        at = laid.begin_mm[piece] + share * laid.size_mm[piece]
        for strand in np.unique(laid.strand[piece]).tolist():
            own = at[laid.strand[piece] == strand]
            stations[strand].append(own)
            blocks[strand].append(np.full(len(own), k))
    return [(np.concatenate(s), np.concatenate(b)) for s, b in zip(stations, blocks, strict=True)]
