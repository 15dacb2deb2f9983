from dataclasses import replace

import numpy as np
import pytest
import shapely

from patterns.laid_wire import laid_wire
from patterns.loop import Loop
from patterns.machine import Machine
from patterns.plan import UNITS_PER_MM, BlockKind, StitchPlan
from patterns.rules import check_plan
from patterns.stitch_plan import stitch_plan
from patterns.stitching import Stitching
from patterns.stripes import stripes
from patterns.tangent_switch import grid_circuit

MACHINE, WIRE = Machine(500, 500, 0.75), 0.3
CIRCUIT = grid_circuit(2, 3, 25.0, 40.0)


def striped(direction, passes=1):
    stitching = Stitching(stripes=direction, stripe_passes=passes)
    return stitching, stitch_plan(CIRCUIT, stitching, MACHINE, WIRE, ())


@pytest.mark.parametrize(("direction", "count", "across"), [("rows", 2, 1), ("columns", 3, 0)])
@pytest.mark.parametrize("passes", [1, 2])
def test_stripes_run_straight_through_the_centres_and_miss_the_wire(
    direction, count, across, passes
):
    stitching, plan = striped(direction, passes)
    block = plan.blocks[-1]
    assert block.kind is BlockKind.STRIPES
    assert "does not stretch" in block.instruction
    assert check_plan(CIRCUIT, plan, MACHINE, stitching, WIRE) == ()
    assert len(block.runs) == count
    wire = shapely.union_all([stage.line_string(5e-4) for stage in CIRCUIT.stages])
    centres = {round((loop.x_mm, loop.y_mm)[across], 3) for loop in CIRCUIT.layout.loops}
    for run in block.runs:
        needles = run.needles / UNITS_PER_MM
        assert np.ptp(needles[:, across]) == 0
        assert min(abs(needles[0, across] - c) for c in centres) < 0.06
        assert shapely.distance(shapely.points(needles), wire).min() >= (WIRE + 0.75) / 2
        step = np.hypot(*np.diff(needles, axis=0).T)
        assert step.max() <= 2.6
        sizes = [(loop.x_mm, loop.y_mm)[1 - across] for loop in CIRCUIT.layout.loops]
        assert needles[:, 1 - across].max() > max(sizes) + 12.5 + (WIRE + 0.75) / 2
        assert needles[:, 1 - across].min() < min(sizes) - 12.5 - (WIRE + 0.75) / 2
        ends = needles[[0, -1], 1 - across]
        assert np.ptp(ends) < 0.11 if passes == 2 else np.ptp(ends) > 25


def test_loops_that_do_not_touch_have_a_stripe_each():
    loops = [CIRCUIT.layout.loops[k] for k in (0, 2)]
    settings = {"clear_mm": 0.6, "longest_mm": 12.1, "stitching": Stitching()}
    sewn = stripes(loops, laid_wire(*CIRCUIT.stages), angle_deg=0.0, **settings)
    assert len(sewn) == 2
    slanted = stripes(loops, laid_wire(*CIRCUIT.stages), angle_deg=30.0, **settings)
    along = slanted[0][-1] - slanted[0][0]
    assert np.degrees(np.arctan2(along[1], along[0])) == pytest.approx(30)


def test_stripes_that_are_missing_or_not_asked_for_are_found():
    stitching, plan = striped("rows")
    bare = StitchPlan(plan.blocks[:-1])
    (fault,) = check_plan(CIRCUIT, bare, MACHINE, stitching, WIRE)
    assert (fault.rule, "stripes is missing" in fault.message) == ("blocks", True)
    plain = replace(stitching, stripes="none")
    (fault,) = check_plan(CIRCUIT, plan, MACHINE, plain, WIRE)
    assert fault.rule == "blocks"


def test_a_stripe_on_the_wire_is_struck():
    stitching, plan = striped("rows")
    first, *others = plan.blocks[-1].runs
    needles = first.needles.copy()
    step = np.abs(np.hypot(*(needles / UNITS_PER_MM - (-12.5, needles[0, 1] / 10)).T))
    needles[int(np.argmin(step))] = (-125, needles[0, 1])
    struck = replace(plan.blocks[-1], runs=(replace(first, needles=needles), *others))
    faults = check_plan(CIRCUIT, StitchPlan((*plan.blocks[:-1], struck)), MACHINE, stitching, WIRE)
    assert {fault.rule for fault in faults} == {"needle-on-wire"}


@pytest.mark.parametrize(("angle", "half"), [(0.0, "width"), (90.0, "height")])
def test_stripes_reach_from_end_to_end_of_an_ellipse(angle, half):
    loop = Loop(3.0, -2.0, 40.0, axis_ratio=1.8)
    long, short = loop.semi_axes_mm
    assert loop.along_mm(np.deg2rad(angle)) == pytest.approx(long if half == "width" else short)
    for turned in (0.3, 1.1, 2.5):
        x = 3.0 + loop.along_mm(turned) * np.cos(turned)
        y = -2.0 + loop.along_mm(turned) * np.sin(turned)
        assert ((x - 3) / long) ** 2 + ((y + 2) / short) ** 2 == pytest.approx(1)
