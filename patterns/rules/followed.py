"""The stitches of a wire block really tie down the stage of the wire it is meant for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from patterns.couching import FREE_TAIL_MM
from patterns.path import Vectors
from patterns.rules.subject import Subject
from patterns.stitching import ROUNDING_MM
from patterns.violation import Violation
from patterns.wire_index import Nearest, Numbers

_RULE = "wire-followed"


@dataclass(frozen=True)
class _Couching:
    """The needle points of one wire block between its locks, with their places on the wire."""

    subject: Subject
    block: int
    lead: int
    station_mm: Numbers
    side_mm: Numbers

    def fault(self, i: int, message: str, actual: float, allowed: float) -> Violation:
        return self.subject.fault(
            _RULE, message, self.block, self.lead + i, actual=actual, allowed=allowed
        )


def check_wire_followed(subject: Subject) -> list[Violation]:
    """Needle points lie left and right of the stage in turn, in order, with no long gap.

    Of each tail the last `FREE_TAIL_MM` may be bare, and the lock stitches at both ends of the
    block may stay on one side.
    """
    faults: list[Violation] = []
    for i, block in enumerate(subject.plan.blocks):
        known = 0 <= block.stage < len(subject.stages)
        if block.kind.is_wire and known and len(subject.needles_mm[i]):
            faults.extend(_check_block(subject, i, block.stage))
    return faults


def _check_block(subject: Subject, block: int, stage: int) -> list[Violation]:
    needles = subject.needles_mm[block]
    nearest = _places(subject, needles, stage)
    beside = nearest.overshoot_mm <= ROUNDING_MM + subject.stitching.lock_length_mm
    if not np.all(beside):
        return _astray(subject, block, nearest, beside)
    lead = _lock_points(subject, block, nearest.side_mm, 1)
    trail = _lock_points(subject, block, nearest.side_mm, -1)
    inner = slice(lead, max(len(needles) - trail, lead + 1))
    couching = _Couching(subject, block, lead, nearest.station_mm[inner], nearest.side_mm[inner])
    return [*_check_sides(couching), *_check_advance(couching), *_check_ends(couching, stage)]


def _places(subject: Subject, needles_mm: Vectors, stage: int) -> Nearest:
    """Nearest places on a stage; of two, that which lies between those of the needle's neighbours.

    Beyond an earlier wire a needle may be nearer to another part of its own stage.
    """
    wire = subject.stages[stage]
    nearest = wire.nearest(needles_mm, subject.reach_mm)
    away = (nearest.station_mm, subject.reach_mm)
    other = wire.nearest(needles_mm, subject.reach_mm, away_from=away)
    padded = np.pad(nearest.station_mm, 1, mode="reflect" if len(needles_mm) > 1 else "edge")
    expected = (padded[2:] + padded[:-2]) / 2
    swap = np.abs(other.station_mm - expected) < np.abs(nearest.station_mm - expected)
    return Nearest(
        np.where(swap, other.distance_mm, nearest.distance_mm),
        np.where(swap, other.station_mm, nearest.station_mm),
        np.where(swap, other.side_mm, nearest.side_mm),
    )


def _astray(
    subject: Subject, block: int, nearest: Nearest, beside: NDArray[np.bool_]
) -> list[Violation]:
    stage = subject.circuit.stage_name(subject.plan.blocks[block].stage)
    message = f"the needle point is not beside the wire of {stage}: distance"
    distance, allowed = nearest.distance_mm, subject.reach_mm
    return [
        subject.fault(_RULE, message, block, int(i), actual=float(distance[i]), allowed=allowed)
        for i in np.flatnonzero(~beside)
    ]


def _lock_points(subject: Subject, block: int, side: Numbers, step: int) -> int:
    """Count the points before the last one at which a lock at one end still goes back and forth."""
    needles, side = subject.needles_mm[block][::step], side[::step]
    size = subject.stitching.lock_length_mm + 2 * ROUNDING_MM
    near = np.hypot(*(needles - needles[0]).T) <= size
    lock = near & (side * side[0] > 0)
    return int(np.argmin(lock)) - 1 if not np.all(lock) else len(needles) - 1


def _check_sides(couching: _Couching) -> list[Violation]:
    same = couching.side_mm[1:] * couching.side_mm[:-1] >= 0
    message = "the stitch does not cross the wire: its ends lie on one side, at"
    return [
        couching.fault(int(i) + 1, message, float(couching.side_mm[i + 1]), 0.0)
        for i in np.flatnonzero(same)
    ]


def _check_advance(couching: _Couching) -> list[Violation]:
    stitching = couching.subject.stitching
    advance = np.diff(couching.station_mm)
    allowed = stitching.couching_interval_mm + _rounding_mm(couching)
    gap = "the wire is not tied down often enough: stitches along it are apart by"
    back = "the stitches do not follow the wire in order: one goes along it by"
    long, against = advance > allowed, advance < -2 * ROUNDING_MM
    return [
        *(
            couching.fault(int(i) + 1, gap, float(advance[i]), float(allowed[i]))
            for i in np.flatnonzero(long)
        ),
        *(
            couching.fault(int(i) + 1, back, float(advance[i]), 0.0)
            for i in np.flatnonzero(against)
        ),
    ]


def _rounding_mm(couching: _Couching) -> Numbers:
    """How much rounding can lengthen the advance of each stitch along the wire.

    Seen from a point at distance d on the inside of a bend of radius R, the wire runs R / (R - d)
    times as far.
    """
    curvature = 1 / couching.subject.circuit.smallest_radius_mm
    depth = np.minimum(np.abs(couching.side_mm) * curvature, 0.5)
    stretched = ROUNDING_MM / (1 - depth)
    return stretched[1:] + stretched[:-1]


def _check_ends(couching: _Couching, stage: int) -> list[Violation]:
    stages = couching.subject.stages
    interval = couching.subject.stitching.couching_interval_mm + 2 * ROUNDING_MM
    circuit = couching.subject.circuit
    starts = FREE_TAIL_MM if circuit.begins_wire(stage) else 0.0
    ends = FREE_TAIL_MM if circuit.ends_wire(stage) else 0.0
    length = stages[stage].length_mm
    last = len(couching.station_mm) - 1
    bare_start = float(couching.station_mm[0])
    bare_end = length - float(couching.station_mm[last])
    message = "the wire is left loose at an end of its stage: bare length"
    checks = ((0, bare_start, starts + interval), (last, bare_end, ends + interval))
    return [
        couching.fault(at, message, bare, allowed) for at, bare, allowed in checks if bare > allowed
    ]
