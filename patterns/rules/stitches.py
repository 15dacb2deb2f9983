"""Stitches and runs that the machine can sew."""

from __future__ import annotations

import numpy as np

from patterns.path import Vectors
from patterns.plan import UNITS_PER_MM, Run
from patterns.rules.subject import Subject
from patterns.violation import Violation

_ROUNDOFF_MM = 1e-9


def check_stitch_length(subject: Subject) -> list[Violation]:
    """No stitch is longer along an axis, or shorter, than the machine sews."""
    faults: list[Violation] = []
    for i, block in enumerate(subject.plan.blocks):
        if block.runs:
            steps = np.concatenate([np.diff(_with_approach(run), axis=0) for run in block.runs])
            faults.extend(_too_long(subject, i, steps))
            faults.extend(_too_short(subject, i, steps))
    return faults


def _with_approach(run: Run) -> Vectors:
    return np.concatenate([np.array([run.approach]), run.needles]) / UNITS_PER_MM


def _too_long(subject: Subject, block: int, steps_mm: Vectors) -> list[Violation]:
    longest = np.abs(steps_mm).max(axis=1)
    allowed = subject.machine.longest_stitch_mm
    message = "the stitch is too long along one axis"
    return [
        subject.fault(
            "stitch-length", message, block, int(i), actual=float(longest[i]), allowed=allowed
        )
        for i in np.flatnonzero(longest > allowed + _ROUNDOFF_MM)
    ]


def _too_short(subject: Subject, block: int, steps_mm: Vectors) -> list[Violation]:
    length = np.hypot(steps_mm[:, 0], steps_mm[:, 1])
    allowed = subject.machine.shortest_stitch_mm
    message = "the stitch is too short: some machines drop the next one"
    return [
        subject.fault(
            "stitch-length", message, block, int(i), actual=float(length[i]), allowed=allowed
        )
        for i in np.flatnonzero(length < allowed - _ROUNDOFF_MM)
    ]


def check_runs(subject: Subject) -> list[Violation]:
    """Every block is sewn, without an empty run; a wire block in one run, without jump or trim."""
    faults: list[Violation] = []
    for i, block in enumerate(subject.plan.blocks):
        x, y = _first_place(block.runs)
        if not block.runs or any(len(run.needles) == 0 for run in block.runs):
            faults.append(Violation("runs", "a run has no stitches", x, y, i))
        if block.kind.is_wire and len(block.runs) > 1:
            message = "the machine jumps or trims inside a run of wire: number of runs"
            faults.append(Violation("runs", message, x, y, i, None, len(block.runs), 1))
    return faults


def _first_place(runs: tuple[Run, ...]) -> tuple[float, float]:
    """Where the block's last run starts: behind the jump, if there is one."""
    if not runs:
        return 0.0, 0.0
    x, y = runs[-1].approach
    return x / UNITS_PER_MM, y / UNITS_PER_MM
