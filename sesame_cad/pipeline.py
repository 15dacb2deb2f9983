"""From a specification to everything the workshop needs, as values; no file is touched here."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from math import hypot
from typing import TypeVar

import numpy as np

from patterns.circuit import Circuit, Crossing
from patterns.electrics import resistance_ohm
from patterns.errors import PatternError
from patterns.layout import tangent_layout
from patterns.net import Kind, SewnNet, sewn_net
from patterns.outline import Outline, cut_outline
from patterns.plan import StitchPlan
from patterns.registration import Mark, registration_marks
from patterns.rules import check_outline, check_plan
from patterns.rules.insulation import INSULATION
from patterns.rules.net import check_net
from patterns.stitch_plan import stitch_plan
from patterns.violation import Violation
from sesame_cad.errors import InputError
from sesame_cad.shape_state import ShapeState
from sesame_cad.specification import Specification
from sesame_cad.state import solve_state
from sesame_cad.wiring import wired
from solver.errors import SceneError

Result = TypeVar("Result")


@dataclass(frozen=True)
class Pattern:
    """What is sewn and cut, on the stretched fabric.

    Attributes
    ----------
    circuit : Circuit
    outline : Outline
    marks : tuple of Mark
    plan : StitchPlan
    net : SewnNet
        What the stitches alone connect.
    covered : tuple of Crossing
        Crossings of the wire that thread insulates, judged by the stitches themselves.
    """

    circuit: Circuit
    outline: Outline
    marks: tuple[Mark, ...]
    plan: StitchPlan
    net: SewnNet
    covered: tuple[Crossing, ...]


class BrokenRulesError(InputError):
    """A pattern was laid, but must not be sewn.

    Attributes
    ----------
    pattern : Pattern
    violations : tuple of Violation
    """

    def __init__(self, laid: Pattern, violations: tuple[Violation, ...], *faults: str) -> None:
        super().__init__(*faults)
        self.pattern: Pattern = laid
        self.violations: tuple[Violation, ...] = violations


@dataclass(frozen=True)
class Design:
    """Everything that follows from a specification.

    Attributes
    ----------
    spec : Specification
    pattern : Pattern
    states : tuple of ShapeState
        Cold and hot; none when no shape is asked for.
    """

    spec: Specification
    pattern: Pattern
    states: tuple[ShapeState, ...]


def pattern(spec: Specification) -> Pattern:
    """Lay wire, thread, cut lines and marks.

    Raises
    ------
    InputError
        When the array cannot be sewn or cut as specified; `BrokenRulesError` when it was laid, but
        breaks a design rule.
    """
    return refusing(spec, partial(_pattern, spec))


def design(spec: Specification, progress: Callable[[str], None] = lambda _: None) -> Design:
    """Predict the shapes and lay the pattern.

    Parameters
    ----------
    progress : callable
        Told what is being done.

    Raises
    ------
    InputError
        When the specification asks for what cannot be made.
    NotConvergedError
        When there is no shape to rely on.
    """
    progress("circuit and stitches")
    laid = pattern(spec)
    names = () if spec.predicted_shape == "none" else ("cold", "hot")
    states = tuple(_state(spec, laid, name, progress) for name in names)
    return Design(spec, laid, states)


def _state(
    spec: Specification, laid: Pattern, name: str, progress: Callable[[str], None]
) -> ShapeState:
    """Predict the array cold or hot."""
    progress(f"{name} shape")
    if spec.predicted_shape == "coupled":
        from sesame_cad.coupled_state import solve_coupled  # noqa: PLC0415 - slow to load

        layout = laid.circuit.layout
        return refusing(spec, partial(solve_coupled, spec, layout, name, progress))
    modulus = spec.wire.modulus_cold_GPa if name == "cold" else spec.wire.modulus_hot_GPa
    return refusing(spec, partial(solve_state, spec, name, modulus))


def refusing(spec: Specification, work: Callable[[], Result]) -> Result:
    """Do the work; what geometry or mechanics refuse is the specification's fault."""
    try:
        return work()
    except (PatternError, SceneError) as error:
        raise InputError(f"{spec.name}: {error}") from None


def wire_and_cut(spec: Specification) -> tuple[Circuit, Outline]:
    """Lay the wire and draw the cut lines, without a stitch.

    Raises
    ------
    InputError
        When the array cannot be laid or cut as specified.
    """
    return refusing(spec, partial(_wire_and_cut, spec))


def _wire_and_cut(spec: Specification) -> tuple[Circuit, Outline]:
    layout = tangent_layout(spec.layout.loops(), spec.layout.tolerance_mm)
    circuit = wired(spec, layout)
    outline = cut_outline(
        circuit,
        spec.diameters_mm,
        spec.outline.margin_mm,
        spec.outline.corner_radius_mm,
        keep_between=spec.layout.between == "kept",
    )
    return circuit, outline


def _pattern(spec: Specification) -> Pattern:
    stitching, machine = spec.patterns_stitching(), spec.patterns_machine()
    wire_mm = spec.diameters_mm
    circuit, outline = _wire_and_cut(spec)
    marks = registration_marks(outline.bounds_mm, stitching.mark_size_mm, stitching.mark_gap_mm)
    plan = stitch_plan(circuit, stitching, machine, wire_mm, marks)
    net = net_of_stitches(spec, circuit, plan)
    violations = (
        *check_plan(circuit, plan, machine, stitching, wire_mm),
        *check_net(circuit, net),
        *check_outline(outline, circuit, wire_mm, spec.outline.margin_mm, plan),
    )
    covered = covered_crossings(circuit, violations)
    laid = Pattern(circuit, outline, marks, plan, net, covered)
    if violations:
        raise BrokenRulesError(laid, violations, *first_of_each_rule(spec, violations))
    return laid


def net_of_stitches(spec: Specification, circuit: Circuit, plan: StitchPlan) -> SewnNet:
    """Rebuild the electrical net of cold wire from a plan, made or read from a file."""
    kinds = tuple(
        Kind(wire.diameter_mm, resistance_ohm(1.0, wire.diameter_mm, wire.resistivity_cold_uohm_cm))
        for wire in spec.wires(len(circuit.parts))
    )
    return sewn_net(plan, kinds, spec.patterns_stitching().largest_cover_gap_mm)


def first_of_each_rule(spec: Specification, violations: tuple[Violation, ...]) -> Iterator[str]:
    """Say each broken rule once: a setting that breaks it does so all over the array."""
    counts = Counter(violation.rule for violation in violations)
    firsts = {violation.rule: violation for violation in reversed(violations)}
    for rule, count in counts.items():
        more = f", and in {count - 1} more places" if count > 1 else ""
        yield f"{spec.name}: {firsts[rule]}{more}"


def covered_crossings(circuit: Circuit, violations: tuple[Violation, ...]) -> tuple[Crossing, ...]:
    """Crossings of the wire in which no rule found a short circuit."""
    shorted = {
        min(circuit.crossings, key=lambda c: hypot(c.x_mm - fault.x_mm, c.y_mm - fault.y_mm))
        for fault in violations
        if fault.rule == INSULATION
    }
    return tuple(crossing for crossing in circuit.crossings if crossing not in shorted)


def extent_mm(plan: StitchPlan) -> tuple[float, float]:
    """Width and height of everything that is sewn."""
    points = np.concatenate([run.needles for block in plan.blocks for run in block.runs])
    width, height = np.ptp(points, axis=0) / 10
    return float(width), float(height)
