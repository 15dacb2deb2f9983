"""The needle must never strike wire."""

from __future__ import annotations

import numpy as np

from patterns.plan import BlockKind
from patterns.rules.subject import Subject
from patterns.violation import Violation

_ROUNDOFF_MM = 1e-9


def check_needle_on_wire(subject: Subject) -> list[Violation]:
    """Every needle point misses the wire of its own block and of all blocks before it.

    Marks are sewn before any wire and must miss all of it: wire is laid there later.
    """
    laid: list[BlockKind] = []
    faults: list[Violation] = []
    for i, block in enumerate(subject.plan.blocks):
        if block.kind.is_wire and block.kind not in laid:
            laid.append(block.kind)
        wires = list(subject.halves) if block.kind is BlockKind.MARKS else laid
        faults.extend(_strikes(subject, i, wires))
    return faults


def _strikes(subject: Subject, block: int, wires: list[BlockKind]) -> list[Violation]:
    needles = subject.needles_mm[block]
    allowed = subject.clearance_mm
    distance = np.full(len(needles), np.inf)
    for wire in wires:
        nearest = subject.halves[wire].nearest(needles, allowed)
        distance = np.minimum(distance, nearest.distance_mm)
    message = "the needle strikes wire: too near to its centreline"
    return [
        subject.fault(
            "needle-on-wire", message, block, int(i), actual=float(distance[i]), allowed=allowed
        )
        for i in np.flatnonzero(distance < allowed - _ROUNDOFF_MM)
    ]
