"""Everything is sewn inside the field of the hoop."""

from __future__ import annotations

import numpy as np

from patterns.path import Vectors
from patterns.plan import UNITS_PER_MM, Block
from patterns.rules.subject import Subject
from patterns.violation import Violation

_RULE = "hoop"
_ROUNDOFF_MM = 1e-9


def check_hoop(subject: Subject) -> list[Violation]:
    """Every needle point, and every place to which the machine jumps, lies in the field."""
    faults: list[Violation] = []
    for i, block in enumerate(subject.plan.blocks):
        faults.extend(_outside(subject, i, subject.needles_mm[i], "needle point", counted=True))
        approaches = _approaches_mm(block)
        faults.extend(_outside(subject, i, approaches, "end of the jumps", counted=False))
    return faults


def _approaches_mm(block: Block) -> Vectors:
    return np.array([run.approach for run in block.runs]).reshape(-1, 2) / UNITS_PER_MM


def _outside(
    subject: Subject, block: int, places_mm: Vectors, what: str, *, counted: bool
) -> list[Violation]:
    half = np.array(subject.machine.field_mm) / 2
    beyond = np.abs(places_mm) - half
    message = f"the {what} is outside the hoop's field; distance from its centre along one axis"
    faults: list[Violation] = []
    for i in np.flatnonzero(beyond.max(axis=1) > _ROUNDOFF_MM):
        x, y = places_mm[i]
        axis = int(np.argmax(beyond[i]))
        stitch = int(i) if counted else None
        found = float(abs(places_mm[i, axis])), float(half[axis])
        faults.append(Violation(_RULE, message, float(x), float(y), block, stitch, *found))
    return faults
