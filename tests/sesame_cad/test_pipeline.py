from dataclasses import replace
from pathlib import Path

from patterns.plan import BlockKind, StitchPlan
from patterns.rules import check_plan
from sesame_cad.pipeline import covered_crossings, pattern
from sesame_cad.specification import load_specification

EXAMPLE = Path(__file__).parents[2] / "examples" / "large-array.toml"


def test_a_crossing_without_its_cover_does_not_count_as_covered():
    spec = load_specification(EXAMPLE, {"layout.rows": 2, "layout.columns": 2})
    laid = pattern(spec)
    assert laid.covered == laid.circuit.crossings
    blocks = tuple(
        replace(block, runs=block.runs[1:]) if block.kind is BlockKind.COVER else block
        for block in laid.plan.blocks
    )
    violations = check_plan(
        laid.circuit,
        StitchPlan(blocks),
        spec.patterns_machine(),
        spec.patterns_stitching(),
        spec.diameters_mm,
    )
    covered = covered_crossings(laid.circuit, violations)
    assert len(covered) == len(laid.circuit.crossings) - 1
