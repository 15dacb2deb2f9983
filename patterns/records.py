"""The flat list of what the machine does, record by record, as stitch files hold it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from patterns.errors import PatternError
from patterns.machine import DST_LARGEST_STEP_MM, Machine
from patterns.plan import UNITS_PER_MM, Block, BlockKind, Points, Run, StitchPlan

LARGEST_STEP = round(DST_LARGEST_STEP_MM * UNITS_PER_MM)
"""Largest displacement of one record along each axis, in units of 0.1 mm."""


class Command(StrEnum):
    """What the machine does on one record."""

    STITCH = "stitch"
    JUMP = "jump"
    STOP = "stop"
    END = "end"


@dataclass(frozen=True, eq=False)
class Records:
    """Everything the machine does, starting at (0, 0).

    Attributes
    ----------
    command : array of str (n,)
        Values of `Command`.
    xy : Points
        Where the machine stands after the record, absolute, shape (n, 2), in units of 0.1 mm.
    """

    command: NDArray[np.str_]
    xy: Points

    def same_as(self, other: Records) -> bool:
        """Whether the machine does the same, record by record."""
        return np.array_equal(self.command, other.command) and np.array_equal(self.xy, other.xy)


def plan_records(plan: StitchPlan, machine: Machine) -> Records:
    """List the records of a plan.

    Travel between runs is made of equal jumps, at least `Machine.jumps_per_trim` of them so that
    the thread is trimmed. Between blocks there is one stop: after the jumps where a wire block
    begins, for the operator mounts the wire where the machine stands; before the jumps where one
    ends, for the machine must not tear at wire that is still held.

    Raises
    ------
    PatternError
        When the plan, a block or a run is empty, or a stitch is too long for one record.
    """
    _check_blocks(plan)
    parts = [*_listing(plan, max(1, machine.jumps_per_trim))]
    xy = np.concatenate([points for _, points in parts])
    command = np.repeat(
        np.array([str(what) for what, _ in parts]), [len(points) for _, points in parts]
    )
    _check_steps(xy)
    return Records(command, xy)


def plan_from_records(records: Records, expected: Sequence[Block]) -> StitchPlan:
    """Read a plan back from its records.

    Parameters
    ----------
    expected
        What the blocks are for, and what the operator does before each: stitch files do not say.
        The runs of these blocks are not looked at.

    Raises
    ------
    PatternError
        When there are not as many blocks with stitches as are expected.
    """
    first, last, approach = _stretches(records)
    stops = np.cumsum(records.command == Command.STOP)
    blocks = int(stops[-1]) + 1 if len(stops) else 0
    filled = np.unique(stops[first])
    if not (len(expected) == blocks == len(filled)):
        raise PatternError(
            f"the stitches are in {len(filled)} of {blocks} blocks between the machine's stops; "
            f"expected {len(expected)} blocks ({', '.join(block.kind for block in expected)})"
        )
    runs: list[list[Run]] = [[] for _ in expected]
    for begin, end, start in zip(first, last, approach, strict=True):
        run = Run((int(start[0]), int(start[1])), records.xy[begin : end + 1].copy())
        runs[int(stops[begin])].append(run)
    return StitchPlan(
        tuple(replace(block, runs=tuple(own)) for block, own in zip(expected, runs, strict=True))
    )


def _stretches(records: Records) -> tuple[NDArray[np.intp], NDArray[np.intp], Points]:
    """Give first and last record of every row of stitches, and where the machine stood before."""
    sewing = np.pad(records.command == Command.STITCH, 1)
    first = np.flatnonzero(sewing[1:-1] & ~sewing[:-2])
    last = np.flatnonzero(sewing[1:-1] & ~sewing[2:])
    before = np.concatenate([np.zeros((1, 2), dtype=np.int64), records.xy])
    return first, last, before[first]


def _listing(plan: StitchPlan, trim: int) -> Iterator[tuple[Command, Points]]:
    """Give stretches of equal records, one after the other."""
    here = np.zeros((1, 2), dtype=np.int64)
    for before, block in zip((None, *plan.blocks), plan.blocks, strict=False):
        for k, run in enumerate(block.runs):
            approach = np.array([run.approach], dtype=np.int64)
            travel = (Command.JUMP, _jumps(here, approach, trim if before or k else 0))
            if before is None or k:
                yield travel
            elif _jumps_before_stop(before.kind, block.kind):
                yield from (travel, (Command.STOP, approach))
            else:
                yield from ((Command.STOP, here), travel)
            yield Command.STITCH, run.needles
            here = run.needles[-1:]
    yield Command.END, here


def _jumps_before_stop(before: BlockKind, after: BlockKind) -> bool:
    """Whether the machine travels before it stops: to new wire, but never away from held wire."""
    return after.is_wire and not before.is_wire


def _jumps(start: Points, end: Points, fewest: int) -> Points:
    """Divide the way into equal jumps, none longer than a record can hold."""
    step = end - start
    count = max(fewest, -(-int(np.abs(step).max()) // LARGEST_STEP))
    part = np.arange(1, count + 1)[:, None]
    return start + (2 * step * part + count) // (2 * max(count, 1))


def _check_blocks(plan: StitchPlan) -> None:
    if not plan.blocks:
        raise PatternError("the plan has no blocks: there is nothing to sew")
    for k, block in enumerate(plan.blocks):
        if not block.runs or any(len(run.needles) == 0 for run in block.runs):
            raise PatternError(f"block {k} ({block.kind}) holds a run without stitches, or no run")


def _check_steps(xy: Points) -> None:
    step = np.abs(np.diff(xy, axis=0, prepend=0)).max(axis=1)
    if np.any(step > LARGEST_STEP):
        x, y = xy[int(np.argmax(step))] / UNITS_PER_MM
        raise PatternError(
            f"the stitch to ({x:.1f}, {y:.1f}) mm moves {step.max() / UNITS_PER_MM:.1f} mm along "
            f"one axis; one record holds {DST_LARGEST_STEP_MM} mm"
        )
