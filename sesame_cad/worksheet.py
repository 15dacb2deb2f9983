"""What the operator's worksheet says, before it is laid on paper."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import ceil

import numpy as np

from patterns.plan import UNITS_PER_MM, Block
from patterns.records import Command, Records
from sesame_cad.electrics_data import circuit_resistances_ohm
from sesame_cad.pipeline import Design, extent_mm
from sesame_cad.threads import Thread, threads_of

Rows = tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class BlockRow:
    """A block of stitches, and the stop before it.

    Attributes
    ----------
    number : int
        From 1.
    thread : Thread
    stitches : int
    minutes : float
        Of the stop and the stitches.
    instruction : str
        What the operator does at the stop.
    """

    number: int
    thread: Thread
    stitches: int
    minutes: float
    instruction: str


@dataclass(frozen=True)
class Worksheet:
    """A worksheet's words.

    Attributes
    ----------
    title : str
    facts, materials : tuples of (str, str)
        Names and values.
    blocks : tuple of BlockRow
        In the order of sewing.
    notes : str
        The maker's own.
    """

    title: str
    facts: Rows
    materials: Rows
    blocks: tuple[BlockRow, ...]
    notes: str


def worksheet(design: Design, records: Records) -> Worksheet:
    """Collect what the operator needs.

    Parameters
    ----------
    records : Records
        What the stitch files hold.
    """
    return Worksheet(
        design.spec.name,
        (*_job(design, records), *_sizes(design), *_lengths(design)),
        tuple(_materials(design)),
        tuple(_blocks(design)),
        design.spec.output.notes,
    )


def _job(design: Design, records: Records) -> Iterator[tuple[str, str]]:
    spec, plan, pace = design.spec, design.pattern.plan, design.spec.machine.pace
    stitches = int((records.command == Command.STITCH).sum())
    stops = int((records.command == Command.STOP).sum())
    yield "stitch files", ", ".join(f"{spec.name}.{kind}" for kind in spec.output.formats)
    yield "machine", spec.machine.name
    yield "hoop, inside", _size(spec.machine.hoop_width_mm, spec.machine.hoop_height_mm)
    yield "stitches", f"{stitches} in {len(plan.blocks)} blocks, {stops} stops"
    yield (
        "time, estimated",
        f"{ceil(pace.plan_s(plan) / 60)} min, at {pace.thread_spm:g} stitches a minute, "
        f"{pace.wire_spm:g} with wire, and {pace.stop_time_s:g} s before each block",
    )


def _sizes(design: Design) -> Iterator[tuple[str, str]]:
    wire = design.spec.wire.diameter_mm
    left, bottom, right, top = design.pattern.outline.bounds_mm
    yield "sewn, with marks", _size(*extent_mm(design.pattern.plan))
    yield "stretched, in the hoop", _size(right - left, top - bottom)
    for state in design.states:
        width, depth = state.footprint_mm
        kind = "relaxed, cold" if state.name == "cold" else "heated"
        rise = f"{state.height_mm + wire:.1f} mm high" if state.buckled else "flat"
        yield kind, f"{_size(width + wire, depth + wire)}, {rise}"


def _lengths(design: Design) -> Iterator[tuple[str, str]]:
    yield from _wires(design)
    lengths: dict[str, float] = {}
    plan = design.pattern.plan
    for block, thread in zip(plan.blocks, threads_of(plan, design.spec.machine), strict=True):
        spool = "thread that ties the wire" if block.kind.is_wire else thread.material
        lengths[spool] = lengths.get(spool, 0.0) + _sewn_mm(block)
    for spool, length in lengths.items():
        yield spool, f"{length / 1000:.2f} m from needle point to needle point"


def _wires(design: Design) -> Iterator[tuple[str, str]]:
    """Give length and resistance of each circuit's wire."""
    circuit = design.pattern.circuit
    wires = design.spec.wires(len(circuit.parts))
    resistances = circuit_resistances_ohm(design.spec, circuit)
    several = len(circuit.parts) > 1
    for k, part in enumerate(circuit.parts):
        of = f" of circuit {circuit.part_names[k]}" if several else ""
        cold, hot = resistances[k]
        yield (
            f"wire to load{of}",
            f"{ceil(part.wire_length_mm)} mm of {wires[k].diameter_mm:g} mm, with two tails of "
            f"{design.spec.stitching.tail_length_mm:g} mm, and the slack of its first block",
        )
        yield f"resistance{of}", f"{cold:.2f} Ω cold, {hot:.2f} Ω hot"


def _sewn_mm(block: Block) -> float:
    """Way of the needle in a block, without jumps."""
    steps = (np.diff(run.needles, axis=0) for run in block.runs)
    return sum(float(np.hypot(*step.T).sum()) for step in steps) / UNITS_PER_MM


def _materials(design: Design) -> Iterator[tuple[str, str]]:
    fabric, wire = design.spec.fabric, design.spec.wire
    yield "fabric", f"{fabric.thickness_mm:g} mm before it is stretched"
    yield "fabric's modulus, Poisson's ratio", f"{fabric.modulus_kPa:g} kPa, {fabric.poisson:g}"
    yield "strain in the hoop", f"{100 * fabric.prestrain:g} % both ways"
    yield "wire", f"{wire.diameter_mm:g} mm, transition at {wire.transition_C:g} °C"
    yield "wire's modulus", f"{wire.modulus_cold_GPa:g} GPa cold, {wire.modulus_hot_GPa:g} GPa hot"


def _blocks(design: Design) -> Iterator[BlockRow]:
    plan, machine = design.pattern.plan, design.spec.machine
    for k, (block, thread) in enumerate(zip(plan.blocks, threads_of(plan, machine), strict=True)):
        stitches = sum(len(run.needles) for run in block.runs)
        minutes = machine.pace.block_s(block) / 60
        yield BlockRow(k + 1, thread, stitches, minutes, block.instruction)


def _size(width_mm: float, height_mm: float) -> str:
    return f"{width_mm:.1f} × {height_mm:.1f} mm"
