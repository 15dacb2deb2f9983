"""The whole plan: marks, then the stages of the wire with covers in between, then stripes."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from patterns.circuit import Circuit, CrossingKind
from patterns.couching import FREE_TAIL_MM, needle_clearance_mm
from patterns.cover import covers
from patterns.errors import NoRoomError, PatternError
from patterns.instructions import MARKS_TEXT, STRIPES_TEXT, Instructions
from patterns.laid_wire import LaidWire, all_laid, laid_wire
from patterns.machine import Machine
from patterns.mark_stitches import mark_stitches
from patterns.path import Vectors
from patterns.plan import UNITS_PER_MM, Block, BlockKind, StitchPlan
from patterns.registration import Mark
from patterns.room import roomy_diameter_mm
from patterns.sewn_run import thread_run, wire_run
from patterns.stitching import Stitching
from patterns.stripes import ANGLE_DEG, stripes
from patterns.tied_down import tied_down


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
    laid = _laid_by_stage(circuit)
    tied = _with_room(circuit, partial(_tied_down, clear, machine, stitching))
    satin = [
        covers(
            circuit,
            stage,
            laid[stage - 1],
            clear_mm=clear,
            wire_diameter_mm=wire_diameter_mm,
            stitching=stitching,
        )
        for stage in range(1, len(laid))
    ]
    say = Instructions(circuit, wire_diameter_mm, machine, satin)
    blocks = [*_mark_blocks(marks, stitching, machine)]
    for stage, points in enumerate(tied):
        if stage:
            runs = tuple(thread_run(own, machine) for own in satin[stage - 1])
            blocks.append(Block(BlockKind.COVER, say.cover(stage), runs, stage))
        run = wire_run(points, machine)
        blocks.append(Block(BlockKind.WIRE, say.wire(stage), (run,), stage))
    blocks.extend(_stripe_blocks(circuit, laid[-1], clear, machine, stitching))
    for block in blocks:
        if block.kind is BlockKind.STRIPES:
            _check_clear(block, laid[-1], clear - stitching.needle_margin_mm)
        elif block.kind is BlockKind.COVER or (block.kind.is_wire and machine.couching == "zigzag"):
            before = block.kind is BlockKind.COVER
            _check_clear(block, laid[block.stage - before], clear - stitching.needle_margin_mm)
    return StitchPlan(tuple(blocks))


def _laid_by_stage(circuit: Circuit) -> list[LaidWire]:
    """All wire that lies there once each stage is laid."""
    parts = [laid_wire(stage) for stage in circuit.stages]
    return [all_laid(parts[: k + 1]) for k in range(len(parts))]


def _tied_down(
    clear_mm: float, machine: Machine, stitching: Stitching, circuit: Circuit
) -> list[Vectors]:
    laid = _laid_by_stage(circuit)
    return tied_down(circuit, laid, clear_mm=clear_mm, machine=machine, stitching=stitching)


def _with_room(circuit: Circuit, tie: Callable[[Circuit], list[Vectors]]) -> list[Vectors]:
    """Tie down; without room for the needle, say how large the loops must be."""

    def has_room(larger: Circuit) -> bool:
        try:
            tie(larger)
        except NoRoomError:
            return False
        return True

    try:
        return tie(circuit)
    except NoRoomError as error:
        diameter = roomy_diameter_mm(circuit, has_room)
        if diameter is None:
            raise
        raise NoRoomError(
            f"{error}; all else as it is, loops of {diameter:g} mm or so are the smallest with room"
        ) from None


def _stripe_blocks(
    circuit: Circuit, laid: LaidWire, clear_mm: float, machine: Machine, stitching: Stitching
) -> tuple[Block, ...]:
    if stitching.stripes == "none":
        return ()
    sewn = stripes(
        circuit.layout.loops,
        laid,
        angle_deg=ANGLE_DEG[stitching.stripes],
        clear_mm=clear_mm,
        longest_mm=machine.longest_stitch_mm,
        stitching=stitching,
    )
    runs = tuple(thread_run(own, machine) for own in sewn)
    return (Block(BlockKind.STRIPES, STRIPES_TEXT, runs),)


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
    if machine.couching == "centreline" and machine.swing_mm < 2 * clear_mm:
        raise PatternError(
            f"the needle swings by machine.swing_mm = {machine.swing_mm:g} mm and would strike the "
            f"wire: wire, needle and margin need {2 * clear_mm:.3f} mm"
        )


def _mark_blocks(
    marks: tuple[Mark, ...], stitching: Stitching, machine: Machine
) -> tuple[Block, ...]:
    runs = tuple(
        thread_run(points, machine)
        for mark in marks
        for points in mark_stitches(mark, stitching.lock_length_mm)
    )
    return (Block(BlockKind.MARKS, MARKS_TEXT, runs),) if runs else ()


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
