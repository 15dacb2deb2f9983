"""Wires of rows that lie apart, and the ties that hold two layers of them together."""

from dataclasses import replace

import numpy as np
import pytest
from shapely import box

from patterns.errors import PatternError
from patterns.exits import LEAST_BEND_MM
from patterns.laid_wire import laid_wire
from patterns.lattice import rows_apart
from patterns.layout import tangent_layout
from patterns.loop_order import loops_in_order
from patterns.machine import Machine
from patterns.outline import cut_outline
from patterns.plan import BlockKind, StitchPlan
from patterns.rows import row_wires
from patterns.rules import check_outline, check_plan
from patterns.rules.ties import check_in_hoop, check_ties
from patterns.sleeve_ties import tie_block
from patterns.stitch_plan import stitch_plan
from patterns.stitching import Stitching
from patterns.terminals import Side
from patterns.wire_index import WireIndex

WIRE_MM, LOOP_MM, PITCH_MM = 0.3, 25.0, 34.0
MACHINE = Machine(hoop_width_mm=400, hoop_height_mm=300, needle_diameter_mm=0.75)
STITCHING = Stitching(stripes="columns")
CLEAR = {"clear_of_wire_mm": 0.525, "clear_of_beams_mm": 1.0}


def wires(side=Side.LEFT, rows=2, columns=3, joined=1, bend_mm=25 * WIRE_MM):
    layout = tangent_layout(rows_apart(rows, columns, LOOP_MM, PITCH_MM))
    return row_wires(layout, "lower", side, 30.0, bend_mm, joined=joined)


def ties(circuit, *above, **changes):
    given = {"angle_deg": 20.0, "length_mm": 3.0} | changes
    return tie_block(
        circuit.layout.loops,
        laid_wire(*circuit.stages, *above),
        wire_diameter_mm=WIRE_MM,
        machine=MACHINE,
        stitching=STITCHING,
        before="Lay the beams.",
        **given,
    )


@pytest.fixture(scope="module")
def lower():
    return wires()


@pytest.fixture(scope="module")
def tied(lower):
    plan = stitch_plan(lower, STITCHING, MACHINE, WIRE_MM, ())
    return StitchPlan((*plan.blocks, ties(lower)))


@pytest.fixture(scope="module")
def upper():
    return WireIndex(wires(Side.RIGHT).wire)


@pytest.fixture(scope="module")
def beams():
    return box(-40, -23, 40, -11).union(box(-40, 11, 40, 23))


def test_each_row_is_a_circuit_of_two_stages_with_tails_along_it(lower):
    assert lower.part_names == ("lower 1", "lower 2")
    assert [len(part.stages) for part in lower.parts] == [2, 2]
    assert lower.closed
    bend = max(25 * WIRE_MM, LEAST_BEND_MM)
    for part, axis in zip(lower.parts, (-PITCH_MM / 2, PITCH_MM / 2), strict=True):
        assert part.wire_length_mm == pytest.approx(
            np.pi * (3 * LOOP_MM + bend) + 2 * 30.0, abs=1e-9
        )
        (first, _), (last, _) = part.wire.at(0.0), part.wire.at(part.wire_length_mm)
        end = -1.5 * LOOP_MM - bend - 30.0
        assert np.allclose(
            sorted([*first, *last], key=lambda p: p[1]), [(end, axis - bend), (end, axis + bend)]
        )


def test_tails_on_the_right_are_those_on_the_left_turned_round(lower):
    right = wires(Side.RIGHT)
    left_ends = [part.wire.at(0.0)[0][0] for part in lower.parts]
    right_ends = [part.wire.at(0.0)[0][0] for part in right.parts]
    assert np.allclose(left_ends, -np.array(right_ends[::-1]))


def test_tails_do_not_leave_across_the_rows():
    with pytest.raises(PatternError, match="left or right, not at the top"):
        wires(Side.TOP)


@pytest.mark.parametrize("side", [Side.LEFT, Side.RIGHT])
@pytest.mark.parametrize("columns", [1, 3])
def test_joined_rows_are_one_wire_in_series_that_keeps_every_rule(side, columns):
    single, joined = (wires(side, 3, columns, k) for k in (1, 3))
    (part,) = joined.parts
    assert part.layout == single.layout
    assert joined.switches == single.switches
    assert len(part.stages) == 4  # n rows of two stages make n + 1
    bend = max(25 * WIRE_MM, LEAST_BEND_MM)
    between = PITCH_MM / 2 - bend  # radius of the turns: half the distance of the tails
    assert part.wire_length_mm == pytest.approx(
        sum(one.wire_length_mm for one in single.parts) - 4 * 30.0 + 2 * np.pi * between
    )
    assert part.smallest_radius_mm == pytest.approx(min(bend, between))
    gaps, kinks = part.wire.joints()
    assert gaps.max() < 1e-9
    assert kinks.max() < 1e-9
    assert joined.closed
    for one in joined.crossings:
        places = np.array([one.first_mm, one.second_mm])
        for point in np.concatenate([part.wire.at(s)[0] for s in places]):
            assert point == pytest.approx((one.x_mm, one.y_mm), abs=1e-9)
    plan = stitch_plan(joined, STITCHING, MACHINE, WIRE_MM, ())
    assert not check_plan(joined, plan, MACHINE, STITCHING, WIRE_MM)
    outline = cut_outline(joined, WIRE_MM, 2.0, 1.0)
    assert len(outline.outsides) == 1
    assert not check_outline(outline, joined, WIRE_MM, 2.0, plan)
    assert set(loops_in_order(joined)) == set(range(3 * columns))


def test_four_rows_joined_by_two_are_two_circuits():
    joined = wires(rows=4, joined=2)
    assert joined.part_names == ("lower 1", "lower 2")
    assert [len(loops) for loops in joined.part_loops] == [6, 6]
    with pytest.raises(PatternError, match="4 rows cannot be joined by 3"):
        wires(rows=4, joined=3)


def test_rows_with_no_room_for_the_bend_between_them_are_not_joined():
    with pytest.raises(PatternError, match="with a radius of 8 mm, less than 9 mm"):
        wires(joined=2, bend_mm=9.0)


def test_rows_that_nearly_touch_are_refused():
    layout = tangent_layout(rows_apart(2, 2, LOOP_MM, LOOP_MM + 0.5))
    with pytest.raises(PatternError, match=r"only 0\.5000 mm apart"):
        row_wires(layout, "lower", Side.LEFT, 30.0, 7.5)


def test_every_edge_of_every_loop_is_tied_twice_and_every_rule_kept(lower, tied, upper, beams):
    block = tied.blocks[-1]
    assert block.kind is BlockKind.TIES
    assert len(block.runs) == 4 * len(lower.layout.loops)
    assert not check_plan(lower, tied, MACHINE, STITCHING, WIRE_MM)
    assert not check_ties(tied, lower.layout.loops, upper, beams, **CLEAR)


def test_a_plan_without_ties_or_with_one_too_few_is_found(lower, tied, upper, beams):
    def rules(plan):
        found = check_ties(plan, lower.layout.loops, upper, beams, **CLEAR)
        return [fault.rule for fault in found]

    assert rules(StitchPlan(tied.blocks[:-1])) == ["ties"]
    last = tied.blocks[-1]
    fewer = replace(last, runs=last.runs[1:])
    assert rules(StitchPlan((*tied.blocks[:-1], fewer))) == ["ties"]
    beside = replace(last.runs[0], needles=last.runs[0].needles + np.array([0, 25]))
    moved = replace(last, runs=(beside, *last.runs[1:]))
    assert "ties" in rules(StitchPlan((*tied.blocks[:-1], moved)))


def test_a_needle_on_the_upper_wire_or_on_a_beam_is_found(lower, tied, upper, beams):
    found = check_ties(tied, lower.layout.loops, upper, beams.buffer(4), **CLEAR)
    assert {fault.rule for fault in found} == {"tie-on-beam"}
    # an upper layer that lies 1.2 mm off brings its wire below the needle
    layout = tangent_layout(rows_apart(2, 3, LOOP_MM, PITCH_MM + 2.4))
    off = WireIndex(row_wires(layout, "upper", Side.RIGHT, 30.0, 7.5).wire)
    found = check_ties(tied, lower.layout.loops, off, beams, **CLEAR)
    assert {fault.rule for fault in found} == {"tie-on-wire"}


def test_ties_before_stripes_are_sewn_too_early(lower, tied):
    swapped = StitchPlan((*tied.blocks[:-2], tied.blocks[-1], tied.blocks[-2]))
    rules = {fault.rule for fault in check_plan(lower, swapped, MACHINE, STITCHING, WIRE_MM)}
    assert "blocks" in rules


def test_ties_too_short_for_the_needle_are_refused(lower):
    with pytest.raises(PatternError, match="brings the needle to within"):
        ties(lower, length_mm=1.8)


def test_beams_lie_in_the_hoop(beams):
    assert not check_in_hoop(beams, (80, 46))
    (fault,) = check_in_hoop(beams, (80, 44))
    assert fault.rule == "beams-hoop"
    assert fault.actual == pytest.approx(1.0)
