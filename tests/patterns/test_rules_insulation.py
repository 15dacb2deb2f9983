from dataclasses import replace

import numpy as np
import pytest

from patterns.layout import tangent_layout
from patterns.loop import Loop
from patterns.one_wire import one_wire
from patterns.path import Line, WirePath
from patterns.rules.near import near_stretches
from patterns.stitch_plan import stitch_plan
from patterns.terminals import Side
from patterns.wire_index import WireIndex


@pytest.mark.parametrize("dropped", range(8))
def test_every_cover_is_needed(bench, dropped: int) -> None:
    circuit, plan = bench.good()
    assert len(circuit.crossings) == 8
    runs = bench.block_of(plan, bench.cover).runs
    bare = bench.with_runs(plan, bench.cover, *runs[:dropped], *runs[dropped + 1 :])
    faults = bench.check(replace(circuit, crossings=()), bare)
    assert {fault.rule for fault in faults} == {"insulation"}
    middle = runs[dropped].needles.mean(axis=0) / 10
    assert any(np.hypot(f.x_mm - middle[0], f.y_mm - middle[1]) < 1.5 for f in faults)


def test_a_hole_in_a_cover_is_a_short(bench) -> None:
    circuit, plan = bench.good()
    first, *others = bench.block_of(plan, bench.cover).runs
    middle = len(first.needles) // 2
    thin = replace(first, needles=np.delete(first.needles, [middle, middle + 1], axis=0))
    assert bench.broken(circuit, bench.with_runs(plan, bench.cover, thin, *others)) == {
        "insulation"
    }


def test_a_wire_that_comes_near_itself_is_a_short(bench) -> None:
    circuit, plan = bench.good()
    there = Line(0.0, 500.0, 100.0, 500.0)
    back = Line(0.0, 500.5, 100.0, 500.5)
    doubled = WirePath((*circuit.stages[1].pieces, there, back))
    faults = bench.check(replace(circuit, stages=(circuit.stages[0], doubled)), plan)
    assert any("near itself" in fault.message for fault in faults)


def test_near_stretches_of_two_tangent_circles(bench) -> None:
    circuit, _ = bench.planned(1, 4, 25.0, 0.2)
    radius, separation = 12.5, 0.7
    first, second = WireIndex(circuit.stages[0]), WireIndex(circuit.stages[1])
    found = near_stretches(first, second, first.length_mm, separation)
    half = radius * np.arccos((5 - ((radius + separation) / radius) ** 2) / 4)
    contacts = [c.first_mm for c in circuit.crossings if c.kind == "contact"]
    for s in contacts:
        (stretch,) = found[(found[:, 0] < s) & (found[:, 1] > s)]
        assert stretch == pytest.approx([s - half, s + half], abs=0.01)
    assert len(found) == len(contacts) + 1


@pytest.fixture(scope="module")
def flower(bench):
    """Seven loops in three stages: two covers."""
    ring = [(25 * np.cos(k * np.pi / 3), 25 * np.sin(k * np.pi / 3)) for k in range(6)]
    layout = tangent_layout((Loop(0, 0, 25), *(Loop(x, y, 25) for x, y in ring)))
    circuit = one_wire(layout, Side.CORNER, 40.0)
    plan = stitch_plan(circuit, bench.stitching, bench.machine, bench.wire_mm, ())
    assert [block.kind for block in plan.blocks] == ["wire", "cover", "wire", "cover", "wire"]
    return circuit, plan


def test_every_cover_of_three_stages_is_needed(bench, flower) -> None:
    circuit, plan = flower
    assert bench.check(circuit, plan) == ()
    for cover in (plan.blocks[1], plan.blocks[3]):
        for k, run in enumerate(cover.runs):
            part = (cover.kind, cover.stage)
            bare = bench.with_runs(plan, part, *cover.runs[:k], *cover.runs[k + 1 :])
            faults = bench.check(replace(circuit, crossings=()), bare)
            assert {fault.rule for fault in faults} <= {"insulation", "runs"}
            middle = run.needles.mean(axis=0) / 10
            assert any(np.hypot(f.x_mm - middle[0], f.y_mm - middle[1]) < 1.5 for f in faults)


def test_a_cover_sewn_a_stage_too_late_is_a_short(bench, flower) -> None:
    circuit, plan = flower
    early, late = plan.blocks[1], plan.blocks[3]
    moved = bench.with_runs(plan, (early.kind, 1), *early.runs[1:])
    moved = bench.with_runs(moved, (late.kind, 2), *late.runs, early.runs[0])
    faults = [f for f in bench.check(circuit, moved) if f.rule == "insulation"]
    assert len(faults) == 1
    assert "stages 1 and 2 of the wire meet" in faults[0].message


def test_a_cover_on_wire_that_is_not_there_yet_is_a_short(bench, flower) -> None:
    """A cover of stage 2 under stage 3, sewn before stage 2 is laid."""
    circuit, plan = flower
    early, late = plan.blocks[1], plan.blocks[3]
    begin = circuit.starts_mm[1]
    (k, *_) = [
        k
        for k, c in enumerate(sorted(circuit.crossings_of(2), key=lambda c: -c.first_mm))
        if c.first_mm > begin
    ]
    moved = bench.with_runs(plan, (early.kind, 1), *early.runs, late.runs[k])
    moved = bench.with_runs(moved, (late.kind, 2), *late.runs[:k], *late.runs[k + 1 :])
    messages = [f.message for f in bench.check(circuit, moved) if f.rule == "insulation"]
    assert len(messages) == 1
    assert "stages 2 and 3 of the wire meet" in messages[0]
