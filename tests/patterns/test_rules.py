from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from patterns.circuit import Circuit
from patterns.machine import Machine
from patterns.path import Line, WirePath
from patterns.plan import Block, BlockKind, Run, StitchPlan
from patterns.registration import registration_marks
from patterns.rules import RULES, check_plan
from patterns.rules.near import near_stretches
from patterns.stitch_plan import stitch_plan
from patterns.stitching import Stitching
from patterns.tangent_switch import grid_circuit
from patterns.violation import Violation
from patterns.wire_index import WireIndex

MACHINE = Machine(hoop_width_mm=600, hoop_height_mm=600, needle_diameter_mm=0.75)
STITCHING = Stitching()
WIRE_MM = 0.3


@cache
def planned(rows: int, columns: int, loop_mm: float, wire_mm: float) -> tuple[Circuit, StitchPlan]:
    circuit = grid_circuit(rows, columns, loop_mm, STITCHING.tail_length_mm)
    x, y = columns * loop_mm / 2 + 45, rows * loop_mm / 2 + 45
    marks = registration_marks((-x, -y, x, y), 8.0, 6.0)
    return circuit, stitch_plan(circuit, STITCHING, MACHINE, wire_mm, marks)


def good() -> tuple[Circuit, StitchPlan]:
    return planned(2, 3, 25.0, WIRE_MM)


def check(circuit: Circuit, plan: StitchPlan, **changes: object) -> tuple[Violation, ...]:
    settings = {"machine": MACHINE, "stitching": STITCHING, **changes}
    return check_plan(circuit, plan, wire_diameter_mm=WIRE_MM, **settings)


def broken(circuit: Circuit, plan: StitchPlan, **changes: object) -> set[str]:
    return {violation.rule for violation in check(circuit, plan, **changes)}


def block_of(plan: StitchPlan, kind: BlockKind) -> Block:
    return next(block for block in plan.blocks if block.kind is kind)


def with_runs(plan: StitchPlan, kind: BlockKind, *runs: Run) -> StitchPlan:
    return StitchPlan(
        tuple(replace(block, runs=runs) if block.kind is kind else block for block in plan.blocks)
    )


def with_needles(plan: StitchPlan, kind: BlockKind, needles: np.ndarray) -> StitchPlan:
    return with_runs(plan, kind, replace(block_of(plan, kind).runs[0], needles=needles))


def with_mark(plan: StitchPlan, *needles: tuple[int, int]) -> StitchPlan:
    runs = block_of(plan, BlockKind.MARKS).runs
    first = np.array(needles[0])
    run = Run(tuple((first - (10, 0)).tolist()), np.array(needles))
    return with_runs(plan, BlockKind.MARKS, *runs, run)


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
def test_a_good_plan_has_no_fault(rows: int, columns: int, loop_mm: float, wire_mm: float) -> None:
    circuit, plan = planned(rows, columns, loop_mm, wire_mm)
    assert check_plan(circuit, plan, MACHINE, STITCHING, wire_mm) == ()


def test_a_plan_without_marks_is_good() -> None:
    circuit, plan = good()
    assert check(circuit, StitchPlan(plan.blocks[1:])) == ()


def test_marks_after_the_wire_are_out_of_order() -> None:
    circuit, plan = good()
    moved = StitchPlan((*plan.blocks[1:], plan.blocks[0]))
    (fault,) = check(circuit, moved)
    assert fault.rule == "blocks"
    assert fault.block == 3
    assert "marks" in fault.message


def test_a_block_sewn_twice_is_named() -> None:
    circuit, plan = good()
    (fault,) = check(circuit, StitchPlan((*plan.blocks[:3], *plan.blocks[2:])))
    assert fault.rule == "blocks"
    assert "second time" in fault.message


@pytest.mark.parametrize("missing", [1, 2, 3])
def test_a_missing_block_is_named(missing: int) -> None:
    circuit, plan = good()
    kind = plan.blocks[missing].kind
    faults = check(circuit, StitchPlan(plan.blocks[:missing] + plan.blocks[missing + 1 :]))
    assert [kind.value in f.message for f in faults if f.rule == "blocks"] == [True]


def test_a_missing_or_late_cover_is_also_a_short() -> None:
    circuit, plan = good()
    marks, first, cover, second = plan.blocks
    assert broken(circuit, StitchPlan((marks, first, second))) == {"blocks", "insulation"}
    late = broken(circuit, StitchPlan((marks, first, second, cover)))
    assert {"blocks", "insulation"} <= late


def test_swapped_halves_are_found() -> None:
    circuit, plan = good()
    marks, first, cover, second = plan.blocks
    faults = check(circuit, StitchPlan((marks, second, cover, first)))
    assert {"blocks", "insulation"} <= {fault.rule for fault in faults}
    late = [fault.message for fault in faults if fault.rule == "blocks"]
    assert any("first half" in message for message in late)


def test_a_jump_inside_a_wire_run_is_found() -> None:
    circuit, plan = good()
    (run,) = block_of(plan, BlockKind.WIRE_FIRST).runs
    lock = run.needles[[-2, -1, -2, -1]]
    again = Run((int(run.needles[-1, 0]), int(run.needles[-1, 1])), lock)
    jumped = with_runs(plan, BlockKind.WIRE_FIRST, run, again)
    assert broken(circuit, jumped) == {"runs"}


def test_an_empty_run_is_found() -> None:
    circuit, plan = good()
    runs = block_of(plan, BlockKind.COVER).runs
    empty = Run((0, 0), np.empty((0, 2), dtype=np.int64))
    assert broken(circuit, with_runs(plan, BlockKind.COVER, *runs, empty)) == {"runs"}


def test_a_mark_on_the_wire_is_struck() -> None:
    circuit, plan = good()
    point, _ = circuit.second_half.at(30.0)
    x, y = np.round(10 * point[0]).astype(int).tolist()
    struck = with_mark(plan, (x, y), (x + 7, y), (x, y), (x + 7, y), (x, y))
    faults = check(circuit, struck)
    assert {fault.rule for fault in faults} == {"needle-on-wire"}
    assert min(fault.actual or 0.0 for fault in faults) < 0.1


def test_the_needle_of_the_second_half_must_miss_the_first() -> None:
    circuit, plan = good()
    faults = check(circuit, plan, machine=replace(MACHINE, needle_diameter_mm=0.95))
    assert {fault.rule for fault in faults} == {"needle-on-wire"}
    needles = block_of(plan, BlockKind.WIRE_SECOND).runs[0].needles.copy()
    point, _ = circuit.first_half.at(80.0)
    needles[60] = np.round(10 * point[0])
    struck = check(circuit, with_needles(plan, BlockKind.WIRE_SECOND, needles))
    assert (3, 60) in [(f.block, f.stitch) for f in struck if f.rule == "needle-on-wire"]


def test_a_long_gap_in_the_couching_is_found() -> None:
    circuit, plan = good()
    needles = np.delete(block_of(plan, BlockKind.WIRE_FIRST).runs[0].needles, [30, 31], axis=0)
    faults = check(circuit, with_needles(plan, BlockKind.WIRE_FIRST, needles))
    assert [fault.rule for fault in faults] == ["wire-followed"]
    assert faults[0].stitch == 30
    assert faults[0].actual == pytest.approx(3 * STITCHING.couching_interval_mm, abs=0.3)


@pytest.mark.parametrize("kind", [BlockKind.WIRE_FIRST, BlockKind.WIRE_SECOND])
@pytest.mark.parametrize("end", [0, -1])
def test_an_end_left_loose_is_found(kind: BlockKind, end: int) -> None:
    circuit, plan = good()
    needles = block_of(plan, kind).runs[0].needles
    kept = needles[9:] if end == 0 else needles[:-9]
    faults = check(circuit, with_needles(plan, kind, kept))
    assert "wire-followed" in {fault.rule for fault in faults}
    assert any("loose" in fault.message for fault in faults)


def test_a_stitch_that_does_not_cross_the_wire_is_found() -> None:
    circuit, plan = good()
    needles = np.delete(block_of(plan, BlockKind.WIRE_FIRST).runs[0].needles, 30, axis=0)
    messages = [
        fault.message
        for fault in check(circuit, with_needles(plan, BlockKind.WIRE_FIRST, needles))
        if fault.rule == "wire-followed"
    ]
    assert any("one side" in message for message in messages)


def test_stitches_out_of_order_are_found() -> None:
    circuit, plan = good()
    needles = block_of(plan, BlockKind.WIRE_FIRST).runs[0].needles.copy()
    needles[[30, 32]] = needles[[32, 30]]
    assert broken(circuit, with_needles(plan, BlockKind.WIRE_FIRST, needles)) == {"wire-followed"}


def test_the_points_of_the_other_half_are_found() -> None:
    circuit, plan = good()
    needles = block_of(plan, BlockKind.WIRE_SECOND).runs[0].needles
    assert "wire-followed" in broken(circuit, with_needles(plan, BlockKind.WIRE_FIRST, needles))


@pytest.mark.parametrize("dropped", range(8))
def test_every_cover_is_needed(dropped: int) -> None:
    circuit, plan = good()
    assert len(circuit.crossings) == 8
    runs = block_of(plan, BlockKind.COVER).runs
    bare = with_runs(plan, BlockKind.COVER, *runs[:dropped], *runs[dropped + 1 :])
    faults = check(replace(circuit, crossings=()), bare)
    assert {fault.rule for fault in faults} == {"insulation"}
    middle = runs[dropped].needles.mean(axis=0) / 10
    assert any(np.hypot(f.x_mm - middle[0], f.y_mm - middle[1]) < 1.5 for f in faults)


def test_a_hole_in_a_cover_is_a_short() -> None:
    circuit, plan = good()
    first, *others = block_of(plan, BlockKind.COVER).runs
    middle = len(first.needles) // 2
    thin = replace(first, needles=np.delete(first.needles, [middle, middle + 1], axis=0))
    assert broken(circuit, with_runs(plan, BlockKind.COVER, thin, *others)) == {"insulation"}


def test_a_wire_that_comes_near_itself_is_a_short() -> None:
    circuit, plan = good()
    there = Line(0.0, 500.0, 100.0, 500.0)
    back = Line(0.0, 500.5, 100.0, 500.5)
    doubled = WirePath((*circuit.second_half.pieces, there, back))
    faults = check(replace(circuit, second_half=doubled), plan)
    assert any("near itself" in fault.message for fault in faults)


def test_long_and_short_stitches_are_found() -> None:
    circuit, plan = good()
    lock = ((2000, 2000), (2000, 2007), (2000, 2000))
    long = with_mark(plan, *lock, (2122, 2000), (2122, 2007), (2122, 2000))
    assert broken(circuit, long) == {"stitch-length"}
    slanted = with_mark(plan, *lock, (2121, 2121), (2121, 2114), (2121, 2121))
    assert broken(circuit, slanted) == set()
    short = with_mark(plan, *lock, (2002, 2002), (2002, 2009), (2002, 2002))
    (fault,) = check(circuit, short)
    assert fault.rule == "stitch-length"
    assert fault.actual == pytest.approx(0.08**0.5)


@pytest.mark.parametrize("end", ["begins", "ends"])
def test_a_thread_that_is_not_locked_is_found(end: str) -> None:
    circuit, plan = good()
    first, *others = block_of(plan, BlockKind.COVER).runs
    cut = slice(2, None) if end == "begins" else slice(None, -2)
    loose = replace(first, needles=first.needles[cut])
    (fault,) = check(circuit, with_runs(plan, BlockKind.COVER, loose, *others))
    assert fault.rule == "locks"
    assert end in fault.message


def test_needles_and_jumps_stay_in_the_hoop() -> None:
    circuit, plan = good()
    assert broken(circuit, plan, machine=replace(MACHINE, hoop_width_mm=150)) == {"hoop"}
    marks = block_of(plan, BlockKind.MARKS).runs
    far = replace(marks[0], approach=(int(marks[0].needles[0, 0]), 3001))
    near = replace(MACHINE, longest_stitch_mm=1e3)
    (fault,) = check(circuit, with_runs(plan, BlockKind.MARKS, far, *marks[1:]), machine=near)
    assert (fault.rule, fault.stitch, fault.actual) == ("hoop", None, 300.1)


def test_a_tight_bend_is_found() -> None:
    circuit, plan = good()
    tight = replace(STITCHING, smallest_bend_diameters=42.0)
    faults = check(circuit, plan, stitching=tight)
    assert {fault.rule for fault in faults} == {"bend-radius"}
    assert faults[0].actual == pytest.approx(12.5)
    assert faults[0].allowed == pytest.approx(12.6)


def test_a_kink_is_found() -> None:
    circuit, plan = good()
    *arcs, tail = circuit.second_half.pieces
    assert isinstance(tail, Line)
    along = np.array([tail.x1_mm - tail.x0_mm, tail.y1_mm - tail.y0_mm])
    x, y = np.array([tail.x0_mm, tail.y0_mm]) + along + 0.0011 * np.array([-along[1], along[0]])
    bent = WirePath((*arcs, replace(tail, x1_mm=float(x), y1_mm=float(y))))
    (fault,) = check(replace(circuit, second_half=bent), plan)
    assert fault.rule == "smooth-path"
    assert (fault.x_mm, fault.y_mm) == pytest.approx((tail.x0_mm, tail.y0_mm))


def test_every_rule_takes_an_empty_plan() -> None:
    circuit, _ = good()
    assert len(RULES) == 10
    assert "blocks" in broken(circuit, StitchPlan(()))
    bare = tuple(Block(kind, "", ()) for kind in BlockKind)
    assert {"runs", "insulation"} <= broken(circuit, StitchPlan(bare))


def test_near_stretches_of_two_tangent_circles() -> None:
    circuit, _ = planned(1, 4, 25.0, 0.2)
    radius, separation = 12.5, 0.7
    first, second = WireIndex(circuit.first_half), WireIndex(circuit.second_half)
    found = near_stretches(first, second, first.length_mm, separation)
    half = radius * np.arccos((5 - ((radius + separation) / radius) ** 2) / 4)
    contacts = [c.first_mm for c in circuit.crossings if c.kind == "contact"]
    for s in contacts:
        (stretch,) = found[(found[:, 0] < s) & (found[:, 1] > s)]
        assert stretch == pytest.approx([s - half, s + half], abs=0.01)
    assert len(found) == len(contacts) + 1
