"""Rules of couching, covers, feed and field: each planted fault breaks its rule alone."""

from dataclasses import replace

import numpy as np
import pytest
import shapely

from patterns.errors import NoRoomError
from patterns.machine import Machine
from patterns.plan import UNITS_PER_MM
from patterns.room import roomy_diameter_mm
from patterns.sewing_time import SewingPace
from patterns.stitch_plan import stitch_plan
from patterns.stitching import Stitching
from patterns.tangent_switch import grid_circuit


def test_a_bend_that_is_tied_down_too_seldom_is_found(bench) -> None:
    circuit, plan = bench.good()
    seldom = replace(bench.stitching, couching_angle_deg=8.0)
    faults = bench.check(circuit, plan, stitching=seldom)
    assert {fault.rule for fault in faults} == {"couching-angle"}
    assert 8.0 < faults[0].actual < 20.0
    often = stitch_plan(circuit, seldom, bench.machine, bench.wire_mm, ())
    assert bench.check(circuit, often, stitching=seldom) == ()


def test_couching_whose_holes_run_together_is_found(bench) -> None:
    circuit, plan = bench.good()
    needles = bench.block_of(plan, bench.first).runs[0].needles
    place, ahead = 8, needles[9] - needles[7]  # on the tail
    ahead = ahead / np.hypot(*ahead)
    near = np.array([(needles[7] + needles[9]) / 2 + 2.5 * ahead, needles[8] + 5 * ahead])
    closer = np.insert(needles, place + 1, np.round(near).astype(int), axis=0)
    faults = bench.check(circuit, bench.with_needles(plan, bench.first, closer))
    assert {fault.rule for fault in faults} == {"couching-holes"}
    assert faults[0].actual < faults[0].allowed == 0.75


def test_a_free_end_that_is_sewn_over_is_found(bench) -> None:
    circuit, plan = bench.good()
    run = bench.block_of(plan, bench.first).runs[0]
    point, tangent = circuit.stages[0].at([6.0, 8.0])
    side = 0.65 * np.array([-tangent[0, 1], tangent[0, 0]])
    more = np.round(10 * (point + side * [[1], [-1]])).astype(int)
    lock = np.round(10 * (point[:1] + side + 0.7 * tangent[:1])).astype(int)
    start = np.concatenate([more[:1], lock, more])
    longer = bench.with_needles(plan, bench.first, np.concatenate([start, run.needles[2:]]))
    faults = bench.check(circuit, longer)
    assert {fault.rule for fault in faults} == {"feed-and-cut"}
    assert faults[0].actual == pytest.approx(6.0, abs=0.1)


@pytest.mark.parametrize("end", [0, 1])
def test_a_wire_without_a_straight_tail_is_found(bench, end: int) -> None:
    circuit, plan = bench.good()
    stages = list(circuit.stages)
    pieces = stages[end].pieces[1:] if end == 0 else stages[end].pieces[:-1]
    stages[end] = replace(stages[end], pieces=pieces)
    faults = bench.check(replace(circuit, stages=tuple(stages), crossings=()), plan)
    said = [fault.message for fault in faults if fault.rule == "feed-and-cut"]
    assert any("without a straight tail" in message for message in said)


def test_a_cover_narrower_than_asked_for_is_found(bench) -> None:
    circuit, plan = bench.good()
    wide = replace(bench.stitching, cover_margin_mm=0.4)
    faults = bench.check(circuit, plan, stitching=wide)
    assert {fault.rule for fault in faults} == {"cover-width"}
    wider = stitch_plan(circuit, wide, bench.machine, bench.wire_mm, ())
    assert bench.check(circuit, wider, stitching=wide) == ()


def test_the_field_is_the_hoop_without_its_rim(bench) -> None:
    circuit, plan = bench.good()
    most = max(np.abs(block.runs[k].needles).max() for block in plan.blocks for k in range(1)) / 10
    half = 300 - most
    assert bench.check(circuit, plan, machine=replace(bench.machine, hoop_rim_mm=half - 25)) == ()
    small = replace(bench.machine, hoop_rim_mm=half + 5)
    assert {fault.rule for fault in bench.check(circuit, plan, machine=small)} == {"hoop"}


@pytest.mark.parametrize(("overlap", "underlay"), [(0.0, "edge"), (1.5, "none"), (1.5, "edge")])
def test_underlay_and_overlap_keep_every_rule_and_miss_the_wire(bench, overlap, underlay) -> None:
    circuit, plain = bench.good()
    asked = replace(bench.stitching, cover_overlap_mm=overlap, cover_underlay=underlay)
    plan = stitch_plan(circuit, asked, bench.machine, bench.wire_mm, ())
    assert bench.check(circuit, plan, stitching=asked) == ()
    before, now = (bench.block_of(one, bench.cover).runs for one in (plain, plan))
    wire = circuit.stages[0].line_string(5e-4)
    for short, long in zip(before, now, strict=True):
        spans = [np.ptp(wire.project(shapely.points(r.needles / 10))) for r in (short, long)]
        assert spans[1] - spans[0] == pytest.approx(2 * overlap, abs=0.35)
        assert (len(long.needles) > len(short.needles)) or underlay == "none"
        points = shapely.points(long.needles / UNITS_PER_MM)
        assert shapely.distance(points, wire).min() >= (bench.wire_mm + 0.75) / 2


def test_without_room_the_smallest_loops_that_would_do_are_told() -> None:
    machine = Machine(500, 500, 0.75)
    with pytest.raises(NoRoomError, match=r"loops of ([\d.]+) mm or so") as caught:
        stitch_plan(grid_circuit(3, 3, 4.0, 40.0), Stitching(), machine, 0.2, ())
    size = float(str(caught.value).rpartition("loops of ")[2].split()[0])
    assert 4.0 < size < 8.0
    stitch_plan(grid_circuit(3, 3, size, 40.0 * size / 4.0), Stitching(), machine, 0.2, ())


def test_no_size_is_told_when_none_would_do() -> None:
    assert roomy_diameter_mm(grid_circuit(1, 1, 4.0, 40.0), lambda _: False) is None


def test_sewing_time_counts_stitches_and_stops(bench) -> None:
    _, plan = bench.good()
    wire = sum(len(r.needles) for b in plan.blocks if b.kind.is_wire for r in b.runs)
    rest = sum(len(r.needles) for b in plan.blocks for r in b.runs) - wire
    assert SewingPace(600, 100, 30).plan_s(plan) == pytest.approx(rest / 10 + wire * 0.6 + 4 * 30)
