import numpy as np
import pytest
import shapely

from patterns.coupon import INTERVALS_MM, MARGINS_MM, coupon
from patterns.errors import PatternError
from patterns.machine import Machine
from patterns.plan import UNITS_PER_MM
from patterns.rules import check_plan
from patterns.stitching import Stitching

LARGE, SMALL = Machine(406, 330, 0.75), Machine(140, 190, 0.75, hoop_rim_mm=5)


@pytest.mark.parametrize("wire", [0.1, 0.3, 0.5])
@pytest.mark.parametrize("machine", [LARGE, SMALL])
@pytest.mark.parametrize("margin", [0.1, 0.3])
def test_a_coupon_breaks_no_rule_and_never_meets_the_wire(wire, machine, margin):
    stitching = Stitching(needle_margin_mm=margin, cover_margin_mm=margin)
    made = coupon(machine, stitching, wire)
    assert check_plan(made.circuit, made.plan, machine, made.stitching, wire) == ()
    lines = shapely.union_all([stage.line_string(5e-4) for stage in made.circuit.stages])
    for block in (made.plan.blocks[0], made.plan.blocks[3]):
        needles = np.concatenate([run.needles for run in block.runs]) / UNITS_PER_MM
        assert shapely.distance(shapely.points(needles), lines).min() >= (wire + 0.75) / 2


def test_cells_are_sewn_as_they_say():
    made = coupon(LARGE, Stitching(), 0.3)
    first = made.plan.blocks[1].runs[0].needles / UNITS_PER_MM
    for cell in made.cells:
        if cell.row == "cover":
            runs = [run.needles / UNITS_PER_MM for run in made.plan.blocks[2].runs]
            (here,) = [r for r in runs if abs(r[:, 0].mean() - cell.x_mm) < 1]
            off = np.abs(here[:, 1] - cell.y_mm)
            assert np.allclose(off, 0.525 + cell.margin_mm, atol=0.051)
            continue
        near = np.hypot(first[:, 0] - cell.x_mm, first[:, 1] - cell.y_mm) < 5.5
        inside = first[near & (np.abs(first[:, 1] - cell.y_mm) < 3)]
        assert np.abs(inside[:, 1] - cell.y_mm) == pytest.approx(0.525 + cell.margin_mm, abs=0.051)
        if cell.row == "interval":
            assert np.abs(np.diff(inside[:, 0])).max() <= cell.interval_mm + 0.1
            assert np.abs(np.diff(inside[:, 0])).max() >= 0.85 * cell.interval_mm


def test_values_rise_from_cell_to_cell_and_unusual_ones_are_marked():
    made = coupon(LARGE, Stitching(needle_margin_mm=0.2), 0.3)
    rows = {name: [c for c in made.cells if c.row == name] for name in ("width", "interval")}
    assert [c.margin_mm for c in rows["width"]] == list(MARGINS_MM)
    assert [c.interval_mm for c in rows["interval"]] == list(INTERVALS_MM)
    assert [c.usual for c in rows["width"]] == [False, False, True, True, True, True]
    assert [c.usual for c in rows["interval"]] == [False, True, True, True, True, False]


def test_no_room_and_a_swinging_head_are_refused():
    with pytest.raises(PatternError, match="no room for a coupon"):
        coupon(Machine(60, 60, 0.75), Stitching(), 0.3)
    with pytest.raises(PatternError, match="leaves to the head"):
        coupon(Machine(406, 330, 0.75, couching="centreline"), Stitching(), 0.3)
