"""The needle must never strike wire."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from patterns.centreline import swing_points
from patterns.path import Vectors
from patterns.plan import BlockKind
from patterns.rules.subject import Subject
from patterns.violation import Violation

_ROUNDOFF_MM = 1e-9


def check_needle_on_wire(subject: Subject) -> list[Violation]:
    """Every needle point misses the wire of its own block and of all blocks before it.

    Marks are sewn before any wire and must miss all of it: wire is laid there later. Of a head that
    swings its needle both needle points are looked at.
    """
    swings = subject.machine.couching == "centreline"
    faults: list[Violation] = []
    for i, block in enumerate(subject.plan.blocks):
        everything = np.ones(len(subject.stage_of_piece), dtype=np.bool_)
        wire = everything if block.kind is BlockKind.MARKS else subject.laid_before(i + 1)
        known = 0 <= block.stage < len(subject.stages)
        if swings and known and block.kind.is_wire:
            for side in _swings(subject, i, block.stage):
                faults.extend(_strikes(subject, i, side, wire))
        else:
            faults.extend(_strikes(subject, i, subject.needles_mm[i], wire))
    return faults


def _swings(subject: Subject, block: int, stage: int) -> Vectors:
    """Both needle points (2, n, 2) of the swings of a block, square to the nearest wire."""
    place = subject.needles_mm[block]
    nearest = subject.stages[stage].nearest(place, subject.reach_mm)
    station = np.nan_to_num(nearest.station_mm)  # whatever is far off is reported elsewhere
    _, tangent = subject.circuit.stages[stage].at(station)
    return swing_points(place, tangent, subject.machine.swing_mm)


def _strikes(
    subject: Subject, block: int, needles: Vectors, wire: NDArray[np.bool_]
) -> list[Violation]:
    message = "the needle strikes wire: too near to its centreline"
    diameter = np.array(subject.diameters_mm)[subject.stage_of_piece]
    faults: list[Violation] = []
    for own in np.unique(diameter[wire]).tolist():
        allowed = subject.clearance_mm(own)
        distance = subject.wire.nearest(
            needles, allowed, among=wire & (diameter == own)
        ).distance_mm
        faults.extend(
            subject.fault(
                "needle-on-wire", message, block, int(i), actual=float(distance[i]), allowed=allowed
            )
            for i in np.flatnonzero(distance < allowed - _ROUNDOFF_MM)
        )
    return faults
