"""The two layers of a sleeve, each sewn in a hoop, and the ties that join them around beams.

Both layers are sewn and stay right side up; nothing is mirrored. The paper lays beams on the array
that was sewn last and applies an earlier one that is still in its hoop (III-B4). Right side up
the fabric of that upper array comes to lie between its own wire and the lower one: where the edges
of opposing loops are tied they touch, and face down their bare wires would. A hooped fabric also
lies at the lower side of its hoop: only so it comes down to the beams.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from shapely import union_all
from shapely.geometry.base import BaseGeometry

from patterns.circuit import Circuit
from patterns.laid_wire import LaidWire, laid_wire
from patterns.layout import tangent_layout
from patterns.outline import Outline, cut_outline
from patterns.placement import GAP_MM, corner_marks, end_marks
from patterns.plan import Block, BlockKind, StitchPlan
from patterns.registration import Mark, registration_marks
from patterns.rows import row_wires
from patterns.rules import check_outline, check_plan
from patterns.rules.net import check_net
from patterns.rules.ties import check_in_hoop, check_ties
from patterns.sleeve_ties import tie_block
from patterns.stitch_plan import stitch_plan
from patterns.terminals import Side
from patterns.violation import Violation
from patterns.wire_index import WireIndex
from sesame_cad.pipeline import (
    BrokenRulesError,
    Pattern,
    covered_crossings,
    first_of_each_rule,
    net_of_stitches,
)
from sesame_cad.sleeve.cutting import Cutting, cutting, cutting_violations
from sesame_cad.specification import Specification

LOWER, UPPER = "lower", "upper"

_OPPOSITE = {Side.LEFT: Side.RIGHT, Side.RIGHT: Side.LEFT}


@dataclass(frozen=True)
class SleevePattern:
    """What is sewn and cut.

    Attributes
    ----------
    lower, upper : Pattern
        The layers as they lie on each other; the stitches of the lower one end with the ties.
    cutting : Cutting
        What is cut from plastic.
    """

    lower: Pattern
    upper: Pattern
    cutting: Cutting


def sleeve_pattern(spec: Specification) -> SleevePattern:
    """Lay wire, thread, ties, cut lines and marks of both layers, and the pieces in between.

    Raises
    ------
    PatternError
        When something cannot be laid.
    BrokenRulesError
        When it was laid, but breaks a design rule.
    """
    cut = cutting(spec)
    side = spec.layout.side
    other = side if spec.sleeve.upper_terminals == "same" else _OPPOSITE[side]
    circuits = _circuit(spec, LOWER, side), _circuit(spec, UPPER, other)
    outlines = tuple(_outline(spec, circuit) for circuit in circuits)
    laid = laid_wire(*(part for circuit in circuits for part in circuit.stages))
    shared = _marks(spec, outlines, cut)
    marked = corner_marks if spec.beam.frame_tabs else end_marks
    placing = marked(cut.shapes, laid)
    lower = _sewn(spec, circuits[0], outlines[0], (*shared, *placing))
    upper = _sewn(spec, circuits[1], outlines[1], shared)
    ties = _ties(spec, circuits[0], laid, framed=spec.beam.frame_tabs)
    lower = replace(lower, plan=StitchPlan((*lower.plan.blocks, ties)))
    judged = [(layer, layer_violations(spec, layer)) for layer in (lower, upper)]
    lower, upper = (
        replace(layer, covered=covered_crossings(layer.circuit, found)) for layer, found in judged
    )
    made = SleevePattern(lower, upper, cut)
    _check(spec, made, *(found for _, found in judged))
    return made


def _circuit(spec: Specification, name: str, side: Side) -> Circuit:
    layout = tangent_layout(spec.layout.loops(), spec.layout.tolerance_mm)
    bend = spec.stitching.smallest_bend_diameters * spec.wire.diameter_mm
    tail, joined = spec.stitching.tail_length_mm, spec.sleeve.rows_joined
    return row_wires(layout, name, side, tail, bend, joined=joined)


def _outline(spec: Specification, circuit: Circuit) -> Outline:
    outline, wire_mm = spec.outline, spec.wire.diameter_mm
    return cut_outline(circuit, wire_mm, outline.margin_mm, outline.corner_radius_mm)


def _marks(spec: Specification, outlines: Sequence[Outline], cut: Cutting) -> tuple[Mark, ...]:
    """Registration marks around everything, at the same places in both layers."""
    left, bottom, right, top = union_all(cut.shapes).buffer(GAP_MM).bounds
    boxes = [(left, bottom, right, top), *(one.bounds_mm for one in outlines)]
    lows, highs = [box[:2] for box in boxes], [box[2:] for box in boxes]
    low = [min(values) for values in zip(*lows, strict=True)]
    high = [max(values) for values in zip(*highs, strict=True)]
    stitching = spec.stitching
    return registration_marks(
        (low[0], low[1], high[0], high[1]), stitching.mark_size_mm, stitching.mark_gap_mm
    )


def _sewn(
    spec: Specification, circuit: Circuit, outline: Outline, marks: tuple[Mark, ...]
) -> Pattern:
    plan = stitch_plan(
        circuit,
        spec.patterns_stitching(),
        spec.patterns_machine(),
        spec.wire.diameter_mm,
        marks,
    )
    net = net_of_stitches(spec, circuit, plan)
    return Pattern(circuit, outline, marks, plan, net, covered=())


def _ties(spec: Specification, circuit: Circuit, laid: LaidWire, *, framed: bool) -> Block:
    beams = "the frame with the beams" if framed else "the beams, hooks in the plane of the fabric,"
    between = "its" if framed else "their"
    before = (
        f"Leave the hoop in the pantograph. Lay {beams} between {between} sewn marks. Lay "
        "the upper array, still in its hoop and right side up, on the beams, its registration "
        "marks on those of the lower array, the F on the F. Hold all of it down clear of the "
        "needle, and hold the lower tails aside."
    )
    return tie_block(
        circuit.layout.loops,
        laid,
        wire_diameter_mm=spec.wire.diameter_mm,
        angle_deg=spec.sleeve.tie_angle_deg,
        length_mm=spec.sleeve.tie_length_mm,
        machine=spec.patterns_machine(),
        stitching=spec.patterns_stitching(),
        before=before,
    )


def _check(
    spec: Specification,
    made: SleevePattern,
    of_lower: tuple[Violation, ...],
    of_upper: tuple[Violation, ...],
) -> None:
    """Refuse what breaks a rule; the layer whose plan is at fault is shown."""
    for layer, found in (
        (made.lower, (*cutting_violations(spec, made.cutting), *of_lower)),
        (made.upper, of_upper),
        (made.lower, tie_violations(spec, made)),
    ):
        if found:
            raise BrokenRulesError(layer, found, *first_of_each_rule(spec, found))


def layer_violations(spec: Specification, layer: Pattern) -> tuple[Violation, ...]:
    """Hold one layer against the rules that every array keeps to."""
    machine, stitching = spec.patterns_machine(), spec.patterns_stitching()
    circuit, wire_mm, margin = layer.circuit, spec.wire.diameter_mm, spec.outline.margin_mm
    return (
        *check_plan(circuit, layer.plan, machine, stitching, wire_mm),
        *check_net(circuit, net_of_stitches(spec, circuit, layer.plan)),
        *check_outline(layer.outline, circuit, wire_mm, margin, layer.plan),
    )


def tie_violations(spec: Specification, made: SleevePattern) -> tuple[Violation, ...]:
    """Hold the ties against beams, the upper layer's wire and fabric, and the loops they hold."""
    machine, wire_mm = spec.patterns_machine(), spec.wire.diameter_mm
    needle = machine.needle_diameter_mm
    beams: BaseGeometry = union_all(made.cutting.shapes)
    upper = made.upper
    ties = tuple(b for b in made.lower.plan.blocks if b.kind is BlockKind.TIES)
    return (
        *check_ties(
            made.lower.plan,
            made.lower.circuit.layout.loops,
            WireIndex(upper.circuit.wire),
            beams,
            clear_of_wire_mm=(wire_mm + needle) / 2,
            clear_of_beams_mm=needle / 2 + spec.sleeve.needle_to_beam_mm,
        ),
        *check_in_hoop(beams, machine.field_mm),
        *check_outline(
            upper.outline,
            upper.circuit,
            wire_mm,
            spec.outline.margin_mm,
            StitchPlan(ties),
        ),
    )
