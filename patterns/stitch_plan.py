"""The whole plan: marks, then the stages of the wire with covers in between."""

from __future__ import annotations

import numpy as np

from patterns.circuit import Circuit, CrossingKind, Diameters
from patterns.couching import FREE_TAIL_MM, LEFT, RIGHT, couching, needle_clearance_mm
from patterns.cover import covers
from patterns.errors import PatternError
from patterns.instructions import MARKS_TEXT, Instructions
from patterns.laid_wire import LaidWire, all_laid, laid_wire
from patterns.machine import Machine
from patterns.mark_stitches import mark_stitches
from patterns.path import Vectors, WirePath
from patterns.plan import UNITS_PER_MM, Block, BlockKind, StitchPlan
from patterns.registration import Mark
from patterns.sewn_run import thread_run, wire_run
from patterns.stitching import Stitching

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
    _check_settings(circuit, stitching, machine, min(clear))
    parts = [
        laid_wire(stage, wire_diameter_mm=own)
        for stage, own in zip(circuit.stages, diameters, strict=True)
    ]
    laid = [all_laid(parts[: k + 1]) for k in range(len(parts))]
    tied = _tied_down(circuit, laid, clear, stitching)
    satin = _satin(circuit, laid, clear, diameters, stitching)
    say = Instructions(circuit, diameters, satin)
    blocks = [*_mark_blocks(marks, stitching, machine)]
    for stage, points in enumerate(tied):
        if stage and satin[stage - 1]:
            runs = tuple(thread_run(own, machine) for own in satin[stage - 1])
            blocks.append(Block(BlockKind.COVER, say.cover(stage), runs, stage))
        run = wire_run(points, machine)
        blocks.append(Block(BlockKind.WIRE, say.wire(stage), (run,), stage))
    for block in blocks:
        if block.kind is not BlockKind.MARKS:
            before = block.kind is BlockKind.COVER
            wire = laid[block.stage - before].like(0.0)
            _check_clear(block, wire, machine.needle_diameter_mm / 2)
    return StitchPlan(tuple(blocks))


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


def _tied_down(
    circuit: Circuit, laid: list[LaidWire], clear_mm: list[float], stitching: Stitching
) -> list[Vectors]:
    """Needle points of the couching of every stage; the free ends of the tails have none."""
    tied: list[Vectors] = []
    for stage, wire in enumerate(circuit.stages):
        begins = circuit.begins_wire(stage)
        begin = FREE_TAIL_MM if begins else 0.0
        end = wire.length_mm - (FREE_TAIL_MM if circuit.ends_wire(stage) else 0.0)
        # Not into the last hole of the stage before, whose lock it would loosen.
        side = LEFT if begins else _other_side(wire, tied[-1][-1])
        clear = clear_mm[stage]
        tied.append(
            couching(wire, (begin, end), side, laid[stage], clear_mm=clear, stitching=stitching)
        )
    return tied


def _check_settings(
    circuit: Circuit, stitching: Stitching, machine: Machine, clear_mm: float
) -> None:
    first = circuit.parts[0].crossings
    tail = next(c for c in first if c.kind is CrossingKind.TERMINALS).first_mm
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


def _other_side(wire: WirePath, needle_mm: Vectors) -> float:
    """Side of a wire's start on which a needle point does not lie."""
    point, tangent = wire.at(0.0)
    (x, y), (tx, ty) = needle_mm - point[0], tangent[0]
    return RIGHT if tx * y - ty * x > 0 else LEFT


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
    if np.any(distance < smallest_mm - _ROUND_OFF_MM):
        k = int(np.argmin(distance))
        raise PatternError(
            f"{block.kind}: rounded to 0.1 mm, the middle of the needle at ({needles[k, 0]:.1f}, "
            f"{needles[k, 1]:.1f}) mm is {distance[k]:.3f} mm from the surface of a wire, and the "
            f"needle needs {smallest_mm:.3f} mm: take a larger needle margin"
        )
