"""The numbers of a design as plain data: what `design.json` holds."""

from __future__ import annotations

from collections import Counter
from typing import Any

from patterns.circuit import CrossingKind
from patterns.plan import BlockKind, StitchPlan
from patterns.records import Command, Records
from sesame_cad.answer_data import answer_data, solve_account
from sesame_cad.electrics_data import (
    circuit_resistances_ohm,
    circuits_data,
    electrics_data,
    in_parallel_ohm,
)
from sesame_cad.files.stitch_formats import LOSSES
from sesame_cad.omitted_data import omitted_data
from sesame_cad.pipeline import Design, Pattern, extent_mm
from sesame_cad.shape_state import ShapeState
from sesame_cad.specification import Specification
from sesame_cad.specification.machine import MachineSection
from sesame_cad.state import CellState
from sesame_cad.threads import THREADED
from solver.equilibrium import Equilibrium
from solver.ladder.answer import Rung
from solver.reading import Reading
from solver.threshold import critical_beta, critical_strain

Data = dict[str, Any]

STAGED = (BlockKind.WIRE, BlockKind.COVER)
"""Kinds of blocks that belong to a stage of the wire."""

FORMAT_VERSION = 2
"""Raised when a key of `design.json` changes its meaning."""


def design_data(design: Design, records: Records, files: dict[str, Data]) -> Data:
    """Everything in `design.json`.

    Parameters
    ----------
    records : Records
        What the stitch file holds.
    files : dict
        Size and hash of each file by its path in the design's folder.
    """
    spec = design.spec
    return {
        "format": FORMAT_VERSION,
        "name": spec.name,
        "strain": spec.fabric.prestrain,
        "poisson": spec.fabric.poisson,
        "reading": spec.model.reading,
        **_shape_data(design),
        "circuit": circuit_data(spec, design.pattern),
        "circuits": circuits_data(spec, design.pattern),
        "electrics": electrics_data(spec, design.pattern),
        "stitch": stitch_data(design.pattern.plan, records)
        | machine_data(spec.machine, design.pattern.plan),
        "losses": {kind: list(LOSSES[kind]) for kind in spec.output.formats},
        "outline": {
            "openings": len(design.pattern.outline.openings),
            "margin_mm": spec.outline.margin_mm,
        },
        "specification": spec.model_dump(mode="json"),
        "files": files,
    }


def _shape_data(design: Design) -> Data:
    """Keys of the shape; null in a design without one."""
    spec = design.spec
    if not design.states:
        keys = ("beta", "beta_hot", "scaling_mm", "threshold", "cold", "hot")
        return dict.fromkeys(keys)
    cold, hot = design.states
    beta, beta_hot = cold.materials.beta, hot.materials.beta
    oval = any(loop.axis_ratio != 1 for loop in design.pattern.circuit.layout.loops)
    return {
        "beta": beta,
        "beta_hot": beta_hot,
        "scaling_mm": spec.wire.diameter_mm**4 / spec.layout.diameter_mm**3,
        "threshold": None if oval else _threshold_data(spec, beta, beta_hot),
        "cold": state_data(cold),
        "hot": state_data(hot),
    }


def _threshold_data(spec: Specification, beta: float, beta_hot: float) -> Data:
    """When a circle buckles; the law is not that of an ellipse."""
    reading, poisson = Reading(spec.model.reading), spec.fabric.poisson
    return {
        "critical_beta": critical_beta(spec.fabric.prestrain, poisson, reading),
        "critical_strain_cold": critical_strain(beta, poisson, reading),
        "critical_strain_hot": critical_strain(beta_hot, poisson, reading),
    }


def loop_data(found: Equilibrium, seconds: float) -> Data:
    """Keys of one solved loop; those that need a length or a stiffness in SI units are null."""
    shape = found.shape
    return {
        "buckled": found.buckled,
        "height_mm": None,
        "height_over_perimeter": shape.height_over_perimeter,
        "height_over_radius": shape.height,
        "pitch_mm": None,
        "pitch_over_diameter": shape.width / 2,
        "energy_mJ": None,
        **solve_account(found),
        "height_change": found.height_change,
        "seconds": round(seconds, 6),
        "omitted_terms": omitted_data(found.omitted),
    }


def state_data(state: ShapeState) -> Data:
    """Keys of the array cold or hot; those over a radius are in that of the largest loop."""
    width, depth = state.footprint_mm
    heights = state.loop_heights_mm
    return _solve_data(state) | {
        "beta": state.materials.beta,
        "axial_stiffness": state.materials.axial_stiffness,
        "height_mm": state.height_mm,
        "loop_heights_mm": {
            "mean": sum(heights) / len(heights),
            "smallest": min(heights),
            "largest": max(heights),
        },
        "pitch_mm": state.pitch_mm,
        "footprint_mm": [width, depth],
        "energy_mJ": state.energy_mJ,
        "array_energy_mJ": state.array_energy_mJ,
        "omitted_terms": omitted_data(state.omitted),
    }


def _solve_data(state: ShapeState) -> Data:
    """How the shape was found; the same keys, and more for one of all loops together."""
    if isinstance(state, CellState):
        found = state.equilibrium
        more = {"rung": str(Rung.COMPACT), "height_error": found.height_change}
        return loop_data(found, state.seconds) | more
    pitch = state.pitch_mm
    return answer_data(state.answer, state.seconds) | {
        "height_error": state.height_error,
        "pitch_over_diameter": None if pitch is None else pitch / (2 * state.radius_mm),
    }


def circuit_data(spec: Specification, laid: Pattern) -> Data:
    """Keys of all wire together, with the crossings that thread covers.

    The resistance is that of all circuits in parallel.
    """
    circuit = laid.circuit
    insulated = Counter(c.kind for c in laid.covered)
    contacts = sum(c.kind is CrossingKind.CONTACT for c in circuit.crossings)
    cold, hot = zip(*circuit_resistances_ohm(spec, circuit), strict=True)
    return {
        "wire_length_mm": circuit.wire_length_mm,
        "resistance_ohm_cold": in_parallel_ohm(cold),
        "resistance_ohm_hot": in_parallel_ohm(hot),
        "contacts": contacts,
        "covered_contacts": insulated[CrossingKind.CONTACT],
        "terminal_crossings": len(circuit.crossings) - contacts,
        "covered_terminal_crossings": insulated[CrossingKind.TERMINALS],
        "closed": circuit.closed,
        "loops": len(circuit.layout.loops),
        "stages": len(circuit.stages),
        "smallest_bend_radius_mm": circuit.smallest_radius_mm,
        "largest_curvature_per_mm": 1 / circuit.smallest_radius_mm,
        "tail_length_mm": spec.stitching.tail_length_mm,
    }


def stitch_data(plan: StitchPlan, records: Records) -> Data:
    """Keys of the stitch file."""
    return {
        "stitches": int((records.command == Command.STITCH).sum()),
        "jumps": int((records.command == Command.JUMP).sum()),
        "stops": int((records.command == Command.STOP).sum()),
        "extent_mm": list(extent_mm(plan)),
        "blocks": [
            {
                "kind": str(block.kind),
                "stage": block.stage + 1 if block.kind in STAGED else None,
                "instruction": block.instruction,
                "stitches": sum(len(run.needles) for run in block.runs),
            }
            for block in plan.blocks
        ],
    }


def machine_data(machine: MachineSection, plan: StitchPlan) -> Data:
    """Keys of the stitch file that depend on the machine: its time, and the thread of each kind."""
    return {
        "sewing_time_min": round(machine.pace.plan_s(plan) / 60, 1),
        "threads": {str(kind): one for kind, one in zip(THREADED, machine.threads, strict=True)},
    }
