from dataclasses import replace
from pathlib import Path

from patterns.plan import BlockKind, StitchPlan
from sesame_cad.pipeline import covered_crossings, pattern
from sesame_cad.specification import load_specification

EXAMPLE = Path(__file__).parents[2] / "examples" / "large-array.toml"


def test_a_crossing_without_its_cover_does_not_count_as_covered():
    spec = load_specification(EXAMPLE, {"layout.rows": 2, "layout.columns": 2})
    laid = pattern(spec)
    assert covered_crossings(spec, laid) == laid.circuit.crossings
    blocks = tuple(
        replace(block, runs=block.runs[1:]) if block.kind is BlockKind.COVER else block
        for block in laid.plan.blocks
    )
    bare = replace(laid, plan=StitchPlan(blocks))
    assert len(covered_crossings(spec, bare)) == len(laid.circuit.crossings) - 1
