from dataclasses import replace

import numpy as np
import pytest

from patterns.plan import Block, BlockKind, StitchPlan
from patterns.rules import RULES, check_plan


@pytest.mark.parametrize(
    ("rows", "columns", "loop_mm", "wire_mm"),
    [
        (1, 1, 25, 0.3),
        (1, 4, 25, 0.2),
        (3, 1, 30, 0.3),
        (2, 3, 25, 0.3),
        (5, 5, 25, 0.3),
        (3, 4, 50, 0.5),
        (4, 3, 20, 0.25),
    ],
)
def test_a_good_plan_has_no_fault(
    bench, rows: int, columns: int, loop_mm: float, wire_mm: float
) -> None:
    circuit, plan = bench.planned(rows, columns, loop_mm, wire_mm)
    assert check_plan(circuit, plan, bench.machine, bench.stitching, wire_mm) == ()


def test_a_plan_without_marks_is_good(bench) -> None:
    circuit, plan = bench.good()
    assert bench.check(circuit, StitchPlan(plan.blocks[1:])) == ()


def test_marks_after_the_wire_are_out_of_order(bench) -> None:
    circuit, plan = bench.good()
    moved = StitchPlan((*plan.blocks[1:], plan.blocks[0]))
    (fault,) = bench.check(circuit, moved)
    assert fault.rule == "blocks"
    assert fault.block == 3
    assert "marks" in fault.message


def test_a_block_sewn_twice_is_named(bench) -> None:
    circuit, plan = bench.good()
    (fault,) = bench.check(circuit, StitchPlan((*plan.blocks[:3], *plan.blocks[2:])))
    assert fault.rule == "blocks"
    assert "second time" in fault.message


@pytest.mark.parametrize("missing", [1, 2, 3])
def test_a_missing_block_is_named(bench, missing: int) -> None:
    circuit, plan = bench.good()
    kind = plan.blocks[missing].kind
    faults = bench.check(circuit, StitchPlan(plan.blocks[:missing] + plan.blocks[missing + 1 :]))
    assert [kind.value in f.message for f in faults if f.rule == "blocks"] == [True]


def test_a_missing_or_late_cover_is_also_a_short(bench) -> None:
    circuit, plan = bench.good()
    marks, first, cover, second = plan.blocks
    assert bench.broken(circuit, StitchPlan((marks, first, second))) == {"blocks", "insulation"}
    late = bench.broken(circuit, StitchPlan((marks, first, second, cover)))
    assert {"blocks", "insulation"} <= late


def test_swapped_halves_are_found(bench) -> None:
    circuit, plan = bench.good()
    marks, first, cover, second = plan.blocks
    faults = bench.check(circuit, StitchPlan((marks, second, cover, first)))
    assert {"blocks", "insulation"} <= {fault.rule for fault in faults}
    late = [fault.message for fault in faults if fault.rule == "blocks"]
    assert any("stage 1" in message for message in late)


def test_a_mark_on_the_wire_is_struck(bench) -> None:
    circuit, plan = bench.good()
    point, _ = circuit.stages[1].at(30.0)
    x, y = np.round(10 * point[0]).astype(int).tolist()
    struck = bench.with_mark(plan, (x, y), (x + 7, y), (x, y), (x + 7, y), (x, y))
    faults = bench.check(circuit, struck)
    assert {fault.rule for fault in faults} == {"needle-on-wire"}
    assert min(fault.actual or 0.0 for fault in faults) < 0.1


def test_the_needle_of_the_second_half_must_miss_the_first(bench) -> None:
    circuit, plan = bench.good()
    faults = bench.check(circuit, plan, machine=replace(bench.machine, needle_diameter_mm=0.95))
    assert {fault.rule for fault in faults} == {"needle-on-wire"}
    needles = bench.block_of(plan, bench.second).runs[0].needles.copy()
    point, _ = circuit.stages[0].at(80.0)
    needles[60] = np.round(10 * point[0])
    struck = bench.check(circuit, bench.with_needles(plan, bench.second, needles))
    assert (3, 60) in [(f.block, f.stitch) for f in struck if f.rule == "needle-on-wire"]


def test_the_needle_must_miss_the_wire_that_it_ties_down(bench) -> None:
    circuit, plan = bench.good()
    needles = bench.block_of(plan, bench.first).runs[0].needles.copy()
    needles[60] = np.round(10 * circuit.stages[0].at(80.0)[0][0])
    struck = bench.check(circuit, bench.with_needles(plan, bench.first, needles))
    assert (1, 60) in [(f.block, f.stitch) for f in struck if f.rule == "needle-on-wire"]


def test_a_long_gap_in_the_couching_is_found(bench) -> None:
    circuit, plan = bench.good()
    needles = np.delete(bench.block_of(plan, bench.first).runs[0].needles, [30, 31], axis=0)
    faults = bench.check(circuit, bench.with_needles(plan, bench.first, needles))
    assert [fault.rule for fault in faults] == ["wire-followed"]
    assert faults[0].stitch == 30
    assert faults[0].actual == pytest.approx(3 * bench.stitching.couching_interval_mm, abs=0.3)


@pytest.mark.parametrize("stage", [0, 1])
@pytest.mark.parametrize("end", [0, -1])
def test_an_end_left_loose_is_found(bench, stage: int, end: int) -> None:
    circuit, plan = bench.good()
    part = (BlockKind.WIRE, stage)
    needles = bench.block_of(plan, part).runs[0].needles
    kept = needles[9:] if end == 0 else needles[:-9]
    faults = bench.check(circuit, bench.with_needles(plan, part, kept))
    assert "wire-followed" in {fault.rule for fault in faults}
    assert any("loose" in fault.message for fault in faults)


def test_a_stitch_that_does_not_cross_the_wire_is_found(bench) -> None:
    circuit, plan = bench.good()
    needles = np.delete(bench.block_of(plan, bench.first).runs[0].needles, 30, axis=0)
    messages = [
        fault.message
        for fault in bench.check(circuit, bench.with_needles(plan, bench.first, needles))
        if fault.rule == "wire-followed"
    ]
    assert any("one side" in message for message in messages)


def test_stitches_out_of_order_are_found(bench) -> None:
    circuit, plan = bench.good()
    needles = bench.block_of(plan, bench.first).runs[0].needles.copy()
    needles[[30, 32]] = needles[[32, 30]]
    assert bench.broken(circuit, bench.with_needles(plan, bench.first, needles)) == {
        "wire-followed"
    }


def test_a_step_back_along_the_wire_is_found(bench) -> None:
    circuit, plan = bench.good()
    needles = bench.block_of(plan, bench.first).runs[0].needles
    again = np.insert(needles, 34, needles[[30, 31]], axis=0)
    again = np.insert(again, 36, needles[[32, 33]], axis=0)
    faults = bench.check(circuit, bench.with_needles(plan, bench.first, again))
    assert [fault.rule for fault in faults] == ["wire-followed"]
    assert "in order" in faults[0].message


def test_a_stitch_far_from_the_wire_is_found(bench) -> None:
    circuit, plan = bench.good()
    needles = bench.block_of(plan, bench.first).runs[0].needles.copy()
    point, tangent = circuit.stages[0].at(20.0)
    left = np.array([-tangent[0, 1], tangent[0, 0]])
    outward = left * np.sign((needles[7] / 10 - point[0]) @ left)
    needles[7] += np.round(60 * outward).astype(np.int64)
    faults = bench.check(circuit, bench.with_needles(plan, bench.first, needles))
    assert [(fault.rule, fault.stitch) for fault in faults] == [("wire-followed", 7)]
    assert "not beside" in faults[0].message


def test_the_points_of_the_other_half_are_found(bench) -> None:
    circuit, plan = bench.good()
    needles = bench.block_of(plan, bench.second).runs[0].needles
    assert "wire-followed" in bench.broken(circuit, bench.with_needles(plan, bench.first, needles))


def test_every_rule_takes_an_empty_plan(bench) -> None:
    circuit, _ = bench.good()
    assert len(RULES) == 15
    assert "blocks" in bench.broken(circuit, StitchPlan(()))
    bare = tuple(Block(kind, "", (), stage) for kind, stage in bench.parts)
    assert {"runs", "insulation"} <= bench.broken(circuit, StitchPlan(bare))


def test_a_block_of_a_stage_that_the_circuit_has_not_is_found(bench) -> None:
    circuit, plan = bench.good()
    further = replace(plan.blocks[3], stage=2)
    faults = bench.check(circuit, StitchPlan((*plan.blocks, further)))
    assert [fault.message for fault in faults if fault.rule == "blocks"] == [
        "stage 3 of the wire is none of the circuit's"
    ]
