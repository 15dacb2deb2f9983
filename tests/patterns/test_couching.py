import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from patterns.couching import LEFT, RIGHT, couching, needle_clearance_mm, needle_points
from patterns.errors import PatternError
from patterns.laid_wire import laid_wire
from patterns.locks import POINTS_PER_LOCK, sides_with_locks, with_locks
from patterns.machine import Machine
from patterns.path import Arc, Line, WirePath
from patterns.plan import UNITS_PER_MM, quantise
from patterns.rules import check_plan
from patterns.stitch_plan import stitch_plan
from patterns.stitching import Stitching
from patterns.tangent_switch import grid_circuit

MACHINE, STITCHING, WIRE = Machine(500, 500, 0.75), Stitching(), 0.3
CLEAR = needle_clearance_mm(WIRE, MACHINE, STITCHING)
TOUCHING = (WIRE + MACHINE.needle_diameter_mm) / 2

grids = pytest.mark.parametrize(
    ("rows", "columns", "diameter"), [(1, 1, 25), (2, 3, 25), (3, 3, 50), (4, 1, 20)]
)


def second_half(circuit, first_side=LEFT):
    laid = laid_wire(*circuit.stages)
    span = (0.0, circuit.stages[1].length_mm - 10)
    return couching(circuit.stages[1], span, first_side, laid, clear_mm=CLEAR, stitching=STITCHING)


def distances(points, *paths):
    """Shapely's own distances, to within half a micrometre."""
    lines = shapely.union_all([path.line_string(5e-4) for path in paths])
    return shapely.distance(shapely.points(points), lines)


def sides_of(path, points):
    """Side of the path on which points lie, in the order of the path."""
    line = path.line_string(5e-4)
    at, tangent = path.at(line.project(shapely.points(points)))
    across = points - at
    return np.sign(tangent[:, 0] * across[:, 1] - tangent[:, 1] * across[:, 0])


@settings(deadline=None, max_examples=60)
@given(
    st.lists(st.tuples(st.floats(-30, 30), st.floats(-30, 30)), min_size=1, max_size=20),
    st.floats(1, 20),
    st.floats(-7, 7),
    st.floats(0.1, 6.2),
    st.sampled_from([-1, 1]),
)
def test_distance_to_laid_wire_is_that_of_a_fine_polyline(points, radius, start, sweep, sense):
    path = WirePath((Line(-20, -3, -2, 5), Arc(4, 2, radius, start, sense * sweep)))
    points = np.array(points)
    fine = shapely.MultiLineString([WirePath((piece,)).line_string(5e-4) for piece in path.pieces])
    expected = shapely.distance(shapely.points(points), fine)
    assert laid_wire(path).distance_mm(points, 200.0) == pytest.approx(expected, abs=1e-3)
    near = laid_wire(path).distance_mm(points, 5.0)
    assert np.all(np.isinf(near) == (near > 5.0))
    assert np.all(np.isinf(near[expected > 5.001]))
    assert np.all(np.isfinite(near[expected < 4.999]))


def test_wire_beyond_the_reach_is_infinitely_far():
    wire = laid_wire(WirePath((Line(0, 0, 10, 0),)))
    distance = wire.distance_mm(np.array([[5, 4.99], [5, 5.01], [5, 7]]), 5.0)
    assert distance.tolist() == [pytest.approx(4.99), np.inf, np.inf]


@grids
def test_no_needle_point_meets_wire_laid_so_far_even_when_rounded(rows, columns, diameter):
    circuit = grid_circuit(rows, columns, diameter, 40.0)
    planned = second_half(circuit)
    halves = circuit.stages
    assert distances(planned, *halves).min() >= CLEAR - 1e-3
    assert distances(quantise(planned) / UNITS_PER_MM, *halves).min() >= TOUCHING


@grids
def test_points_alternate_and_stitches_are_sewable(rows, columns, diameter):
    circuit = grid_circuit(rows, columns, diameter, 40.0)
    sewn = quantise(second_half(circuit)) / UNITS_PER_MM
    side = sides_of(circuit.stages[1], sewn[POINTS_PER_LOCK:-POINTS_PER_LOCK])
    assert np.all(side[1:] == -side[:-1])
    step = np.diff(sewn, axis=0)
    assert np.abs(step).max() <= 12.1
    assert np.hypot(*step.T).min() >= 0.3


def test_points_are_one_clearance_away_where_there_is_room():
    path = WirePath((Line(0, 0, 30, 0),))
    sewn = couching(path, (0, 20), RIGHT, laid_wire(path), clear_mm=CLEAR, stitching=STITCHING)
    body = sewn[2:-2]
    assert body[:, 0] == pytest.approx(np.linspace(0, 20, 11))
    assert body[:, 1] == pytest.approx(CLEAR * np.array([-1, 1] * 5 + [-1]))


@settings(deadline=None, max_examples=30)
@given(st.floats(0.8, 80.0))
def test_interval_divides_the_run_and_is_never_longer_than_asked(length):
    path = WirePath((Line(0, 0, 100, 0),))
    sewn = couching(path, (0, length), LEFT, laid_wire(path), clear_mm=CLEAR, stitching=STITCHING)
    step = np.diff(sewn[2:-2, 0])
    assert step.max() <= STITCHING.couching_interval_mm + 1e-6
    assert np.ptp(step) < 1e-9
    assert sewn[2:-2][[0, -1], 0] == pytest.approx([0, length])


def test_beside_an_earlier_wire_the_needle_goes_to_the_nearest_place_beyond():
    """A parallel wire 0.4 mm to the left: the needle belongs one clearance beyond it."""
    path, earlier = WirePath((Line(0, 0, 30, 0),)), WirePath((Line(0, 0.4, 30, 0.4),))
    laid = laid_wire(path, earlier)
    left, right = needle_points(path, np.array([9.0, 11.0]), np.array([LEFT, RIGHT]), laid, CLEAR)
    assert left == pytest.approx([9, 0.4 + CLEAR], abs=1e-5)
    assert right == pytest.approx([11, -CLEAR])


def test_at_the_second_half_some_points_straddle_and_none_is_far_out():
    circuit = grid_circuit(2, 2, 25.0, 40.0)
    out = distances(second_half(circuit), circuit.stages[1])
    assert 0 < np.mean(out > CLEAR + 0.01) < 0.3
    assert out.max() < 4 * CLEAR


def test_no_room_is_reported_with_the_place():
    path = WirePath((Line(0, 0, 30, 0),))
    fence = [WirePath((Line(9, y, 11, y),)) for y in np.arange(0.5, 5.0, 0.5)]
    with pytest.raises(PatternError, match=r"no place for the needle .* \(10\.00, 0\.00\) mm"):
        needle_points(
            path, np.array([5.0, 10.0]), np.array([LEFT, LEFT]), laid_wire(path, *fence), CLEAR
        )


def test_a_span_too_short_for_a_lock_is_refused():
    path = WirePath((Line(0, 0, 30, 0),))
    with pytest.raises(PatternError, match=r"only 0\.50 mm of wire"):
        couching(path, (3, 3.5), LEFT, laid_wire(path), clear_mm=CLEAR, stitching=STITCHING)


def test_locks_go_forth_and_back_beside_the_wire_at_both_ends():
    assert with_locks(np.array([1.0, 3.0, 5.0]), 0.7) == pytest.approx(
        [1.0, 1.7, 1.0, 3.0, 5.0, 4.3, 5.0]
    )
    assert sides_with_locks(np.array([1.0, -1.0])).tolist() == [1, 1, 1, -1, -1, -1]


@grids
def test_locks_are_off_the_wire_and_as_long_as_asked(rows, columns, diameter):
    circuit = grid_circuit(rows, columns, diameter, 40.0)
    sewn = second_half(circuit, RIGHT)
    for lock in (sewn[:3], sewn[-3:]):
        assert lock[0] == pytest.approx(lock[2])
        assert np.hypot(*(lock[1] - lock[0])) == pytest.approx(0.7, rel=0.1)
        assert len(set(sides_of(circuit.stages[1], lock).tolist())) == 1


@pytest.mark.parametrize(("loop_mm", "wire_mm"), [(10, 0.2), (12, 0.2), (15, 0.3), (15, 0.25)])
def test_small_loops_find_room_by_closer_stitches(loop_mm, wire_mm):
    """Where a stitch finds no place beyond an earlier wire, it moves along its own."""
    circuit = grid_circuit(3, 3, loop_mm, 40.0)
    plan = stitch_plan(circuit, Stitching(), MACHINE, wire_mm, ())
    assert check_plan(circuit, plan, MACHINE, Stitching(), wire_mm) == ()
