"""Ties where loops touch: over both wires, from inside one loop to inside the other."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import shapely

from patterns.errors import PatternError
from patterns.lattice import Lattice, lattice_loops
from patterns.layout import tangent_layout
from patterns.loop import Loop
from patterns.machine import Machine
from patterns.net import Kind, sewn_net
from patterns.one_wire import one_wire
from patterns.plan import UNITS_PER_MM, BlockKind, StitchPlan
from patterns.rules import check_plan
from patterns.stitch_plan import stitch_plan
from patterns.stitching import Stitching
from patterns.tangent_switch import grid_circuit
from patterns.terminals import Side

MACHINE, WIRE = Machine(500, 500, 0.75), 0.3
TIED = Stitching(ties="contacts")
GRID = grid_circuit(2, 3, 25.0, 40.0)
HALVES = WIRE / 2 + MACHINE.needle_diameter_mm / 2


def circuit_of(loops):
    return one_wire(tangent_layout(tuple(loops)), Side.CORNER, 40.0)


CIRCUITS = {
    "grid": GRID,
    "hexagonal": circuit_of(lattice_loops(Lattice.HEXAGONAL, 3, 3, 25.0)),
    "ellipses": circuit_of(lattice_loops(Lattice.BRICK, 2, 2, 40.0, axis_ratio=1.5)),
    "unequal": circuit_of((Loop(0, 0, 20), Loop(27, 36, 70))),
}


def tied(circuit, stitching=TIED):
    plan = stitch_plan(circuit, stitching, MACHINE, WIRE, ())
    return plan, plan.blocks[-1]


@pytest.mark.parametrize("name", CIRCUITS)
def test_every_contact_is_tied_over_both_wires_and_no_needle_meets_wire(name):
    circuit = CIRCUITS[name]
    plan, block = tied(circuit)
    assert block.kind is BlockKind.TIES
    assert check_plan(circuit, plan, MACHINE, TIED, WIRE) == ()
    contacts = {(c.x_mm, c.y_mm): c for c in circuit.layout.contacts}
    assert len(block.runs) == len(contacts)
    assert f"{len(contacts)} contact" in block.instruction
    wire = shapely.union_all([stage.line_string(5e-4) for stage in circuit.stages])
    places = np.array(list(contacts))
    for run in block.runs:
        needles = run.needles / UNITS_PER_MM
        assert shapely.distance(shapely.points(needles), wire).min() >= HALVES
        off = np.hypot(*(places - needles.mean(axis=0)).T)
        contact = contacts.pop(tuple(places[int(np.argmin(off))].tolist()))
        assert off.min() < 0.15
        sides = [
            {k for k in (contact.first, contact.second) if circuit.layout.loops[k].holds(*at)}
            for at in needles.tolist()
        ]
        assert all(len(side) == 1 for side in sides)
        bars = sum(a != b for a, b in pairwise(sides))
        assert bars == 3
        long_mm = float(np.hypot(*np.ptp(needles, axis=0)))
        assert long_mm == pytest.approx(2 * (HALVES + 0.1 + TIED.lock_length_mm), abs=0.15)
    assert not contacts


def test_ties_are_no_covers_and_come_after_stripes():
    both = replace(TIED, stripes="rows")
    plan, block = tied(GRID, both)
    assert plan.blocks[-2].kind is BlockKind.STRIPES
    assert check_plan(GRID, plan, MACHINE, both, WIRE) == ()
    swapped = StitchPlan((*plan.blocks[:-2], block, plan.blocks[-2]))
    (fault,) = check_plan(GRID, swapped, MACHINE, both, WIRE)
    assert (fault.rule, "after the block of ties" in fault.message) == ("blocks", True)
    kinds, gap = (Kind(WIRE, 0.01),), both.largest_cover_gap_mm
    bare = StitchPlan(tuple(b for b in plan.blocks if b.kind is not BlockKind.COVER))
    assert not sewn_net(plan, kinds, gap).shorts
    assert len(sewn_net(bare, kinds, gap).shorts) >= len(GRID.layout.contacts)


def test_a_missing_block_of_ties_is_found():
    plan, _ = tied(GRID)
    (fault,) = check_plan(GRID, StitchPlan(plan.blocks[:-1]), MACHINE, TIED, WIRE)
    assert (fault.rule, "ties is missing" in fault.message) == ("blocks", True)


def test_one_loop_alone_needs_none():
    circuit = grid_circuit(1, 1, 25.0, 40.0)
    plan, block = tied(circuit)
    assert block.kind is BlockKind.WIRE
    assert check_plan(circuit, plan, MACHINE, TIED, WIRE) == ()


def with_runs(plan, *runs):
    return StitchPlan((*plan.blocks[:-1], replace(plan.blocks[-1], runs=runs)))


def test_a_contact_without_its_tie_is_found():
    plan, block = tied(GRID)
    (fault,) = check_plan(GRID, with_runs(plan, *block.runs[1:]), MACHINE, TIED, WIRE)
    places = {(c.x_mm, c.y_mm) for c in GRID.layout.contacts}
    assert (fault.rule, fault.actual, fault.allowed) == ("contact-ties", 0, 1)
    assert (fault.x_mm, fault.y_mm) in places
    near = block.runs[0].needles.mean(axis=0) / UNITS_PER_MM
    assert np.hypot(fault.x_mm - near[0], fault.y_mm - near[1]) < 0.15
    empty = replace(block.runs[0], needles=block.runs[0].needles[:0])
    faults = check_plan(GRID, with_runs(plan, empty, *block.runs[1:]), MACHINE, TIED, WIRE)
    assert fault in faults


@pytest.mark.parametrize("turned", [False, True])
def test_a_tie_beside_its_contact_is_found_at_its_stitch(turned):
    plan, (first, second, *others) = (tied(GRID)[0], tied(GRID)[1].runs)
    along = second.needles[0] - second.needles[-1]
    aside = np.array([-along[1], along[0]]) / np.hypot(*along)
    if turned:  # inside one loop, over no wire
        moved = second.needles + np.rint(80 * along / np.hypot(*along)).astype(int)
    else:
        moved = second.needles + np.rint(3 * aside).astype(int)
    planted = with_runs(plan, first, replace(second, needles=moved), *others)
    faults = check_plan(GRID, planted, MACHINE, TIED, WIRE)
    assert [fault.rule for fault in faults] == ["contact-ties", "contact-ties"]
    assert (faults[0].block, faults[0].stitch) == (len(plan.blocks) - 1, len(first.needles))
    assert faults[0].actual == (None if turned else pytest.approx(0.3, abs=0.05))
    assert (faults[1].actual, faults[1].allowed) == (0, 1)


def test_a_tie_whose_needle_is_on_the_wire_is_struck():
    plan, block = tied(GRID)
    first, *others = block.runs
    needles = first.needles.copy()
    needles[3] = np.rint(needles.mean(axis=0)).astype(int)
    planted = with_runs(plan, replace(first, needles=needles), *others)
    faults = check_plan(GRID, planted, MACHINE, TIED, WIRE)
    assert {fault.rule for fault in faults} == {"needle-on-wire"}
    assert (faults[0].block, faults[0].stitch) == (len(plan.blocks) - 1, 3)


def test_ties_without_room_are_refused_with_the_reason():
    circuit = grid_circuit(1, 2, 3.9, 40.0)
    stitching = replace(TIED, lock_length_mm=3.0, smallest_bend_diameters=5.0)
    with pytest.raises(PatternError, match=r'tie at \(-?0\.00, 0\.00\).*stitching\.ties = "none"'):
        stitch_plan(circuit, stitching, MACHINE, WIRE, ())
