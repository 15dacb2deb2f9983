"""The whole plan: marks, stages of the wire with covers in between, then stripes and ties."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from patterns.circuit import Circuit, CrossingKind, Diameters
from patterns.contact_ties import contact_ties
from patterns.couching import FREE_TAIL_MM, needle_clearance_mm
from patterns.cover import covers
from patterns.errors import NoRoomError, PatternError
from patterns.instructions import MARKS_TEXT, STRIPES_TEXT, Instructions, with_thread
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

_ROUND_OFF_MM = 1e-9


def stitch_plan(
    circuit: Circuit,
    stitching: Stitching,
    machine: Machine,
    wire_diameter_mm: Diameters,
    marks: tuple[Mark, ...],
) -> StitchPlan:
    """Plan every stitch of an array.

    Parameters
    ----------
    wire_diameter_mm
        Of all circuits, or of each.
    marks
        Registration marks, sewn first; without any there is no block for them.

    Raises
    ------
    PatternError
        When a setting leaves the wire no room, the needle finds no place beside the wire, or a
        rounded needle point comes nearer to a wire than half the wire and half the needle.
    """
    diameters = circuit.of_stages(wire_diameter_mm)
    clear = [needle_clearance_mm(own, machine, stitching) for own in diameters]
    _check_settings(circuit, stitching, machine, clear)
    laid = _laid_by_stage(circuit, diameters)
    tied = _with_room(circuit, partial(_tied_down, diameters, clear, machine, stitching))
    satin = _satin(circuit, laid, clear, diameters, stitching)
    say = Instructions(circuit, diameters, machine, satin)
    blocks = [*_mark_blocks(marks, stitching, machine)]
    for stage, points in enumerate(tied):
        if stage and satin[stage - 1]:
            runs = tuple(thread_run(own, machine) for own in satin[stage - 1])
            blocks.append(Block(BlockKind.COVER, say.cover(stage), runs, stage))
        run = wire_run(points, machine)
        blocks.append(Block(BlockKind.WIRE, say.wire(stage), (run,), stage))
    thickest = laid[-1].like(max(diameters))
    blocks.extend(_stripe_blocks(circuit, thickest, max(clear), machine, stitching))
    blocks.extend(_tie_blocks(circuit, thickest, max(clear), machine, stitching))
    for block in blocks:
        if block.kind is BlockKind.MARKS or (block.kind.is_wire and machine.couching != "zigzag"):
            continue
        wire = laid[_last_below(block, circuit)].like(0.0)
        _check_clear(block, wire, machine.needle_diameter_mm / 2)
    return StitchPlan(tuple(blocks))


def _laid_by_stage(circuit: Circuit, diameters_mm: tuple[float, ...]) -> list[LaidWire]:
    """All wire that lies there once each stage is laid; distances are as to that stage's."""
    parts = [
        laid_wire(stage, wire_diameter_mm=own)
        for stage, own in zip(circuit.stages, diameters_mm, strict=True)
    ]
    return [all_laid(parts[: k + 1]) for k in range(len(parts))]


def _tied_down(
    diameters_mm: tuple[float, ...],
    clear_mm: list[float],
    machine: Machine,
    stitching: Stitching,
    circuit: Circuit,
) -> list[Vectors]:
    laid = _laid_by_stage(circuit, diameters_mm)
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


def _satin(
    circuit: Circuit,
    laid: list[LaidWire],
    clear_mm: list[float],
    diameters_mm: tuple[float, ...],
    stitching: Stitching,
) -> list[list[Vectors]]:
    """Needle points of the covers before each stage but the first, the newest wire first."""
    satin: list[list[Vectors]] = []
    for stage, own_mm in enumerate(diameters_mm[1:], start=1):
        points: list[Vectors] = []
        for part in reversed(range(circuit.part_of_stage[stage] + 1)):
            if not circuit.crossings_of(stage, part):
                continue
            under = circuit.part_of_stage.index(part)
            points += covers(
                circuit,
                stage,
                laid[stage - 1].like(diameters_mm[under]),
                clear_mm=clear_mm[under],
                wire_diameter_mm=(diameters_mm[under] + own_mm) / 2,
                stitching=stitching,
                part=part,
            )
        satin.append(points)
    return satin


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
    return (Block(BlockKind.STRIPES, with_thread(machine, STRIPES_TEXT), runs),)


def _tie_blocks(
    circuit: Circuit, laid: LaidWire, clear_mm: float, machine: Machine, stitching: Stitching
) -> tuple[Block, ...]:
    if stitching.ties == "none":
        return ()
    block = contact_ties(
        circuit.layout, laid, clear_mm=clear_mm, machine=machine, stitching=stitching
    )
    return () if block is None else (block,)


def _check_settings(
    circuit: Circuit, stitching: Stitching, machine: Machine, clear_mm: list[float]
) -> None:
    first = circuit.parts[0].crossings
    tail = next(c for c in first if c.kind is CrossingKind.TERMINALS).first_mm
    if tail < FREE_TAIL_MM:
        raise PatternError(
            f"the tails are {tail:g} mm long; the crimp alone takes {FREE_TAIL_MM:g} mm"
        )
    if min(stitching.couching_interval_mm, stitching.cover_spacing_mm) <= 0:
        raise PatternError("couching interval and cover spacing must be longer than 0 mm")
    narrowest, widest = 2 * min(clear_mm), 2 * max(clear_mm)
    if machine.shortest_stitch_mm > narrowest:
        raise PatternError(
            f"a stitch over the wire is {narrowest:.2f} mm long, and the machine's shortest is "
            f"{machine.shortest_stitch_mm:g} mm: it would merge the stitches that hold the wire"
        )
    if machine.couching == "centreline" and machine.swing_mm < widest:
        raise PatternError(
            f"the needle swings by machine.swing_mm = {machine.swing_mm:g} mm and would strike the "
            f"wire: wire, needle and margin need {widest:.3f} mm"
        )


def _mark_blocks(
    marks: tuple[Mark, ...], stitching: Stitching, machine: Machine
) -> tuple[Block, ...]:
    runs = tuple(
        thread_run(points, machine)
        for mark in marks
        for points in mark_stitches(mark, stitching.lock_length_mm)
    )
    return (Block(BlockKind.MARKS, with_thread(machine, MARKS_TEXT), runs),) if runs else ()


def _last_below(block: Block, circuit: Circuit) -> int:
    """Give the last stage that lies there when a block is sewn; its own, if it lays one."""
    if block.kind in (BlockKind.STRIPES, BlockKind.TIES):
        return len(circuit.stages) - 1
    return block.stage - (block.kind is BlockKind.COVER)


def _check_clear(block: Block, laid: LaidWire, smallest_mm: float) -> None:
    needles = np.concatenate([run.needles for run in block.runs]) / UNITS_PER_MM
    distance = laid.distance_mm(needles, smallest_mm)
    if np.any(distance < smallest_mm - _ROUND_OFF_MM):
        k = int(np.argmin(distance))
        raise PatternError(
            f"{block.kind}: rounded to 0.1 mm, the middle of the needle at ({needles[k, 0]:.1f}, "
            f"{needles[k, 1]:.1f}) mm is {distance[k]:.3f} mm from the surface of a wire, and the "
            f"needle needs {smallest_mm:.3f} mm: take a larger needle margin"
        )
