"""The stitches of a wire block really tie down the stage of the wire it is meant for."""

from __future__ import annotations

import numpy as np

from patterns.couching import FREE_TAIL_MM
from patterns.rules.couched import Couched, couched
from patterns.rules.subject import Subject
from patterns.stitching import ROUNDING_MM
from patterns.violation import Violation

_RULE = "wire-followed"


def check_wire_followed(subject: Subject) -> list[Violation]:
    """Needle points lie left and right of the stage in turn, in order, with no long gap.

    Where the head swings its needle, they lie on the wire instead. Of each tail the last
    `FREE_TAIL_MM` may be bare, and the lock stitches at both ends of the block may stay on one
    side.
    """
    return [fault for couching in couched(subject) for fault in _check_block(couching)]


def _check_block(couching: Couched) -> list[Violation]:
    if len(couching.astray):
        return _astray(couching)
    swings = couching.subject.machine.couching == "centreline"
    sides = _check_on_wire(couching) if swings else _check_sides(couching)
    return [*sides, *_check_advance(couching), *_check_ends(couching)]


def _astray(couching: Couched) -> list[Violation]:
    subject, distance = couching.subject, couching.nearest.distance_mm
    stage = subject.circuit.stage_name(couching.stage)
    message = f"the needle point is not beside the wire of {stage}: distance"
    found = {"allowed": subject.reach_mm}
    return [
        subject.fault(_RULE, message, couching.block, i, actual=float(distance[i]), **found)
        for i in couching.astray.tolist()
    ]


def _check_on_wire(couching: Couched) -> list[Violation]:
    message = "the head swings about a place that is not on the wire: distance"
    off = np.abs(couching.side_mm)
    return [
        couching.fault(_RULE, int(i), message, float(off[i]), ROUNDING_MM)
        for i in np.flatnonzero(off > ROUNDING_MM)
    ]


def _check_sides(couching: Couched) -> list[Violation]:
    same = couching.side_mm[1:] * couching.side_mm[:-1] >= 0
    message = "the stitch does not cross the wire: its ends lie on one side, at"
    return [
        couching.fault(_RULE, int(i) + 1, message, float(couching.side_mm[i + 1]), 0.0)
        for i in np.flatnonzero(same)
    ]


def _check_advance(couching: Couched) -> list[Violation]:
    stitching = couching.subject.stitching
    advance = np.diff(couching.station_mm)
    allowed = stitching.couching_interval_mm + couching.rounding_mm
    gap = "the wire is not tied down often enough: stitches along it are apart by"
    back = "the stitches do not follow the wire in order: one goes along it by"
    long, against = advance > allowed, advance < -2 * ROUNDING_MM
    return [
        *(
            couching.fault(_RULE, int(i) + 1, gap, float(advance[i]), float(allowed[i]))
            for i in np.flatnonzero(long)
        ),
        *(
            couching.fault(_RULE, int(i) + 1, back, float(advance[i]), 0.0)
            for i in np.flatnonzero(against)
        ),
    ]


def _check_ends(couching: Couched) -> list[Violation]:
    stages, stage = couching.subject.stages, couching.stage
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
        couching.fault(_RULE, at, message, bare, allowed)
        for at, bare, allowed in checks
        if bare > allowed
    ]
