"""The net from the stitches, whatever head sews them and whatever lies under and over the wire."""

from dataclasses import replace

import numpy as np
import pytest

from patterns.circuit import Circuit
from patterns.grid import square_grid
from patterns.groups import Group
from patterns.machine import Machine
from patterns.net import Kind, SewnNet, sewn_net
from patterns.plan import BlockKind, StitchPlan, quantise
from patterns.rules import check_plan
from patterns.rules.net import check_net
from patterns.sewn_pieces import SewnPieces
from patterns.sewn_wire import sewn_strand
from patterns.stitch_plan import stitch_plan
from patterns.stitching import Stitching
from patterns.tangent_switch import grid_circuit
from patterns.terminals import Side
from patterns.wire_index import WireIndex
from patterns.wiring import several_wires

OHM_PER_MM = 0.02
DIAMETERS_MM = (0.3, 0.2)
ZIGZAG = Machine(600, 600, 0.75)
SWINGING = replace(ZIGZAG, couching="centreline", swing_mm=4.0)
UNDERLAY = Stitching(cover_underlay="edge", cover_overlap_mm=0.5)
WAYS = {
    "centreline": (SWINGING, Stitching(couching_interval_mm=4.0)),
    "centreline, wide": (replace(SWINGING, swing_mm=8.0), Stitching(couching_interval_mm=3.0)),
    "underlay": (ZIGZAG, UNDERLAY),
    "wide covers": (ZIGZAG, Stitching(cover_margin_mm=1.5)),
    "stripes": (ZIGZAG, Stitching(stripes="rows", stripe_passes=2)),
    "all": (SWINGING, replace(UNDERLAY, couching_interval_mm=4.0, stripes="columns")),
}


def net_of(plan: StitchPlan, stitching: Stitching) -> SewnNet:
    kinds = tuple(Kind(one, OHM_PER_MM) for one in DIAMETERS_MM)
    return sewn_net(plan, kinds, stitching.largest_cover_gap_mm)


def without_covers(plan: StitchPlan) -> StitchPlan:
    return StitchPlan(tuple(b for b in plan.blocks if b.kind is not BlockKind.COVER))


def two_wires() -> Circuit:
    groups = (Group("low", (0, 1), Side.LEFT), Group("high", (2, 3), Side.LEFT))
    return several_wires(square_grid(2, 2, 40.0), groups, 40.0, (7.5, 5.0))


@pytest.mark.parametrize("way", WAYS)
def test_one_wire_with_its_resistance_where_it_was_laid(way: str) -> None:
    machine, stitching = WAYS[way]
    circuit = grid_circuit(2, 3, 50.0, 40.0)
    plan = stitch_plan(circuit, stitching, machine, DIAMETERS_MM[0], ())
    assert check_plan(circuit, plan, machine, stitching, DIAMETERS_MM[0]) == ()
    net = net_of(plan, stitching)
    assert check_net(circuit, net) == ()
    assert len(net.meetings) == len(circuit.crossings)
    assert net.resistance_ohm(0) == pytest.approx(OHM_PER_MM * circuit.wire_length_mm, rel=0.01)
    for stage, strand in zip(circuit.stages, net.wires[0], strict=True):
        away = WireIndex(stage).nearest(strand.points_mm, 3.0).distance_mm
        assert away.max() < 0.15
    # neither stripes nor the run of an underlay are taken for a cover
    assert len(net_of(without_covers(plan), stitching).shorts) == len(circuit.crossings)


@pytest.mark.parametrize("way", WAYS)
def test_two_wires_of_different_thickness(way: str) -> None:
    machine, stitching = WAYS[way]
    wiring = two_wires()
    plan = stitch_plan(wiring, stitching, machine, DIAMETERS_MM, ())
    assert check_plan(wiring, plan, machine, stitching, DIAMETERS_MM) == ()
    net = net_of(plan, stitching)
    assert check_net(wiring, net) == ()
    assert net.bridged() == ()
    assert net_of(without_covers(plan), stitching).bridged() == ((0, 1),)


@pytest.mark.parametrize("mode", ["zigzag", "centreline"])
def test_a_stitch_square_over_the_wire_is_one_place_on_it(mode: str) -> None:
    machine = ZIGZAG if mode == "zigzag" else SWINGING
    stitching = Stitching(couching_interval_mm=3.0)
    circuit = grid_circuit(3, 3, 25.0, 40.0)
    net = net_of(stitch_plan(circuit, stitching, machine, 0.3, ()), stitching)
    for strand in net.wires[0]:
        step = np.diff(strand.points_mm, axis=0)
        turn = np.arctan2(
            step[:-1, 0] * step[1:, 1] - step[:-1, 1] * step[1:, 0],
            np.sum(step[:-1] * step[1:], axis=1),
        )
        assert np.abs(turn).max() < 0.3


def test_rounding_makes_no_zigzag_of_places_on_the_wire() -> None:
    places = np.stack([2.0 * np.arange(30), np.where(np.arange(30) % 2, 0.1, 0.0)], axis=1)
    strand = sewn_strand(0, places, SewnPieces([]))
    gaps = np.hypot(*(strand.points_mm[:, None] - places[2:-2]).transpose(2, 0, 1)).min(axis=0)
    assert gaps.max() < 1e-9


@pytest.mark.parametrize("stage", range(4))
def test_of_every_wire_both_tails_are_left_free(stage: int) -> None:
    wiring = two_wires()
    plan = stitch_plan(wiring, Stitching(), ZIGZAG, DIAMETERS_MM, ())
    k = next(i for i, b in enumerate(plan.blocks) if b.kind.is_wire and b.stage == stage)
    (run,) = plan.blocks[k].runs
    path = wiring.stages[stage]
    at = 4.0 if wiring.begins_wire(stage) else path.length_mm - 4.0
    point, along = path.at(at)
    place = quantise(point + 0.7 * along[:, ::-1] * (-1, 1))
    ends = (place, run.needles) if wiring.begins_wire(stage) else (run.needles, place)
    longer = replace(plan.blocks[k], runs=(replace(run, needles=np.concatenate(ends)),))
    spoilt = StitchPlan((*plan.blocks[:k], longer, *plan.blocks[k + 1 :]))
    faults = check_plan(wiring, spoilt, ZIGZAG, Stitching(), DIAMETERS_MM)
    free = [fault.actual for fault in faults if fault.rule == "feed-and-cut"]
    assert free == [pytest.approx(4.0, abs=0.1)]


def test_covers_of_either_wire_are_as_wide_as_asked() -> None:
    wiring = two_wires()
    plan = stitch_plan(wiring, Stitching(), ZIGZAG, DIAMETERS_MM, ())
    covers = [k for k, b in enumerate(plan.blocks) if b.kind is BlockKind.COVER]
    wide = Stitching(cover_margin_mm=0.3)
    faults = check_plan(wiring, plan, ZIGZAG, wide, DIAMETERS_MM)
    assert {fault.rule for fault in faults} == {"cover-width"}
    assert {fault.block for fault in faults} == set(covers)
    allowed = {round(fault.allowed, 6) for fault in faults}
    assert allowed == {round((one + 0.75) / 2 + 0.2, 6) for one in DIAMETERS_MM}
