"""Threads are locked where they begin and end."""

from __future__ import annotations

import numpy as np

from patterns.path import Vectors
from patterns.plan import UNITS_PER_MM
from patterns.rules.subject import Subject
from patterns.stitching import ROUNDING_MM
from patterns.violation import Violation

LONGEST_LOCK_MM = 1.0
"""A longer stitch back and forth is no lock."""

_LOOK_AT = 6


def check_locks(subject: Subject) -> list[Violation]:
    """Every run begins and ends with a small stitch forth and back to the same hole."""
    faults: list[Violation] = []
    for i, block in enumerate(subject.plan.blocks):
        start = 0
        for run in block.runs:
            needles = run.needles / UNITS_PER_MM
            end = start + len(needles)
            if len(needles) and not _is_locked(needles[:_LOOK_AT]):
                message = "the thread is not locked where the run begins"
                faults.append(subject.fault("locks", message, i, start))
            if len(needles) and not _is_locked(needles[::-1][:_LOOK_AT]):
                message = "the thread is not locked where the run ends"
                faults.append(subject.fault("locks", message, i, end - 1))
            start = end
    return faults


def _is_locked(needles_mm: Vectors) -> bool:
    """Whether one of the first stitches is short and the next one leads back to where it began."""
    if len(needles_mm) < 3:
        return False
    out = np.hypot(*(needles_mm[1:-1] - needles_mm[:-2]).T)
    left = np.hypot(*(needles_mm[2:] - needles_mm[:-2]).T)
    short = (out > 0) & (out <= LONGEST_LOCK_MM + ROUNDING_MM)
    return bool(np.any(short & (left <= 2 * ROUNDING_MM)))
