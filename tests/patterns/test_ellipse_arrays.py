"""Arrays of ellipses, from the lattice to the rules."""

from itertools import product
from math import hypot, pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from patterns.groups import Group
from patterns.lattice import Lattice, lattice_loops, row_loops
from patterns.layout import tangent_layout
from patterns.loop import Loop
from patterns.loop_gap import LoopGaps
from patterns.loop_order import loops_in_order
from patterns.machine import Machine
from patterns.one_wire import one_wire
from patterns.outline import cut_outline
from patterns.parallel import Limits, parallel_groups
from patterns.registration import registration_marks
from patterns.rules import check_outline, check_plan
from patterns.stitch_plan import stitch_plan
from patterns.stitching import Stitching
from patterns.terminals import TAIL_CLEAR_MM, Side
from patterns.wiring import several_wires

MACHINE, STITCHING, WIRE, MARGIN = Machine(9000, 9000, 0.75), Stitching(), 0.2, 1.0


def circuit_of(loops, side=Side.CORNER):
    return one_wire(tangent_layout(loops), side, 40.0)


def assert_sewn(circuit):
    outline = cut_outline(circuit, WIRE, MARGIN, 0.5)
    marks = registration_marks(outline.bounds_mm, 8.0, 6.0)
    plan = stitch_plan(circuit, STITCHING, MACHINE, WIRE, marks)
    assert check_plan(circuit, plan, MACHINE, STITCHING, WIRE) == ()
    assert check_outline(outline, circuit, WIRE, MARGIN, plan) == ()
    assert circuit.closed
    for part in circuit.parts:
        gaps, kinks = part.wire.joints()
        assert max(gaps.max(), kinks.max()) < 1e-8
    around = sum(loop.around_mm for loop in circuit.layout.loops)
    tails = sum(tail.length_mm for part in circuit.parts for tail in part.tails)
    assert circuit.wire_length_mm == pytest.approx(around + tails, rel=1e-5)


@pytest.mark.parametrize(
    ("lattice", "ratio", "upright"), [*product(Lattice, [1.0, 1.4, 3.0], [False, True])]
)
def test_a_stretched_lattice_touches_where_the_round_one_does(lattice, ratio, upright):
    def contacts(layout):
        return [(c.first, c.second) for c in layout.contacts]

    loops = lattice_loops(lattice, 3, 4, 30.0, [(1, 1)], axis_ratio=ratio, upright=upright)
    assert contacts(tangent_layout(loops)) == contacts(
        tangent_layout(lattice_loops(lattice, 3, 4, 30.0, [(1, 1)]))
    )


@settings(deadline=None, max_examples=8)
@given(
    st.sampled_from(Lattice), st.floats(1.05, 3), st.floats(1.0, 1.6), st.booleans(),
    st.sampled_from(Side),
)  # fmt: skip
def test_stretched_lattices_are_sewn(lattice, ratio, size, upright, side):
    loops = lattice_loops(lattice, 2, 3, 40 * ratio * size, axis_ratio=ratio, upright=upright)
    assert_sewn(circuit_of(loops, side))


def test_rows_of_different_ellipses_are_sewn():
    assert_sewn(circuit_of(row_loops([40, 60, 50], axis_ratio=1.5, upright=True)))


def test_a_row_touches_from_loop_to_loop():
    layout = tangent_layout(row_loops([25, 30, 20, 25], [(0, 3)]))
    assert [(c.first, c.second) for c in layout.contacts] == [(0, 1), (1, 2)]
    assert [c.x_mm for c in layout.contacts] == pytest.approx([-12.5, 17.5])


def test_ellipses_in_any_direction_are_sewn():
    loops = [row_loops([60], axis_ratio=1.5)[0]]
    for normal, shape in ((0.7, (45, 1.3, 2.0)), (-0.4, (50, 1.8, 0.5))):
        loops.append(_beside(loops[-1], normal, shape))
    assert_sewn(circuit_of(tuple(loops)))


def _beside(loop, normal, shape):
    x, y = loop.point_mm(normal)
    back_x, back_y = Loop(0.0, 0.0, *shape).point_mm(normal + pi)
    return Loop(x - back_x, y - back_y, *shape)


def test_the_bend_radius_is_that_of_the_ellipse():
    circuit = circuit_of(lattice_loops(Lattice.GRID, 2, 2, 50.0, axis_ratio=2.0))
    long, short = circuit.layout.loops[0].semi_axes_mm
    assert circuit.smallest_radius_mm == pytest.approx(short**2 / long, rel=1e-9)


def test_loops_are_counted_as_the_wire_reaches_them():
    circuit = circuit_of(lattice_loops(Lattice.GRID, 2, 3, 50.0, axis_ratio=2.0))
    order = loops_in_order(circuit)
    assert sorted(order) == list(range(6))
    pairs = np.array(order[:-1]), np.array(order[1:])
    gap, _ = LoopGaps(circuit.layout.loops).of(*pairs)
    assert gap == pytest.approx(0, abs=1e-9)


def test_several_circuits_of_ellipses_leave_clear_of_one_another():
    loops = lattice_loops(Lattice.GRID, 2, 4, 60.0, axis_ratio=1.5)
    layout = tangent_layout(loops)
    limits = Limits(900.0, 4, Side.BOTTOM, 30.0, 5.0)
    groups = parallel_groups(layout, limits)
    assert len(groups) > 1
    assert all(isinstance(group, Group) for group in groups)
    wiring = several_wires(layout, groups, 30.0, (5.0,) * len(groups))
    assert_sewn(wiring)
    for circuit, group in zip(wiring.circuits, groups, strict=True):
        others = [loop for k, loop in enumerate(loops) if k not in group.loops]
        for tail in circuit.tails:
            for x, y in tail.polyline().tolist():
                for loop in others:
                    assert not loop.holds(x, y)
                    near, _ = loop.at_eccentric(np.linspace(0, 2 * pi, 300))
                    assert min(hypot(a - x, b - y) for a, b in near) > TAIL_CLEAR_MM - 1e-3


def test_a_cut_line_names_no_corner_twice():
    circuit = circuit_of(lattice_loops(Lattice.BRICK, 3, 3, 60.0, axis_ratio=2.0))
    for ring in cut_outline(circuit, WIRE, 2.0, 1.0).rings:
        assert np.hypot(*(np.roll(ring, -1, axis=0) - ring).T).min() > 1e-6
