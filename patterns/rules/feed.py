"""At both ends of the wire there is room to feed it and to cut it."""

from __future__ import annotations

from itertools import combinations

import numpy as np
from shapely import LineString, shortest_line

from patterns.circuit import Circuit
from patterns.couching import FREE_TAIL_MM
from patterns.path import Line, Piece, Vectors
from patterns.rules.subject import Subject
from patterns.stitching import ROUNDING_MM
from patterns.terminals import CRIMP_APART_MM
from patterns.violation import Violation

_RULE = "feed-and-cut"
_ROUND_OFF_MM = 1e-6


def check_feed_and_cut(subject: Subject) -> list[Violation]:
    """Every wire starts and ends straight, with nothing sewn over its last `FREE_TAIL_MM`.

    These ends are `CRIMP_APART_MM` from those of other wires.
    """
    circuit, faults = subject.circuit, list[Violation]()
    for stage, path in enumerate(circuit.stages):
        start = subject.starts_mm[stage]
        if circuit.begins_wire(stage):
            faults.extend(_check_end(subject, path.pieces[0], path.at(0.0)[0][0], start, "starts"))
        if circuit.ends_wire(stage):
            end = start + path.length_mm
            faults.extend(
                _check_end(subject, path.pieces[-1], path.at(path.length_mm)[0][0], end, "ends")
            )
    return faults + _check_apart(subject)


def _check_apart(subject: Subject) -> list[Violation]:
    """Check that the free ends of two wires leave room for their crimps."""
    ends = [
        (part, end) for part, one in enumerate(subject.circuit.parts) for end in _free_ends(one)
    ]
    message = "the free ends of two wires leave no room for their crimps: distance"
    faults: list[Violation] = []
    for (part, end), (other, before) in combinations(ends, 2):
        apart = end.distance(before)
        if part != other and apart < CRIMP_APART_MM - _ROUND_OFF_MM:
            x, y = shortest_line(end, before).coords[0]
            faults.append(Violation(_RULE, message, x, y, actual=apart, allowed=CRIMP_APART_MM))
    return faults


def _free_ends(circuit: Circuit) -> list[LineString]:
    """The parts of a wire, at both its ends, that no stitch holds."""
    length = circuit.wire_length_mm
    places = ((0.0, FREE_TAIL_MM), (length - FREE_TAIL_MM, length))
    return [LineString(circuit.wire.at(np.array(place))[0]) for place in places]


def _check_end(
    subject: Subject, tail: Piece, tip: Vectors, end_mm: float, verb: str
) -> list[Violation]:
    straight = tail.length_mm if isinstance(tail, Line) else 0.0
    if straight < FREE_TAIL_MM:
        x, y = tip.tolist()
        message = f"the wire {verb} without a straight tail to feed and to cut: length"
        return [Violation(_RULE, message, x, y, actual=straight, allowed=FREE_TAIL_MM)]
    return _check_free(subject, tip, end_mm, verb)


def _check_free(subject: Subject, tip: Vectors, end_mm: float, verb: str) -> list[Violation]:
    """Check that no needle point, but those of marks, lies beside the free end of the tail."""
    message = f"the stitch leaves no free wire where it {verb}, to feed and to cut: length"
    faults: list[Violation] = []
    for block in sorted(set(subject.laying.values())):
        needles = subject.needles_mm[block]
        # No farther from the tip than the free end is long and the needle is from the wire.
        near = np.flatnonzero(np.hypot(*(needles - tip).T) <= FREE_TAIL_MM + subject.reach_mm)
        nearest = subject.wire.nearest(needles[near], subject.reach_mm)
        free = np.abs(nearest.station_mm - end_mm)
        faults.extend(
            subject.fault(
                _RULE, message, block, int(near[i]), actual=float(free[i]), allowed=FREE_TAIL_MM
            )
            for i in np.flatnonzero(free < FREE_TAIL_MM - 2 * ROUNDING_MM)
        )
    return faults
