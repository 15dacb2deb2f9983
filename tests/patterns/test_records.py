from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from patterns.errors import PatternError
from patterns.machine import Machine
from patterns.plan import Block, BlockKind, Run, StitchPlan
from patterns.records import Command, plan_from_records, plan_records

MACHINE = Machine(300, 300, 0.75)

points = st.tuples(st.integers(-1500, 1500), st.integers(-1500, 1500))
steps = st.tuples(st.integers(-121, 121), st.integers(-121, 121))


@st.composite
def runs(draw):
    approach = draw(points)
    moves = draw(st.lists(steps, min_size=1, max_size=6))
    return Run(approach, np.array(approach) + np.cumsum(np.array(moves), axis=0))


blocks = st.builds(
    Block,
    st.sampled_from(BlockKind),
    st.text(max_size=3),
    st.lists(runs(), min_size=1, max_size=3).map(tuple),
    st.integers(0, 4),
)
plans = st.builds(StitchPlan, st.lists(blocks, min_size=1, max_size=5).map(tuple))


def run(*needles, approach=(0, 0)):
    return Run(approach, np.array(needles, dtype=np.int64))


def plan_of(*kinds):
    return StitchPlan(
        tuple(Block(kind, "", (run((300, 5), (310, 5), approach=(300, 0)),)) for kind in kinds)
    )


def commands_of(plan, machine=MACHINE):
    return plan_records(plan, machine).command.tolist()


@settings(deadline=None, max_examples=100)
@given(plans, st.integers(0, 9))
def test_a_plan_comes_back_from_its_records(plan, jumps_per_trim):
    records = plan_records(plan, Machine(300, 300, 0.75, jumps_per_trim=jumps_per_trim))
    bare = [replace(block, runs=()) for block in plan.blocks]
    back = plan_from_records(records, bare)
    assert len(back.blocks) == len(plan.blocks)
    for block, again in zip(plan.blocks, back.blocks, strict=True):
        assert replace(again, runs=()) == replace(block, runs=())
        assert [r.approach for r in again.runs] == [r.approach for r in block.runs]
        assert [r.needles.tolist() for r in again.runs] == [r.needles.tolist() for r in block.runs]


@settings(deadline=None, max_examples=100)
@given(plans)
def test_every_record_is_one_the_machine_takes(plan):
    records = plan_records(plan, MACHINE)
    command, xy = records.command.tolist(), records.xy
    assert np.abs(np.diff(xy, axis=0, prepend=0)).max() <= 121
    assert command.count(Command.STOP) == len(plan.blocks) - 1
    assert command.count(Command.END) == 1
    assert command[-1] == Command.END
    assert command[0] != Command.STOP
    assert command[-2] == Command.STITCH
    still = np.isin(records.command, [Command.STOP, Command.END])
    assert np.all(np.diff(xy, axis=0, prepend=0)[still] == 0)


@settings(deadline=None, max_examples=60)
@given(plans)
def test_between_runs_the_thread_is_trimmed_by_equal_jumps(plan):
    records = plan_records(plan, MACHINE)
    moving = records.command != Command.STOP
    command, xy = records.command[moving], records.xy[moving]
    sewing = np.flatnonzero(command == Command.STITCH)
    for last, following in pairwise(sewing):
        jumps = following - last - 1
        if jumps:
            assert jumps >= MACHINE.jumps_per_trim
            parts = np.diff(xy[last:following], axis=0)
            assert np.ptp(parts, axis=0).max() <= 1
    assert np.sum(np.diff(sewing) > 1) == sum(len(block.runs) for block in plan.blocks) - 1


def test_a_short_travel_is_a_trim_too():
    block = Block(BlockKind.COVER, "", (run((5, 0)), run((9, 0), approach=(7, 0))))
    assert commands_of(StitchPlan((block,))) == ["stitch", "jump", "jump", "jump", "stitch", "end"]


def test_a_long_travel_takes_as_many_jumps_as_it_needs():
    block = Block(BlockKind.COVER, "", (run((1000, 0), approach=(-1000, 242)),))
    with pytest.raises(PatternError, match=r"moves 200\.0 mm along one axis"):
        plan_records(StitchPlan((block,)), MACHINE)
    block = Block(BlockKind.COVER, "", (run((-1000, 250), approach=(-1000, 242)),))
    assert commands_of(StitchPlan((block,))).count("jump") == 9


def test_the_machine_stands_at_the_start_of_the_wire_when_it_stops():
    order = commands_of(plan_of(BlockKind.MARKS, BlockKind.WIRE))
    assert order[5:] == ["jump", "jump", "jump", "stop", "stitch", "stitch", "end"]


def test_the_machine_stops_before_it_leaves_the_wire():
    order = commands_of(plan_of(BlockKind.WIRE, BlockKind.COVER))
    assert order[5:] == ["stop", "jump", "jump", "jump", "stitch", "stitch", "end"]


def test_from_wire_to_wire_the_operator_lets_go_first():
    order = commands_of(plan_of(BlockKind.WIRE, BlockKind.WIRE))
    assert order[5:] == ["stop", "jump", "jump", "jump", "stitch", "stitch", "end"]


def test_runs_stay_apart_on_a_machine_that_needs_no_jumps_to_trim():
    block = Block(BlockKind.COVER, "", (run((5, 0)), run((9, 0), approach=(5, 0))))
    machine = Machine(300, 300, 0.75, jumps_per_trim=0)
    assert commands_of(StitchPlan((block,)), machine) == ["stitch", "jump", "stitch", "end"]


def test_between_thread_blocks_the_machine_stops_where_it_is():
    order = commands_of(plan_of(BlockKind.MARKS, BlockKind.COVER))
    assert order[5:] == ["stop", "jump", "jump", "jump", "stitch", "stitch", "end"]


@pytest.mark.parametrize(
    "plan",
    [
        StitchPlan((Block(BlockKind.COVER, "", ()),)),
        StitchPlan((Block(BlockKind.COVER, "", (Run((0, 0), np.zeros((0, 2), dtype=int)),)),)),
        StitchPlan(()),
    ],
)
def test_nothing_to_sew_is_refused(plan):
    with pytest.raises(PatternError, match=r"nothing to sew|without stitches"):
        plan_records(plan, MACHINE)


@pytest.mark.parametrize("count", [1, 3])
def test_another_number_of_blocks_is_refused(count):
    records = plan_records(plan_of(BlockKind.MARKS, BlockKind.COVER), MACHINE)
    with pytest.raises(PatternError, match="in 2 of 2 blocks"):
        plan_from_records(records, [Block(BlockKind.COVER, "", ())] * count)


def test_a_stop_that_ends_no_block_is_refused():
    records = plan_records(plan_of(BlockKind.MARKS, BlockKind.COVER), MACHINE)
    command = records.command.copy()
    command[command == Command.JUMP] = Command.STOP
    with pytest.raises(PatternError, match="in 2 of 8"):
        plan_from_records(type(records)(command, records.xy), [Block(BlockKind.COVER, "", ())] * 8)
