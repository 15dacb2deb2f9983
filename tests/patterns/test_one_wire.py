from itertools import pairwise
from math import cos, pi, sin, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from patterns.errors import PatternError
from patterns.lattice import Lattice, lattice_cells, lattice_loops
from patterns.layout import ROUNDED_MM, tangent_layout
from patterns.loop import Loop
from patterns.machine import Machine
from patterns.one_wire import one_wire
from patterns.path import Arc
from patterns.registration import registration_marks
from patterns.rules import check_plan
from patterns.stitch_plan import stitch_plan
from patterns.stitching import Stitching
from patterns.terminals import Side

MACHINE, STITCHING, WIRE = Machine(2000, 2000, 0.75), Stitching(), 0.3
FLOWER = (Loop(0, 0, 25), *(Loop(25 * cos(k * pi / 3), 25 * sin(k * pi / 3), 25) for k in range(6)))


def circuit_of(loops, side=Side.CORNER):
    return one_wire(tangent_layout(tuple(loops)), side, 40.0)


def lattice_circuit(lattice, rows, columns, side=Side.CORNER):
    return circuit_of(lattice_loops(lattice, rows, columns, 25.0), side)


def assert_good(circuit):
    assert circuit.closed
    gaps, kinks = circuit.wire.joints()
    assert max(gaps.max(initial=0), kinks.max(initial=0)) < 1e-9
    around = 2 * np.pi * sum(loop.radius_mm for loop in circuit.layout.loops)
    assert circuit.wire_length_mm == pytest.approx(around + 80)
    assert_each_loop_once(circuit)
    splits = np.array(circuit.starts_mm[1:])
    for crossing in circuit.crossings:
        assert np.any((crossing.first_mm < splits) & (splits < crossing.second_mm))
    common = np.array([(c.x_mm, c.y_mm) for c in circuit.crossings])
    for at in ("first_mm", "second_mm"):
        point, _ = circuit.wire.at([getattr(c, at) for c in circuit.crossings])
        assert point == pytest.approx(common, abs=1e-6)
    found = [c for k in range(1, len(circuit.stages)) for c in circuit.crossings_of(k)]
    assert sorted(found, key=id) == sorted(circuit.crossings, key=id)


def assert_each_loop_once(circuit):
    turned = dict.fromkeys(circuit.layout.loops, 0.0)
    middles = {(loop.x_mm, loop.y_mm): loop for loop in circuit.layout.loops}
    for piece in circuit.wire.pieces:
        if isinstance(piece, Arc):
            turned[middles[piece.centre_x_mm, piece.centre_y_mm]] += piece.sweep_rad
    assert np.abs(list(turned.values())) == pytest.approx(2 * np.pi)


def planned(circuit):
    points = circuit.wire.polyline()
    low, high = points.min(axis=0) - 5, points.max(axis=0) + 5
    marks = registration_marks((*low.tolist(), *high.tolist()), 8.0, 6.0)
    return stitch_plan(circuit, STITCHING, MACHINE, WIRE, marks)


@st.composite
def connected_cells(draw):
    """Grow a set of cells from one of them, neighbour by neighbour."""
    lattice = draw(st.sampled_from(list(Lattice)))
    rows, columns = draw(st.integers(1, 4)), draw(st.integers(2, 4))
    loops = lattice_loops(lattice, rows, columns, 25.0)
    layout = tangent_layout(loops)
    kept = {draw(st.integers(0, len(loops) - 1))}
    for _ in range(draw(st.integers(0, len(loops) - 1))):
        beside = {
            k
            for c in layout.contacts
            for k in (c.first, c.second)
            if (c.first in kept) != (c.second in kept)
        } - kept
        kept.add(draw(st.sampled_from(sorted(beside))))
        if len(kept) == len(loops):
            break
    return tuple(loops[k] for k in sorted(kept))


@settings(deadline=None, max_examples=25)
@given(connected_cells())
def test_any_connected_part_of_a_lattice_is_one_good_wire(loops):
    circuit = circuit_of(loops)
    assert_good(circuit)
    assert check_plan(circuit, planned(circuit), MACHINE, STITCHING, WIRE) == ()


@settings(deadline=None, max_examples=20)
@given(connected_cells(), st.sampled_from(list(Side)))
def test_tails_are_clear_of_all_other_loops(loops, side):
    circuit = circuit_of(loops, side)
    along = np.concatenate([circuit.wire.pieces[k].at(np.linspace(0, 40, 99))[0] for k in (0, -1)])
    away = [np.hypot(*(along - (loop.x_mm, loop.y_mm)).T) - loop.radius_mm for loop in loops]
    assert np.min(away) > -1e-9
    assert np.sum(np.min(away, axis=1) < 2 - 1e-9) == 1


@pytest.mark.parametrize(
    ("lattice", "rows", "columns", "stages"),
    [
        (Lattice.GRID, 1, 1, 2),
        (Lattice.GRID, 6, 6, 2),
        (Lattice.GRID, 20, 20, 2),
        (Lattice.BRICK, 2, 2, 3),
        (Lattice.BRICK, 3, 3, 3),
        (Lattice.BRICK, 5, 5, 5),
        (Lattice.HEXAGONAL, 3, 3, 4),
        (Lattice.HEXAGONAL, 5, 5, 5),
    ],
)
def test_stages_of_known_lattices(lattice, rows, columns, stages):
    circuit = lattice_circuit(lattice, rows, columns)
    assert len(circuit.stages) == stages
    assert_good(circuit)


def test_a_triangle_takes_two_stages_and_a_flower_three():
    """Around one hole a split can be set; a flower has six."""
    triangle = circuit_of((Loop(0, 0, 25), Loop(25, 0, 25), Loop(12.5, 12.5 * sqrt(3), 25)))
    assert len(triangle.stages) == 2
    assert check_plan(triangle, planned(triangle), MACHINE, STITCHING, WIRE) == ()
    flower = circuit_of(FLOWER)
    assert len(flower.layout.contacts) == 12
    assert len(flower.stages) == 3
    assert check_plan(flower, planned(flower), MACHINE, STITCHING, WIRE) == ()


@pytest.mark.parametrize("side", list(Side))
@pytest.mark.parametrize("lattice", list(Lattice))
def test_plans_of_lattices_break_no_rule(lattice, side):
    circuit = lattice_circuit(lattice, 3, 3, side)
    assert check_plan(circuit, planned(circuit), MACHINE, STITCHING, WIRE) == ()


def test_a_chain_of_three_sizes():
    chain = (Loop(0, 0, 50), Loop(40, 0, 30), Loop(65, 0, 20))
    circuit = circuit_of(chain)
    assert_good(circuit)
    assert len(circuit.stages) == 2
    assert check_plan(circuit, planned(circuit), MACHINE, STITCHING, WIRE) == ()


def test_a_small_loop_in_the_hollow_of_two_large_ones():
    small = 30.0
    height = sqrt((25 + small / 2) ** 2 - 25**2)
    circuit = circuit_of((Loop(0, 0, 50), Loop(50, 0, 50), Loop(25, height, small)))
    assert_good(circuit)
    assert check_plan(circuit, planned(circuit), MACHINE, STITCHING, WIRE) == ()


@pytest.mark.parametrize(
    ("side", "outward"),
    [
        (Side.LEFT, (-1, 0)),
        (Side.RIGHT, (1, 0)),
        (Side.TOP, (0, 1)),
        (Side.BOTTOM, (0, -1)),
        (Side.CORNER, (-1, -1)),
    ],
)
def test_the_tails_leave_where_they_should(side, outward):
    circuit = lattice_circuit(Lattice.GRID, 3, 4, side)
    terminals = circuit.crossings[-1]
    centre = np.array([(loop.x_mm, loop.y_mm) for loop in circuit.layout.loops])
    place = np.array([terminals.x_mm, terminals.y_mm])
    facing = place - centre[np.argmin(np.hypot(*(centre - place).T))]
    assert facing @ outward / np.hypot(*facing) / np.hypot(*outward) > 0.99
    assert len(circuit.stages) == 2


def test_tails_without_room_are_refused():
    ring = [
        Loop(300 * cos(k * pi / 30), 300 * sin(k * pi / 30), 600 * sin(pi / 60)) for k in range(60)
    ]
    with pytest.raises(PatternError, match="tails cannot leave at the left"):
        circuit_of(ring, Side.LEFT)


def test_splits_are_far_from_contacts():
    for circuit in (lattice_circuit(Lattice.BRICK, 4, 4), circuit_of(FLOWER)):
        at = np.array([s for c in circuit.crossings for s in (c.first_mm, c.second_mm)])
        for split in circuit.starts_mm[1:]:
            assert np.abs(at - split).min() > 6  # half of a sixth of the way around a loop


def test_the_same_every_time():
    one, other = (lattice_circuit(Lattice.BRICK, 4, 4) for _ in range(2))
    assert one == other


def test_loops_that_nearly_touch_are_named_with_their_gap():
    with pytest.raises(PatternError, match=r"loops 0 .* and 1 .* only 0\.2500 mm apart"):
        circuit_of((Loop(0, 0, 20), Loop(20.25, 0, 20)))


def test_loops_apart_are_named_with_their_distance():
    with pytest.raises(PatternError, match=r"1 of 3 .* nearest pair, 1 and 2, is 5\.000 mm"):
        circuit_of((Loop(0, 0, 20), Loop(20, 0, 20), Loop(45, 0, 20)))


def test_no_loop_at_all_is_refused():
    with pytest.raises(PatternError, match="no loop"):
        circuit_of(())


def test_circles_with_rounded_places_touch_within_the_tolerance():
    rounded = tuple(Loop(round(loop.x_mm, 3), round(loop.y_mm, 3), 25) for loop in FLOWER)
    assert len(tangent_layout(rounded).contacts) < 12
    circuit = one_wire(tangent_layout(rounded, ROUNDED_MM), Side.CORNER, 40.0)
    assert len(circuit.layout.contacts) == 12
    assert check_plan(circuit, planned(circuit), MACHINE, STITCHING, WIRE) == ()


def test_rows_of_a_lattice():
    assert len(lattice_cells(Lattice.BRICK, 3, 3)) == 9
    assert len(lattice_cells(Lattice.HEXAGONAL, 3, 3)) == 8
    for lattice in (Lattice.BRICK, Lattice.HEXAGONAL):
        loops = lattice_loops(lattice, 4, 4, 10.0, [(1, 2)])
        assert len(loops) == len(lattice_cells(lattice, 4, 4)) - 1
        heights = sorted({round(loop.y_mm, 6) for loop in loops})
        assert [b - a for a, b in pairwise(heights)] == pytest.approx([5 * sqrt(3)] * 3)
        edges = [loop.x_mm for loop in loops]
        assert min(edges) == pytest.approx(-max(edges))
