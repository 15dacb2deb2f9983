"""Cover thread lies between the halves wherever they come together."""

from __future__ import annotations

import numpy as np

from patterns.path import Vectors
from patterns.plan import UNITS_PER_MM, BlockKind, Run
from patterns.rules.near import near_stretches
from patterns.rules.subject import Subject
from patterns.stitching import ROUNDING_MM
from patterns.violation import Violation
from patterns.wire_index import Numbers, WireIndex

_RULE = "insulation"
_TOLERANCE_MM = 0.01


def check_insulation(subject: Subject) -> list[Violation]:
    """Where the second half comes near the first, satin sewn between them crosses the first.

    The places are found from the paths themselves. A half that comes near to itself is a short
    circuit too, for no cover can lie there.
    """
    first, second = (subject.halves[kind] for kind in subject.halves)
    stretches = near_stretches(first, second, first.length_mm, subject.separation_mm)
    crossed = np.sort(np.concatenate([np.empty(0), *_cover_stations(subject)]))
    largest = 1.5 * subject.stitching.cover_spacing_mm + 2 * ROUNDING_MM
    message = (
        "short circuit: the halves meet, and no cover stitches at most "
        f"{largest:.2f} mm apart lie between them; bare length"
    )
    return [
        _fault(first, bare, message) for bare in _bare(stretches, crossed, largest)
    ] + _check_each_half(subject)


def _check_each_half(subject: Subject) -> list[Violation]:
    faults: list[Violation] = []
    for kind, half in subject.halves.items():
        message = f"short circuit: the wire of block {kind.value} comes near itself; length"
        stretches = near_stretches(half, half, 0.0, subject.separation_mm)
        faults.extend(_fault(half, stretch, message) for stretch in stretches)
    return faults


def _fault(wire: WireIndex, stretch_mm: Numbers, message: str) -> Violation:
    x, y = wire.at(np.array([stretch_mm.mean()]))[0]
    bare = float(stretch_mm[1] - stretch_mm[0])
    return Violation(_RULE, message, float(x), float(y), actual=bare, allowed=0.0)


def _bare(stretches: Vectors, crossed: Numbers, largest_gap_mm: float) -> list[Numbers]:
    """Give the parts of the stretches that lie in a gap between crossings longer than allowed."""
    edges = np.concatenate([[-np.inf], crossed, [np.inf]])
    wide = np.flatnonzero(np.diff(edges) > largest_gap_mm)
    start, end = edges[wide], edges[wide + 1]
    bare: list[Numbers] = []
    for a, b in stretches:
        for k in range(np.searchsorted(end, a), np.searchsorted(start, b)):
            part = np.array([max(a, start[k]), min(b, end[k])])
            if part[1] - part[0] > _TOLERANCE_MM:
                bare.append(part)
    return bare


def _cover_stations(subject: Subject) -> list[Numbers]:
    """Find where cover stitches, sewn after the first half and before the second, cross it."""
    kinds = [block.kind for block in subject.plan.blocks]
    if BlockKind.WIRE_FIRST not in kinds:
        return []
    after = kinds.index(BlockKind.WIRE_FIRST)
    before = kinds.index(BlockKind.WIRE_SECOND) if BlockKind.WIRE_SECOND in kinds else len(kinds)
    return [
        _crossings(subject, run)
        for block in subject.plan.blocks[after:before]
        if block.kind is BlockKind.COVER
        for run in block.runs
    ]


def _crossings(subject: Subject, run: Run) -> Numbers:
    """Arclengths at which the satin stitches of a run cross the first half.

    A stitch that runs along the wire by more than two spacings is no satin and covers nothing.
    """
    wire = subject.halves[BlockKind.WIRE_FIRST]
    nearest = wire.nearest(run.needles / UNITS_PER_MM, subject.reach_mm)
    station, side = nearest.station_mm, nearest.side_mm
    advance = np.diff(station)
    longest = 2 * subject.stitching.cover_spacing_mm + 2 * ROUNDING_MM
    with np.errstate(invalid="ignore"):
        satin = (side[1:] * side[:-1] < 0) & (np.abs(advance) <= longest)
    share = np.abs(side[:-1][satin]) / np.abs(np.diff(side))[satin]
    return station[:-1][satin] + share * advance[satin]
