"""From needle points in millimetres to a run in machine units that the machine can sew."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from patterns.errors import PatternError
from patterns.machine import Machine
from patterns.plan import UNITS_PER_MM, Points, Run, quantise

APPROACH_MM = 1.0
"""The machine arrives so far before the first needle point, which is then a stitch of its own."""

ROUND_OFF = 1e-9


def thread_run(points_mm: NDArray[np.float64], machine: Machine) -> Run:
    """Round, merge stitches that are too short and split those that are too long.

    Raises
    ------
    PatternError
        When fewer than two needle points are left.
    """
    return _run(_split_long(_merge_short(quantise(points_mm), machine), machine))


def wire_run(points_mm: NDArray[np.float64], machine: Machine) -> Run:
    """Round and merge as `thread_run`; a needle point more would be on the wire.

    Raises
    ------
    PatternError
        When fewer than two needle points are left, or a stitch is too long for the machine.
    """
    needles = _merge_short(quantise(points_mm), machine)
    step = np.abs(np.diff(needles, axis=0)).max(axis=1, initial=0)
    if np.any(step > _longest(machine)):
        x, y = needles[int(np.argmax(step))] / UNITS_PER_MM
        raise PatternError(
            f"the stitch over the wire at ({x:.1f}, {y:.1f}) mm is {step.max() / UNITS_PER_MM:.1f} "
            f"mm long along one axis, and the machine sews {machine.longest_stitch_mm:g} mm: "
            f"take a shorter couching interval"
        )
    return _run(needles)


def _longest(machine: Machine) -> int:
    return int(machine.longest_stitch_mm * UNITS_PER_MM + ROUND_OFF)


def _merge_short(needles: Points, machine: Machine) -> Points:
    """Leave out needle points too near the one before; those that stay are not moved."""
    shortest = machine.shortest_stitch_mm * UNITS_PER_MM - ROUND_OFF
    if np.all(np.hypot(*np.diff(needles, axis=0).T) >= shortest):
        return needles
    kept = [0]
    for k in range(1, len(needles)):
        if np.hypot(*(needles[k] - needles[kept[-1]])) >= shortest:
            kept.append(k)
    return needles[kept]


def _split_long(needles: Points, machine: Machine) -> Points:
    """Divide stitches into equal ones of a length that the machine sews."""
    step = np.diff(needles, axis=0)
    count = -(-np.abs(step).max(axis=1, initial=0) // _longest(machine))
    if np.all(count <= 1):
        return needles
    start = np.repeat(needles[:-1], count, axis=0)
    part = np.concatenate([np.arange(1, n + 1) / n for n in count])
    between = start + np.floor(np.repeat(step, count, axis=0) * part[:, None] + 0.5)
    return np.concatenate([needles[:1], between.astype(np.int64)])


def _run(needles: Points) -> Run:
    if len(needles) < 2:
        raise PatternError("a run of less than two needle points holds nothing: it is too short")
    ahead = (needles[1] - needles[0]) / np.hypot(*(needles[1] - needles[0]))
    x, y = quantise(needles[0] / UNITS_PER_MM - APPROACH_MM * ahead)
    return Run((int(x), int(y)), needles)
