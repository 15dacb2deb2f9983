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
from sesame_cad.threads import Thread, thread_of

Rows = tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class Pace:
    """How fast the work goes; assumptions for the estimate of time, not properties of a machine.

    Attributes
    ----------
    stitches_per_minute : float
        Speed of the machine.
    seconds_per_stop : float
        What the operator takes for a stop.
    """

    stitches_per_minute: float = 600.0
    seconds_per_stop: float = 120.0

    def minutes(self, stitches: int, stops: int) -> float:
        """Time for some stitches and stops."""
        return stitches / self.stitches_per_minute + stops * self.seconds_per_stop / 60


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


_DEFAULT_PACE = Pace()


def worksheet(design: Design, records: Records, pace: Pace = _DEFAULT_PACE) -> Worksheet:
    """Collect what the operator needs.

    Parameters
    ----------
    records : Records
        What the stitch files hold.
    """
    return Worksheet(
        design.spec.name,
        (*_job(design, records, pace), *_sizes(design), *_lengths(design)),
        tuple(_materials(design)),
        tuple(_blocks(design, pace)),
        design.spec.output.notes,
    )


def _job(design: Design, records: Records, pace: Pace) -> Iterator[tuple[str, str]]:
    spec, plan = design.spec, design.pattern.plan
    stitches = int((records.command == Command.STITCH).sum())
    stops = int((records.command == Command.STOP).sum())
    yield "stitch files", ", ".join(f"{spec.name}.{kind}" for kind in spec.output.formats)
    yield "machine", spec.machine.name
    yield "hoop, inside", _size(spec.machine.hoop_width_mm, spec.machine.hoop_height_mm)
    yield "stitches", f"{stitches} in {len(plan.blocks)} blocks, {stops} stops"
    yield (
        "time, estimated",
        f"{ceil(pace.minutes(stitches, stops))} min, at {pace.stitches_per_minute:g} stitches a "
        f"minute and {pace.seconds_per_stop:g} s a stop",
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
    for block in design.pattern.plan.blocks:
        thread = thread_of(block)
        spool = "thread that ties the wire" if thread.head == "wire" else thread.material
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


def _blocks(design: Design, pace: Pace) -> Iterator[BlockRow]:
    for number, block in enumerate(design.pattern.plan.blocks, start=1):
        stitches = sum(len(run.needles) for run in block.runs)
        minutes = pace.minutes(stitches, int(number > 1))
        yield BlockRow(number, thread_of(block), stitches, minutes, block.instruction)


def _size(width_mm: float, height_mm: float) -> str:
    return f"{width_mm:.1f} × {height_mm:.1f} mm"
