from dataclasses import replace

import numpy as np
import pytest
import shapely

from patterns.errors import PatternError
from patterns.machine import Machine
from patterns.plan import UNITS_PER_MM, BlockKind
from patterns.registration import Mark
from patterns.sewn_run import thread_run, wire_run
from patterns.stitch_plan import stitch_plan
from patterns.stitching import Stitching
from patterns.tangent_switch import grid_circuit

MACHINE, STITCHING, WIRE = Machine(500, 500, 0.75), Stitching(), 0.3
CROSS = Mark(80, 0, (np.array([[80, -4], [80, 4.0]]), np.array([[76, 0], [84, 0.0]])))
LETTER = Mark(
    -80, 0, (np.array([[-80, -4], [-80, 4.0], [-76, 4]]), np.array([[-80, 0], [-77, 0.0]]))
)

cases = pytest.mark.parametrize(
    ("rows", "columns", "diameter", "wire"),
    [(1, 1, 25, 0.3), (3, 3, 25, 0.3), (3, 3, 50, 0.5), (2, 5, 25, 0.2), (5, 1, 30, 0.3)],
)


def plan_of(rows, columns, diameter, wire, *marks, stitching=STITCHING, machine=MACHINE):
    circuit = grid_circuit(rows, columns, diameter, 40)
    return circuit, stitch_plan(circuit, stitching, machine, wire, marks)


def sewn(block):
    return np.concatenate([run.needles for run in block.runs]) / UNITS_PER_MM


def distance(points, *paths):
    lines = shapely.union_all([path.line_string(5e-4) for path in paths])
    return shapely.distance(shapely.points(points), lines)


@cases
def test_blocks_come_in_the_order_of_making(rows, columns, diameter, wire):
    circuit, plan = plan_of(rows, columns, diameter, wire, CROSS, LETTER)
    order = [BlockKind.MARKS, BlockKind.WIRE, BlockKind.COVER, BlockKind.WIRE]
    assert [block.kind for block in plan.blocks] == order
    assert [block.stage for block in plan.blocks] == [0, 0, 1, 1]
    runs = [len(block.runs) for block in plan.blocks]
    assert runs == [2, 1, len(circuit.crossings), 1]


def test_without_marks_the_wire_comes_first():
    _, plan = plan_of(1, 1, 25, WIRE)
    assert plan.blocks[0].kind is BlockKind.WIRE


@cases
def test_no_rounded_needle_point_meets_wire_laid_so_far(rows, columns, diameter, wire):
    circuit, plan = plan_of(rows, columns, diameter, wire)
    first, cover, second = (sewn(block) for block in plan.blocks)
    touching = (wire + MACHINE.needle_diameter_mm) / 2
    assert distance(first, circuit.stages[0]).min() >= touching
    assert distance(cover, circuit.stages[0]).min() >= touching
    assert distance(second, *circuit.stages).min() >= touching


@cases
def test_stitches_are_neither_too_long_nor_too_short(rows, columns, diameter, wire):
    _, plan = plan_of(rows, columns, diameter, wire, CROSS, LETTER)
    for block in plan.blocks:
        for run in block.runs:
            step = np.diff(run.needles, axis=0, prepend=np.array([run.approach]))
            assert np.abs(step).max() <= 121
            assert np.hypot(*step.T).min() >= 3


@cases
def test_the_machine_arrives_a_millimetre_before_the_first_needle_point(
    rows, columns, diameter, wire
):
    _, plan = plan_of(rows, columns, diameter, wire, CROSS, LETTER)
    for run in (run for block in plan.blocks for run in block.runs):
        arrival, onward = run.needles[0] - run.approach, run.needles[1] - run.needles[0]
        assert np.hypot(*arrival) == pytest.approx(10, abs=0.8)
        assert arrival @ onward > 0.95 * np.hypot(*arrival) * np.hypot(*onward)


@cases
def test_the_ends_of_the_tails_are_left_for_the_crimp(rows, columns, diameter, wire):
    circuit, plan = plan_of(rows, columns, diameter, wire)
    tails = (circuit.stages[0].at(0)[0][0], circuit.stages[1].at(1e6)[0][0])
    for end, block in zip(tails, (plan.blocks[0], plan.blocks[-1]), strict=True):
        assert np.hypot(*(sewn(block) - end).T).min() == pytest.approx(10, abs=0.15)


@cases
def test_the_second_half_starts_beside_the_last_hole_of_the_first(rows, columns, diameter, wire):
    _, plan = plan_of(rows, columns, diameter, wire)
    gap = sewn(plan.blocks[2])[0] - sewn(plan.blocks[0])[-1]
    assert np.hypot(*gap) == pytest.approx(wire + 0.75 + 0.2, abs=0.15)


def test_instructions_tell_wire_and_slack():
    circuit, plan = plan_of(3, 3, 25, WIRE, CROSS)
    marks, first, cover, second = (block.instruction for block in plan.blocks)
    split = circuit.stages[1].at(0.0)[0][0]
    slack = int(np.ceil(np.hypot(*(sewn(plan.blocks[2]) - split).T).max() - 0.1))
    assert "registration marks" in marks
    assert f"{int(np.ceil(circuit.wire_length_mm))} mm of 0.3 mm wire" in first
    assert "Do not cut the wire" in cover
    assert any(f"at least {n} mm of slack" in cover for n in (slack, slack + 1))
    assert "crimp" in second


@pytest.mark.parametrize("mark", [CROSS, LETTER])
def test_a_mark_is_sewn_in_one_run_along_all_its_strokes(mark):
    _, plan = plan_of(1, 1, 25, WIRE, mark)
    (run,) = plan.blocks[0].runs
    strokes = shapely.MultiLineString([shapely.LineString(s) for s in mark.strokes])
    thread = shapely.LineString(run.needles / UNITS_PER_MM)
    assert strokes.hausdorff_distance(thread) < 0.1
    assert thread.within(strokes.buffer(0.1))
    longest = np.hypot(*np.diff(run.needles, axis=0).T).max()
    assert longest <= 30
    assert np.array_equal(run.needles[0], run.needles[2])
    assert np.array_equal(run.needles[-1], run.needles[-3])
    assert np.hypot(*(run.needles[1] - run.needles[0])) == 7


def test_strokes_apart_are_sewn_in_a_run_each():
    apart = Mark(0, 0, (np.array([[60, 0], [60, 8.0]]), np.array([[65, 0], [65, 8.0]])))
    _, plan = plan_of(1, 1, 25, WIRE, apart)
    assert len(plan.blocks[0].runs) == 2


def test_too_small_a_margin_is_found_after_rounding():
    with pytest.raises(PatternError, match="take a larger needle margin"):
        plan_of(3, 3, 25, WIRE, stitching=replace(STITCHING, needle_margin_mm=0.01))


def test_a_tail_without_room_for_the_crimp_is_refused():
    with pytest.raises(PatternError, match="the tails are 8 mm long"):
        stitch_plan(grid_circuit(1, 1, 25, 8), STITCHING, MACHINE, WIRE, ())


def test_a_machine_that_would_merge_the_couching_is_refused():
    with pytest.raises(PatternError, match="merge the stitches that hold the wire"):
        plan_of(1, 1, 25, WIRE, machine=replace(MACHINE, shortest_stitch_mm=1.5))


def test_an_interval_of_nothing_is_refused():
    with pytest.raises(PatternError, match="longer than 0 mm"):
        plan_of(1, 1, 25, WIRE, stitching=replace(STITCHING, couching_interval_mm=0.0))


def test_couching_longer_than_a_stitch_is_refused():
    with pytest.raises(PatternError, match="shorter couching interval"):
        plan_of(
            1,
            1,
            60,
            WIRE,
            stitching=replace(STITCHING, couching_interval_mm=40.0, couching_angle_deg=180.0),
        )


def test_plans_repeat():
    for one, two in zip(
        plan_of(3, 3, 25, WIRE, LETTER)[1].blocks,
        plan_of(3, 3, 25, WIRE, LETTER)[1].blocks,
        strict=True,
    ):
        assert one.instruction == two.instruction
        for a, b in zip(one.runs, two.runs, strict=True):
            assert a.approach == b.approach
            assert np.array_equal(a.needles, b.needles)


def test_short_stitches_are_merged_without_moving_a_point():
    run = thread_run(np.array([[0, 0], [0.2, 0], [0.4, 0], [0.5, 0], [2.0, 0]]), MACHINE)
    assert run.needles.tolist() == [[0, 0], [4, 0], [20, 0]]
    assert run.approach == (-10, 0)


def test_long_stitches_of_thread_are_split_and_of_wire_refused():
    points = np.array([[0, 0], [30.0, 1.0]])
    assert thread_run(points, MACHINE).needles.tolist() == [[0, 0], [100, 3], [200, 7], [300, 10]]
    with pytest.raises(PatternError, match=r"30\.0 mm long along one axis"):
        wire_run(points, MACHINE)


def test_a_run_of_one_point_is_refused():
    with pytest.raises(PatternError, match="less than two needle points"):
        thread_run(np.array([[0, 0], [0.1, 0]]), MACHINE)
