from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import Point

from patterns.circuit import CrossingKind
from patterns.errors import PatternError
from patterns.grid import square_grid
from patterns.layout import tangent_layout
from patterns.loop import Loop
from patterns.path import Arc, Line
from patterns.tangent_switch import grid_circuit, single_circuit

SIZES = [(1, 1), (1, 2), (2, 1), (1, 5), (5, 1), (2, 2), (3, 3), (3, 4), (4, 3), (6, 7), (9, 8)]
DIAMETER, TAIL = 25.0, 40.0

grids = pytest.mark.parametrize(("rows", "columns"), SIZES)


def arcs_of(circuit):
    pieces = circuit.stages[0].pieces + circuit.stages[1].pieces
    return [piece for piece in pieces if isinstance(piece, Arc)]


@grids
def test_wire_runs_smoothly_from_tail_to_tail(rows, columns):
    circuit = grid_circuit(rows, columns, DIAMETER, TAIL)
    for half in circuit.stages:
        for jump in half.joints():
            assert np.abs(jump).max() < 1e-9
    end, leaving = circuit.stages[0].at(circuit.stages[0].length_mm)
    start, going_on = circuit.stages[1].at(0.0)
    assert start == pytest.approx(end, abs=1e-9)
    assert going_on == pytest.approx(leaving, abs=1e-9)


@grids
def test_wire_is_as_long_as_all_loops_and_both_tails(rows, columns):
    circuit = grid_circuit(rows, columns, DIAMETER, TAIL)
    assert circuit.wire_length_mm == pytest.approx(rows * columns * np.pi * DIAMETER + 2 * TAIL)


@grids
def test_every_angle_of_every_loop_is_covered_once(rows, columns):
    circuit = grid_circuit(rows, columns, DIAMETER, TAIL)
    angle = np.linspace(0, 2 * np.pi, 101)[:-1] + 0.0123
    for loop in circuit.layout.loops:
        count = np.zeros(len(angle))
        for arc in arcs_of(circuit):
            if np.hypot(arc.centre_x_mm - loop.x_mm, arc.centre_y_mm - loop.y_mm) < 1e-9:
                turn = np.sign(arc.sweep_rad) * (angle - arc.start_rad)
                count += np.mod(turn, 2 * np.pi) < abs(arc.sweep_rad)
        assert np.all(count == 1)


@grids
def test_each_half_passes_every_crossing_where_it_says(rows, columns):
    circuit = grid_circuit(rows, columns, DIAMETER, TAIL)
    kinds = [crossing.kind for crossing in circuit.crossings]
    assert kinds.count(CrossingKind.CONTACT) == len(circuit.layout.contacts)
    assert kinds.count(CrossingKind.TERMINALS) == 1
    common = np.array([(c.x_mm, c.y_mm) for c in circuit.crossings])
    first, one = circuit.wire.at([c.first_mm for c in circuit.crossings])
    second, other = circuit.wire.at([c.second_mm for c in circuit.crossings])
    assert first == pytest.approx(common, abs=1e-6)
    assert second == pytest.approx(common, abs=1e-6)
    assert np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]).max() < 1e-9
    start, split = circuit.starts_mm
    assert start == 0
    assert all(0 < c.first_mm < split < c.second_mm for c in circuit.crossings)
    assert circuit.crossings_of(1) == circuit.crossings


@grids
def test_halves_meet_nowhere_else(rows, columns):
    circuit = grid_circuit(rows, columns, DIAMETER, TAIL)
    split = Point(circuit.stages[1].at(0.0)[0][0])
    places = [Point(c.x_mm, c.y_mm).buffer(3) for c in circuit.crossings] + [split.buffer(3)]
    halves = [circuit.stages[0].line_string(), circuit.stages[1].line_string()]
    for place in places:
        halves = [half.difference(place) for half in halves]
    assert halves[0].distance(halves[1]) > 0.3  # 3 mm from a tangent point: 3² / 25


@grids
def test_tails_leave_clear_of_all_other_loops(rows, columns):
    circuit = grid_circuit(rows, columns, DIAMETER, TAIL)
    for tail in (circuit.stages[0].pieces[0], circuit.stages[1].pieces[-1]):
        assert isinstance(tail, Line)
        assert tail.length_mm == pytest.approx(TAIL)
        along = tail.at(np.linspace(0, TAIL, 200))[0]
        for loop in circuit.layout.loops[1:]:
            away = np.hypot(along[:, 0] - loop.x_mm, along[:, 1] - loop.y_mm)
            assert away.min() > loop.radius_mm + 3


@grids
def test_successive_pieces_lie_on_different_loops(rows, columns):
    circuit = grid_circuit(rows, columns, DIAMETER, TAIL)
    for half in circuit.stages:
        centres = [(p.centre_x_mm, p.centre_y_mm) for p in half.pieces if isinstance(p, Arc)]
        assert all(a != b for a, b in pairwise(centres))
    assert len(arcs_of(circuit)) == 2 * rows * columns


def test_every_grid_can_be_halved():
    for rows, columns in product(range(1, 9), repeat=2):
        circuit = grid_circuit(rows, columns, DIAMETER, TAIL)
        assert len(circuit.stages) == 2
        common = np.array([(c.x_mm, c.y_mm) for c in circuit.crossings])
        for at in ("first_mm", "second_mm"):
            point, _ = circuit.wire.at([getattr(c, at) for c in circuit.crossings])
            assert point == pytest.approx(common, abs=1e-6)


def test_single_loop_is_halved_opposite_its_terminals():
    circuit = grid_circuit(1, 1, 30.0, 10.0)
    split = 15 * np.sqrt(0.5) * np.ones(2)
    assert circuit.stages[1].at(0.0)[0][0] == pytest.approx(split)
    assert circuit.crossings[0].first_mm == pytest.approx(10)


def test_terminals_cross_once_at_the_start_point():
    circuit = grid_circuit(2, 2, 20.0, 15.0)
    terminals = circuit.crossings[-1]
    assert terminals.kind is CrossingKind.TERMINALS
    assert (terminals.x_mm, terminals.y_mm) == pytest.approx(
        (-10 - 10 * np.sqrt(0.5), -10 - 10 * np.sqrt(0.5))
    )


@settings(deadline=None, max_examples=40)
@given(st.floats(3.0, 30.0), st.floats(3.0, 30.0), st.floats(0.6, 5.6))
def test_two_unequal_loops_from_any_start(a, b, start):
    layout = tangent_layout((Loop(0, 0, 2 * a), Loop(a + b, 0, 2 * b)))
    circuit = single_circuit(layout, (0,), 0, start, 12.0)
    assert circuit.wire_length_mm == pytest.approx(2 * np.pi * (a + b) + 24)
    contact = circuit.crossings[0]
    assert circuit.wire.at(contact.first_mm)[0][0] == pytest.approx([a, 0], abs=1e-7)
    assert circuit.wire.at(contact.second_mm)[0][0] == pytest.approx([a, 0], abs=1e-7)
    assert len(circuit.stages) == 2


def test_loops_without_a_switch_are_named_with_the_nearest_distance():
    layout = tangent_layout((Loop(0, 0, 10), Loop(10, 0, 10), Loop(20.25, 0, 10), Loop(50, 0, 10)))
    with pytest.raises(PatternError, match=r"loops 2, 3; the nearest pair, 1 and 2, is 0\.250 mm"):
        single_circuit(layout, (0,), 0, 4.0, 20.0)


def test_a_ring_of_switches_is_refused():
    with pytest.raises(PatternError, match="close a ring"):
        single_circuit(square_grid(2, 2, 10.0), (0, 1, 2, 3), 0, 4.0, 20.0)


def test_a_switch_named_twice_is_refused():
    with pytest.raises(PatternError, match="named twice"):
        single_circuit(square_grid(1, 2, 10.0), (0, 0), 0, 4.0, 20.0)


@pytest.mark.parametrize("switch", [-1, 1])
def test_a_switch_that_is_no_contact_is_refused(switch):
    with pytest.raises(PatternError, match="none of the 1 contacts"):
        single_circuit(square_grid(1, 2, 10.0), (switch,), 0, 4.0, 20.0)


def test_a_start_loop_that_is_none_is_refused():
    with pytest.raises(PatternError, match="no loop 2"):
        single_circuit(square_grid(1, 2, 10.0), (0,), 2, 4.0, 20.0)


def test_a_start_in_a_contact_is_refused():
    with pytest.raises(PatternError, match="is the contact 0"):
        single_circuit(square_grid(1, 2, 10.0), (0,), 0, 2 * np.pi, 20.0)


def test_a_wire_without_tails_is_refused():
    with pytest.raises(PatternError, match="needs a tail"):
        grid_circuit(1, 1, 10.0, 0.0)


def test_a_row_begun_in_its_middle_takes_three_stages():
    """From the middle of a row the wire goes out and back on one side, then on the other."""
    circuit = single_circuit(square_grid(1, 3, 10.0), (0, 1), 1, -np.pi / 2, 20.0)
    assert len(circuit.stages) == 3
    assert [circuit.crossings_of(k)[0].x_mm for k in (1, 2)] == pytest.approx([-5, 5])


def test_seven_loops_of_a_hexagon_in_a_row_take_more_stages():
    ring = [(20 * np.cos(k * np.pi / 3), 20 * np.sin(k * np.pi / 3)) for k in range(6)]
    layout = tangent_layout((Loop(0, 0, 20), *(Loop(x, y, 20) for x, y in ring)))
    assert len(layout.contacts) == 12
    index = {(c.first, c.second): k for k, c in enumerate(layout.contacts)}
    row = (*(index[k, k + 1] for k in range(1, 6)), index[0, 1])
    circuit = single_circuit(layout, row, 6, -np.pi / 2, 20.0)
    assert len(circuit.stages) > 2
    for stage in range(len(circuit.stages)):
        begin, end = (*circuit.starts_mm, circuit.wire_length_mm)[stage : stage + 2]
        assert not any(begin < c.first_mm < c.second_mm < end for c in circuit.crossings[:-1])
