"""The whole plan: marks, first half of the wire, covers, second half."""

from __future__ import annotations

from math import ceil

import numpy as np

from patterns.circuit import Circuit, CrossingKind
from patterns.couching import FREE_TAIL_MM, LEFT, RIGHT, couching, needle_clearance_mm
from patterns.cover import covers
from patterns.errors import PatternError
from patterns.laid_wire import LaidWire, laid_wire
from patterns.machine import Machine
from patterns.mark_stitches import mark_stitches
from patterns.path import Vectors
from patterns.plan import UNITS_PER_MM, Block, BlockKind, Run, StitchPlan
from patterns.registration import Mark
from patterns.sewn_run import thread_run, wire_run
from patterns.stitching import Stitching


def stitch_plan(
    circuit: Circuit,
    stitching: Stitching,
    machine: Machine,
    wire_diameter_mm: float,
    marks: tuple[Mark, ...],
) -> StitchPlan:
    """Plan every stitch of an array.

    Parameters
    ----------
    marks
        Registration marks, sewn first; without any there is no block for them.

    Raises
    ------
    PatternError
        When a setting leaves the wire no room, the needle finds no place beside the wire, or a
        rounded needle point comes nearer to a wire than half the wire and half the needle.
    """
    clear = needle_clearance_mm(wire_diameter_mm, machine, stitching)
    _check_settings(circuit, stitching, machine, clear)
    first, both = laid_wire(circuit.first_half), laid_wire(circuit.first_half, circuit.second_half)
    span = (FREE_TAIL_MM, circuit.first_half.length_mm)
    sewn_first = couching(
        circuit.first_half, span, LEFT, first, clear_mm=clear, stitching=stitching
    )
    satin = covers(circuit, first, clear, wire_diameter_mm, stitching)
    span = (0.0, circuit.second_half.length_mm - FREE_TAIL_MM)
    # Not into the last hole of the first half, whose lock it would loosen.
    side = _other_side(circuit, sewn_first[-1])
    sewn_second = couching(
        circuit.second_half, span, side, both, clear_mm=clear, stitching=stitching
    )
    say = _instructions(circuit, satin, wire_diameter_mm)
    blocks = (
        _block(BlockKind.WIRE_FIRST, say, (wire_run(sewn_first, machine),)),
        _block(BlockKind.COVER, say, tuple(thread_run(points, machine) for points in satin)),
        _block(BlockKind.WIRE_SECOND, say, (wire_run(sewn_second, machine),)),
    )
    for block, laid in zip(blocks, (first, first, both), strict=True):
        _check_clear(block, laid, clear - stitching.needle_margin_mm)
    return StitchPlan((*_mark_blocks(marks, stitching, machine, say), *blocks))


def _check_settings(
    circuit: Circuit, stitching: Stitching, machine: Machine, clear_mm: float
) -> None:
    tail = next(c for c in circuit.crossings if c.kind is CrossingKind.TERMINALS).first_mm
    if tail < FREE_TAIL_MM:
        raise PatternError(
            f"the tails are {tail:g} mm long; the crimp alone takes {FREE_TAIL_MM:g} mm"
        )
    if min(stitching.couching_interval_mm, stitching.cover_spacing_mm) <= 0:
        raise PatternError("couching interval and cover spacing must be longer than 0 mm")
    if machine.shortest_stitch_mm > 2 * clear_mm:
        raise PatternError(
            f"a stitch over the wire is {2 * clear_mm:.2f} mm long, and the machine's shortest is "
            f"{machine.shortest_stitch_mm:g} mm: it would merge the stitches that hold the wire"
        )


def _other_side(circuit: Circuit, needle_mm: Vectors) -> float:
    """Side of the second half's start on which a needle point does not lie."""
    point, tangent = circuit.second_half.at(0.0)
    (x, y), (tx, ty) = needle_mm - point[0], tangent[0]
    return RIGHT if tx * y - ty * x > 0 else LEFT


def _mark_blocks(
    marks: tuple[Mark, ...], stitching: Stitching, machine: Machine, say: dict[BlockKind, str]
) -> tuple[Block, ...]:
    runs = tuple(
        thread_run(points, machine)
        for mark in marks
        for points in mark_stitches(mark, stitching.lock_length_mm)
    )
    return (_block(BlockKind.MARKS, say, runs),) if runs else ()


def _block(kind: BlockKind, say: dict[BlockKind, str], runs: tuple[Run, ...]) -> Block:
    return Block(kind, say[kind], runs)


def _instructions(
    circuit: Circuit, satin: list[Vectors], wire_diameter_mm: float
) -> dict[BlockKind, str]:
    """Say what the operator does before each block."""
    split = circuit.second_half.at(0.0)[0]
    slack = ceil(np.hypot(*(np.concatenate(satin) - split).T).max())
    wire = ceil(circuit.wire_length_mm)
    tail = f"{FREE_TAIL_MM:g} mm"
    return {
        BlockKind.MARKS: (
            "Thread head, a thread that stands out against the fabric: the registration marks."
        ),
        BlockKind.WIRE_FIRST: (
            f"Wire head: load at least {wire} mm of {wire_diameter_mm:g} mm wire, both tails "
            f"included, and {slack} mm of slack. Let {tail} of wire stand out behind the needle, "
            f"for the crimp. The first half of the wire is laid."
        ),
        BlockKind.COVER: (
            f"Do not cut the wire: pull out at least {slack} mm of slack and hold it clear of the "
            f"needle. Thread head, cover thread: satin on the first half, {len(satin)} crossings."
        ),
        BlockKind.WIRE_SECOND: (
            f"Wire head, the same wire: take the slack back. The second half is laid. Then cut the "
            f"wire {tail} beyond the last stitch, and crimp both tails after release."
        ),
    }


def _check_clear(block: Block, laid: LaidWire, smallest_mm: float) -> None:
    needles = np.concatenate([run.needles for run in block.runs]) / UNITS_PER_MM
    distance = laid.distance_mm(needles, smallest_mm)
    if np.any(distance < smallest_mm):
        k = int(np.argmin(distance))
        raise PatternError(
            f"{block.kind}: rounded to 0.1 mm, the needle point ({needles[k, 0]:.1f}, "
            f"{needles[k, 1]:.1f}) mm is {distance[k]:.3f} mm from the centre of a wire, and "
            f"needle and wire need {smallest_mm:.3f} mm: take a larger needle margin"
        )
