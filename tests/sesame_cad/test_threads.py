"""Threads: the machine's colours, named for the operator, told apart in files."""

from dataclasses import replace
from itertools import pairwise

import pytest

from patterns.plan import Block, BlockKind, StitchPlan
from sesame_cad.colour_names import NAMED, colour_name
from sesame_cad.specification.machine import MachineSection
from sesame_cad.threads import threads_of

ORDER = [(BlockKind.MARKS, 0), (BlockKind.WIRE, 0), (BlockKind.COVER, 1), (BlockKind.WIRE, 1)]
ORDER += [(BlockKind.WIRE, 2), (BlockKind.WIRE, 3), (BlockKind.STRIPES, 0)]
PLAN = StitchPlan(tuple(Block(kind, "", (), stage) for kind, stage in ORDER))


def test_spools_are_the_machine_s():
    machine = MachineSection(threads=("#112233", "#FFFFFF", "#00FF00", "#FF0000"))
    threads = threads_of(PLAN, machine)
    wire = "#FFFFFF"
    expected = ["#112233", wire, "#00FF00", wire, wire, wire, "#FF0000"]
    assert [thread.spool_colour for thread in threads] == expected
    assert {thread.colour_name for thread in threads if "wire" in thread.material} == {"white"}
    assert [thread.head for thread in threads].count("wire") == 4


@pytest.mark.parametrize("colour", ["#000000", "#FFFFFF", "#7F7F7F", "#009E73"])
def test_files_show_another_colour_at_every_stop(colour):
    for thread, after in pairwise(threads_of(PLAN, MachineSection(threads=(colour,) * 4))):
        assert thread.colour != after.colour


def test_a_machine_without_heads_has_feet_and_one_needle():
    threads = threads_of(PLAN, MachineSection(hand_guided=True))
    assert {thread.needle for thread in threads} == {1}
    assert [thread.place for thread in threads][:2] == ["embroidery foot", "cording foot"]
    assert threads_of(PLAN, MachineSection())[2].place == "thread head, needle 2"


@pytest.mark.parametrize("name", NAMED)
def test_colours_have_their_names(name):
    assert colour_name(NAMED[name]) == name
    assert colour_name(NAMED[name].lower()) == name


def test_blocks_that_follow_one_another_in_one_colour_are_told_apart_in_any_order():
    backward = replace(PLAN, blocks=PLAN.blocks[::-1])
    threads = threads_of(backward, MachineSection(threads=("#BBBBBB",) * 4))
    assert all(one.colour != after.colour for one, after in pairwise(threads))
