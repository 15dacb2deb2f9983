from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from shapely import LineString, Point

from patterns.circuit import CrossingKind
from patterns.errors import PatternError
from patterns.exits import LEAST_BEND_MM
from patterns.grid import square_grid
from patterns.groups import Group, touching_groups
from patterns.laid_wire import all_laid, laid_wire
from patterns.lattice import Lattice, lattice_loops
from patterns.layout import Layout, tangent_layout
from patterns.loop import Loop
from patterns.outline import cut_outline
from patterns.path import Line, WirePath
from patterns.plan import BlockKind, StitchPlan
from patterns.rules import check_outline, check_plan
from patterns.rules.feed import check_feed_and_cut
from patterns.rules.subject import Subject
from patterns.stitch_plan import stitch_plan
from patterns.tails import tail_pieces
from patterns.terminals import CRIMP_APART_MM, TAIL_CLEAR_MM, Side
from patterns.wiring import Wiring, several_wires

TAIL_MM = 40.0
DIAMETERS = (0.3, 0.2, 0.4)


def rows_wired(side: Side = Side.LEFT) -> Wiring:
    """Three rows of a grid that touch, each with its own wire."""
    groups = (Group(f"row{r}", tuple(range(3 * r, 3 * r + 3)), side) for r in range(3))
    bends = tuple(25 * one for one in DIAMETERS)
    return several_wires(square_grid(3, 3, 25.0), tuple(groups), TAIL_MM, bends)


def apart() -> Layout:
    """Two arrays of 2 x 2 loops, a column apart."""
    return tangent_layout(lattice_loops(Lattice.GRID, 2, 5, 25.0, [(0, 2), (1, 2)]))


@pytest.fixture(scope="module")
def rows(bench) -> tuple[Wiring, StitchPlan]:
    wiring = rows_wired()
    return wiring, stitch_plan(wiring, bench.stitching, bench.machine, DIAMETERS, ())


def faults(bench, wiring, plan, diameters=DIAMETERS) -> set[str]:
    found = check_plan(wiring, plan, bench.machine, bench.stitching, diameters)
    return {fault.rule for fault in found}


@pytest.mark.parametrize("angle", [0.3, 2.0, 4.0])
@pytest.mark.parametrize("bend", [None, 9.0])
def test_tails_leave_without_a_kink(angle: float, bend: float | None) -> None:
    comes, goes = tail_pieces(Loop(3.0, 4.0, 20.0), angle, TAIL_MM, bend)
    gaps, kinks = WirePath((*comes, *goes)).joints()
    assert np.max(gaps) < 1e-9
    assert np.max(kinks) < 1e-9
    ends = [piece.length_mm for piece in (*comes, *goes) if isinstance(piece, Line)]
    assert ends == pytest.approx([TAIL_MM, TAIL_MM])
    outside = LineString(WirePath((*comes, *goes)).polyline()).distance(Point(3.0, 4.0))
    assert outside == pytest.approx(10.0, abs=1e-4)


def test_circuits_of_touching_rows_break_no_rule(bench, rows) -> None:
    wiring, plan = rows
    assert faults(bench, wiring, plan) == set()
    outline = cut_outline(wiring, DIAMETERS, 2.0, 1.0)
    assert check_outline(outline, wiring, DIAMETERS, 2.0, plan) == ()
    assert len(outline.outsides) == 1


def test_every_contact_between_circuits_is_crossed_once(rows) -> None:
    wiring, _ = rows
    contacts = [c for c in wiring.crossings if c.kind is CrossingKind.CONTACT]
    assert len(contacts) == len(wiring.layout.contacts)
    assert wiring.wire_length_mm == pytest.approx(sum(c.wire_length_mm for c in wiring.circuits))
    at = wiring.wire.at([s for c in wiring.crossings for s in (c.first_mm, c.second_mm)])[0]
    common = np.repeat([(c.x_mm, c.y_mm) for c in wiring.crossings], 2, axis=0)
    np.testing.assert_allclose(at, common, atol=1e-6)
    assert all(c.first_mm < c.second_mm for c in wiring.crossings)


def test_every_cover_between_circuits_is_needed(bench, rows) -> None:
    wiring, plan = rows
    between = [
        k
        for k, block in enumerate(plan.blocks)
        if block.kind is BlockKind.COVER and wiring.begins_wire(block.stage)
    ]
    assert len(between) == 2
    for k in between:
        runs = plan.blocks[k].runs
        for left_out in range(len(runs)):
            rest = replace(plan.blocks[k], runs=runs[:left_out] + runs[left_out + 1 :])
            bare = StitchPlan((*plan.blocks[:k], rest, *plan.blocks[k + 1 :]))
            assert "insulation" in faults(bench, wiring, bare)


def test_each_wire_has_its_own_clearance(bench, rows) -> None:
    wiring, plan = rows
    assert "needle-on-wire" in faults(bench, wiring, plan, (0.3, 0.2, 0.7))
    assert "needle-on-wire" in faults(bench, wiring, plan, (0.6, 0.2, 0.4))
    assert "bend-radius" in faults(bench, wiring, plan, (0.3, 0.2, 0.6))


def test_thicker_wire_is_nearer() -> None:
    line = WirePath((Line(0.0, 0.0, 10.0, 0.0),))
    far = WirePath((Line(0.0, 50.0, 10.0, 50.0),))
    wires = all_laid([laid_wire(line, wire_diameter_mm=0.4), laid_wire(far, wire_diameter_mm=1.0)])
    points = np.array([(5.0, 1.0), (5.0, 49.0)])
    assert wires.like(0.4).distance_mm(points, 2.0) == pytest.approx([1.0, 0.7])
    assert wires.distance_mm(points, 2.0) == pytest.approx([1.3, 1.0])


def test_tails_keep_clear_of_all_other_wire() -> None:
    wiring = rows_wired()
    tails = [tail.line_string(1e-3) for circuit in wiring.circuits for tail in circuit.tails]
    for group, own in zip(wiring.groups, wiring.circuits, strict=True):
        for k in set(range(9)) - set(group.loops):
            loop = wiring.layout.loops[k]
            for tail in own.tails:
                gap = tail.line_string(1e-3).distance(Point(loop.x_mm, loop.y_mm))
                assert gap >= loop.radius_mm + TAIL_CLEAR_MM - 1e-2
    for a, b in combinations(range(len(tails)), 2):
        if a // 2 != b // 2:
            assert tails[a].distance(tails[b]) >= TAIL_CLEAR_MM - 0.11
    bends = [c.tails[0].smallest_radius_mm for c in wiring.circuits if c.tail_pieces == 2]
    assert bends
    assert min(bends) >= LEAST_BEND_MM


def test_a_loop_in_the_middle_has_no_way_out() -> None:
    ring = Group("ring", tuple(k for k in range(9) if k != 4))
    middle = Group("middle", (4,), anywhere=True)
    with pytest.raises(PatternError, match=r"circuit middle: its tails cannot leave anywhere"):
        several_wires(square_grid(3, 3, 25.0), (ring, middle), TAIL_MM, (7.5, 7.5))
    upward = (ring, replace(middle, side=Side.TOP, anywhere=False))
    with pytest.raises(PatternError, match=r"circuit middle: its tails cannot leave at the top"):
        several_wires(square_grid(3, 3, 25.0), upward, TAIL_MM, (7.5, 7.5))


def test_groups_apart_are_cut_apart(bench) -> None:
    layout = apart()
    found = touching_groups(layout)
    groups = tuple(Group(str(k), own, anywhere=True) for k, own in enumerate(found))
    wiring = several_wires(layout, groups, TAIL_MM, (7.5, 7.5))
    plan = stitch_plan(wiring, bench.stitching, bench.machine, 0.3, ())
    kinds = [str(block.kind) for block in plan.blocks]
    assert kinds == ["wire", "cover", "wire", "wire", "cover", "wire"]
    assert faults(bench, wiring, plan, 0.3) == set()
    outline = cut_outline(wiring, 0.3, 2.0, 1.0)
    assert len(outline.further) == 1
    assert check_outline(outline, wiring, 0.3, 2.0, plan) == ()
    swapped = replace(outline, further=(*outline.further, outline.outside))
    (fault,) = check_outline(swapped, wiring, 0.3, 2.0, plan)
    assert fault.rule == "cut-overlap"
    assert "meets that of another" in fault.message


def test_the_operator_is_told_each_wire(rows) -> None:
    wiring, plan = rows
    said = [block.instruction for block in plan.blocks]
    for circuit, diameter, name in zip(
        wiring.circuits, DIAMETERS, ("row0", "row1", "row2"), strict=True
    ):
        own = [one for one in said if one.startswith("Wire head: load") and name in one]
        assert len(own) == 1
        assert f"{np.ceil(circuit.wire_length_mm):g} mm of {diameter:g} mm wire" in own[0]
    assert sum("Then cut the wire" in one for one in said) == 3
    assert "Do not cut" not in next(one for one in said if "stage 1 of 2 of circuit row1" in one)


@pytest.mark.parametrize(
    ("loops", "message"),
    [
        (((0, 1, 2, 3), (4, 5, 6)), "loop 7 at .* is in no circuit"),
        (((0, 1, 2, 3), (3, 4, 5, 6, 7)), "loop 3 at .* is in circuits a, b"),
        (((0, 1, 2, 3, 4), (5, 6, 7, 9)), "circuit b: there is no loop 9"),
        (((0, 1, 2, 4), (3, 5, 6, 7)), "one wire cannot run through all of its loops"),
    ],
)
def test_groups_that_will_not_do_are_named(loops, message: str) -> None:
    groups = tuple(Group(name, own) for name, own in zip("ab", loops, strict=True))
    with pytest.raises(PatternError, match=message):
        several_wires(apart(), groups, TAIL_MM, (7.5, 7.5))


def test_no_stage_ends_in_a_contact_with_another_circuit(bench) -> None:
    """The middle of the widest stretch between own contacts can be just that point."""
    shares = {"a": (0, 4, 5), "b": (1, 2), "c": (3, 6, 7)}
    groups = tuple(Group(name, loops, Side.CORNER) for name, loops in shares.items())
    diameters = (0.3, 0.3, 0.3)
    wiring = several_wires(square_grid(2, 4, 60.0), groups, TAIL_MM, (7.5, 7.5, 7.5))
    plan = stitch_plan(wiring, bench.stitching, bench.machine, diameters, ())
    assert faults(bench, wiring, plan, diameters) <= {"hoop"}
    ends = [stage.at(stage.length_mm)[0][0] for stage in wiring.stages]
    contacts = np.array([(c.x_mm, c.y_mm) for c in wiring.layout.contacts])
    assert min(np.hypot(*(contacts - end).T).min() for end in ends) > 1.0


def free_ends(wiring: Wiring) -> list[list[LineString]]:
    """The last 10 mm of wire at both ends, circuit by circuit."""
    return [
        [
            LineString(one.wire.at([a, b])[0])
            for a, b in ((0.0, 10.0), (one.wire_length_mm - 10.0, one.wire_length_mm))
        ]
        for one in wiring.circuits
    ]


@pytest.mark.parametrize("loop_mm", [10.0, 12.0, 15.0])
@pytest.mark.parametrize("side", list(Side))
def test_crimps_of_two_circuits_have_room(loop_mm: float, side: Side) -> None:
    groups = tuple(Group(f"row{r}", (2 * r, 2 * r + 1), side, anywhere=True) for r in range(3))
    wiring = several_wires(square_grid(3, 2, loop_mm), groups, TAIL_MM, (4.0, 4.0, 4.0))
    for first, second in combinations(free_ends(wiring), 2):
        assert min(a.distance(b) for a in first for b in second) >= CRIMP_APART_MM - 1e-6


def test_ends_without_room_for_crimps_are_found(bench, rows) -> None:
    wiring, plan = rows
    first, second, third = wiring.circuits
    subject = Subject(
        replace(wiring, circuits=(first, second, first)),
        plan,
        bench.machine,
        bench.stitching,
        DIAMETERS,
    )
    said = [(fault.message, fault.actual, fault.allowed) for fault in check_feed_and_cut(subject)]
    message = "the free ends of two wires leave no room for their crimps: distance"
    assert said == [(message, 0.0, CRIMP_APART_MM)] * 2
    assert not check_feed_and_cut(replace(subject, circuit=wiring))
    assert third.wire_length_mm > 0
