from dataclasses import replace

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from patterns.errors import NoRoomError, PatternError
from patterns.machine import Machine
from patterns.path import Arc, Line, WirePath
from patterns.plan import UNITS_PER_MM, BlockKind
from patterns.rules import check_plan
from patterns.stations import even_stations, farthest_steps, pace
from patterns.stitch_plan import stitch_plan
from patterns.stitching import Stitching
from patterns.tangent_switch import grid_circuit
from patterns.tied_down import junctions_mm

SWINGING = Machine(500, 500, 0.75, couching="centreline", swing_mm=4.0)
WIDE, WIRE = Stitching(couching_interval_mm=3.0), 0.3


@pytest.fixture(scope="module")
def swung():
    circuit = grid_circuit(2, 3, 25.0, 40.0)
    return circuit, stitch_plan(circuit, WIDE, SWINGING, WIRE, ())


def test_places_lie_on_the_wire_and_both_needle_points_miss_all_wire(swung):
    circuit, plan = swung
    laid = []
    for block in (block for block in plan.blocks if block.kind is BlockKind.WIRE):
        stage = circuit.stages[block.stage]
        laid.append(stage.line_string(5e-4))
        places = block.runs[0].needles / UNITS_PER_MM
        assert shapely.distance(shapely.points(places), laid[-1]).max() <= 0.0715
        at = laid[-1].project(shapely.points(places))
        assert np.diff(at).max() <= 3.0 + 0.15
        _, tangent = stage.at(at)
        across = 2.0 * np.stack([-tangent[:, 1], tangent[:, 0]], axis=1)
        for needles in (places + across, places - across):
            distance = shapely.distance(shapely.points(needles), shapely.union_all(laid))
            assert distance.min() >= (WIRE + 0.75) / 2


def test_a_swung_plan_keeps_the_rules(swung):
    circuit, plan = swung
    assert check_plan(circuit, plan, SWINGING, WIDE, WIRE) == ()
    assert "swing set to 4 mm" in plan.blocks[0].instruction


def test_another_swing_strikes_earlier_wire_and_only_that_is_said(swung):
    circuit, plan = swung
    faults = check_plan(circuit, plan, replace(SWINGING, swing_mm=6.0), WIDE, WIRE)
    assert {fault.rule for fault in faults} == {"needle-on-wire"}
    assert {plan.blocks[fault.block].stage for fault in faults} == {1}
    narrow = check_plan(circuit, plan, replace(SWINGING, swing_mm=0.9), WIDE, WIRE)
    assert {fault.rule for fault in narrow} == {"needle-on-wire"}


def test_a_place_off_the_wire_is_found(swung):
    circuit, plan = swung
    needles = plan.blocks[0].runs[0].needles.copy()
    needles[5] += (2, 2)
    run = replace(plan.blocks[0].runs[0], needles=needles)
    moved = replace(plan, blocks=(replace(plan.blocks[0], runs=(run,)), *plan.blocks[1:]))
    (fault,) = check_plan(circuit, moved, SWINGING, WIDE, WIRE)
    assert (fault.rule, fault.stitch) == ("wire-followed", 5)


def test_without_room_for_the_swing_the_interval_that_would_do_is_told():
    circuit = grid_circuit(2, 3, 25.0, 40.0)
    with pytest.raises(NoRoomError, match=r"for 2\.\d\d mm of it other wire lies"):
        stitch_plan(circuit, Stitching(), SWINGING, WIRE, ())
    with pytest.raises(PatternError, match=r"swing_mm = 1 mm and would strike the wire"):
        stitch_plan(circuit, Stitching(), replace(SWINGING, swing_mm=1.0), WIRE, ())


def test_a_zigzag_is_no_row_of_places():
    circuit = grid_circuit(1, 2, 25.0, 40.0)
    plan = stitch_plan(circuit, Stitching(), Machine(500, 500, 0.75), WIRE, ())
    faults = check_plan(circuit, plan, SWINGING, Stitching(), WIRE)
    assert "wire-followed" in {fault.rule for fault in faults}


def test_stitches_are_closer_on_bends_and_square_over_the_wire_in_every_crossing():
    circuit = grid_circuit(2, 3, 7.0, 40.0)
    machine = Machine(500, 500, 0.75)
    bent = Stitching(smallest_bend_diameters=15)
    plan = stitch_plan(circuit, bent, machine, 0.2, ())
    assert check_plan(circuit, plan, machine, bent, 0.2) == ()
    for block in (block for block in plan.blocks if block.kind.is_wire):
        line = circuit.stages[block.stage].line_string(5e-4)
        needles = block.runs[0].needles / UNITS_PER_MM
        at = line.project(shapely.points(needles))
        for junction in junctions_mm(circuit, block.stage):
            pair = needles[np.abs(at - junction) < 0.1]
            assert len(pair) == 2
            assert pair.mean(axis=0) == pytest.approx(line.interpolate(junction).coords[0], abs=0.1)


@settings(deadline=None, max_examples=40)
@given(st.floats(1, 40), st.floats(2, 60), st.floats(0.5, 6), st.floats(5, 90))
def test_a_pace_keeps_both_limits(radius, straight, interval, angle):
    path = WirePath((Line(-straight, 0, 0, 0), Arc(0, radius, radius, -np.pi / 2, np.pi)))
    stitching = Stitching(couching_interval_mm=interval, couching_angle_deg=angle)
    measure = pace(path, stitching)
    end = measure.of(np.array([path.length_mm]))[0]
    assert end == pytest.approx(straight / interval + max(np.pi * radius / interval, 180 / angle))
    at = measure.back(even_stations(0.0, end, np.empty(0), 1.0).at)
    assert np.diff(at).max() <= interval + 1e-6
    turn = np.degrees(np.maximum(at - straight, 0) / radius)
    assert np.diff(turn).max() <= angle + 1e-4


def test_junctions_stand_twice_and_divide_evenly():
    spaced = even_stations(0.0, 10.0, np.array([3.5]), 1.0)
    assert spaced.at == pytest.approx(
        [0, 0.875, 1.75, 2.625, 3.5, 3.5, *np.linspace(3.5, 10, 8)[1:]]
    )
    assert spaced.play[[0, 4, 5, -1]].tolist() == [0, 0, 0, 0]
    assert spaced.play[1] == pytest.approx(0.0625)


@settings(deadline=None, max_examples=60)
@given(st.lists(st.booleans(), min_size=2, max_size=40), st.integers(1, 8))
def test_the_farthest_steps_find_a_way_if_there_is_one(free, step):
    """Against trying every reachable place."""
    free, at = np.array(free), np.arange(len(free), dtype=float)
    free[0] = True
    way = farthest_steps(free, at, step)
    reached = {0}
    for k in range(1, len(free)):
        if (free[k] or k == len(free) - 1) and any(k - step <= j < k for j in reached):
            reached.add(k)
    assert (way is not None) == (len(free) - 1 in reached)
    if way is not None:
        assert np.diff(way).min() > 0
        assert np.diff(way).max() <= step
        assert np.all(free[way[1:-1]])
