from dataclasses import replace

import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from patterns.circuit import Circuit
from patterns.grid import square_grid
from patterns.groups import Group
from patterns.kirchhoff import effective_resistance_ohm
from patterns.lattice import Lattice, lattice_loops
from patterns.layout import tangent_layout
from patterns.net import Kind, SewnNet, sewn_net
from patterns.one_wire import one_wire
from patterns.plan import BlockKind, Run, StitchPlan
from patterns.rules.net import check_net
from patterns.stitch_plan import stitch_plan
from patterns.tangent_switch import grid_circuit
from patterns.terminals import Side
from patterns.wire_index import WireIndex
from patterns.wiring import several_wires

OHM_PER_MM = 0.02


def net_of(bench, plan: StitchPlan, *diameters: float) -> SewnNet:
    kinds = tuple(Kind(one, OHM_PER_MM) for one in diameters)
    return sewn_net(plan, kinds, bench.stitching.largest_cover_gap_mm)


def planned(bench, circuit: Circuit, wire_mm: float) -> StitchPlan:
    return stitch_plan(circuit, bench.stitching, bench.machine, wire_mm, ())


def without_run(plan: StitchPlan, block: int, run: int) -> StitchPlan:
    runs = plan.blocks[block].runs
    rest = replace(plan.blocks[block], runs=runs[:run] + runs[run + 1 :])
    return StitchPlan((*plan.blocks[:block], rest, *plan.blocks[block + 1 :]))


@pytest.mark.parametrize(
    ("rows", "columns", "loop_mm", "wire_mm"),
    [(1, 1, 25, 0.3), (2, 3, 25, 0.3), (4, 4, 50, 0.5), (6, 6, 25, 0.2), (3, 3, 10, 0.1)],
)
def test_a_sound_plan_is_one_wire_with_its_resistance(bench, rows, columns, loop_mm, wire_mm):
    circuit = grid_circuit(rows, columns, loop_mm, 40.0)
    net = net_of(bench, planned(bench, circuit, wire_mm), wire_mm)
    assert len(net.wires) == 1
    assert net.shorts == ()
    assert net.resistance_ohm(0) == pytest.approx(OHM_PER_MM * circuit.wire_length_mm, rel=0.01)
    places = np.array([(one.x_mm, one.y_mm) for one in net.meetings])
    assert len(places) == len(circuit.crossings)
    for crossing in circuit.crossings:
        assert np.hypot(*(places - (crossing.x_mm, crossing.y_mm)).T).min() < 2.0
    assert check_net(circuit, net) == ()


@given(
    lattice=st.sampled_from([Lattice.BRICK, Lattice.HEXAGONAL]),
    rows=st.integers(1, 4),
    columns=st.integers(2, 5),
    wire_mm=st.sampled_from([0.2, 0.3, 0.4]),
)
@settings(deadline=None, max_examples=12)
def test_lattices_in_several_stages_are_one_wire(bench, lattice, rows, columns, wire_mm):
    circuit = one_wire(
        tangent_layout(lattice_loops(lattice, rows, columns, 30.0)), Side.CORNER, 40.0
    )
    net = net_of(bench, planned(bench, circuit, wire_mm), wire_mm)
    assert len(net.meetings) == len(circuit.crossings)
    assert check_net(circuit, net) == ()
    assert net.resistance_ohm(0) == pytest.approx(OHM_PER_MM * circuit.wire_length_mm, rel=0.01)


def test_rebuilt_wire_lies_where_it_was_laid(bench) -> None:
    circuit = grid_circuit(3, 3, 25.0, 40.0)
    net = net_of(bench, planned(bench, circuit, 0.3), 0.3)
    for stage, strand in zip(circuit.stages, net.wires[0], strict=True):
        away = WireIndex(stage).nearest(strand.points_mm, 3.0).distance_mm
        assert away.max() < 0.25


@pytest.mark.parametrize("dropped", range(8))
def test_a_missing_cover_is_a_short_with_its_place_and_drop(bench, dropped: int) -> None:
    circuit, plan = bench.good()
    (cover,) = (k for k, block in enumerate(plan.blocks) if block.kind is BlockKind.COVER)
    middle = plan.blocks[cover].runs[dropped].needles.mean(axis=0) / 10
    net = net_of(bench, without_run(plan, cover, dropped), bench.wire_mm)
    (short,) = net.shorts
    assert np.hypot(short.x_mm - middle[0], short.y_mm - middle[1]) < 3.0
    crossing = min(
        circuit.crossings, key=lambda c: np.hypot(c.x_mm - middle[0], c.y_mm - middle[1])
    )
    bypassed = crossing.second_mm - crossing.first_mm
    left = OHM_PER_MM * (circuit.wire_length_mm - bypassed)
    # the passes touch over some millimetres, and where in them the current changes is open
    assert net.resistance_ohm(0) == pytest.approx(left, abs=OHM_PER_MM * 8.0)
    messages = [str(fault) for fault in check_net(circuit, net)]
    assert "two passes of the wire of the circuit touch" in messages[0]
    if bypassed > 0.05 * circuit.wire_length_mm:
        assert "the stitches make" in messages[1]


def test_circuits_that_touch_bare_are_bridged(bench) -> None:
    groups = (Group("low", (0, 1), Side.LEFT), Group("high", (2, 3), Side.LEFT))
    wiring = several_wires(square_grid(2, 2, 25.0), groups, 40.0, (7.5, 5.0))
    plan = stitch_plan(wiring, bench.stitching, bench.machine, (0.3, 0.2), ())
    net = net_of(bench, plan, 0.3, 0.2)
    assert (len(net.wires), net.bridged(), check_net(wiring, net)) == (2, (), ())
    for k, circuit in enumerate(wiring.circuits):
        planned_ohm = OHM_PER_MM * circuit.wire_length_mm
        assert net.resistance_ohm(k) == pytest.approx(planned_ohm, rel=0.01)
    between = next(
        k
        for k, block in enumerate(plan.blocks)
        if block.kind is BlockKind.COVER and wiring.begins_wire(block.stage)
    )
    bare = net_of(bench, without_run(plan, between, 0), 0.3, 0.2)
    assert bare.bridged() == ((0, 1),)
    assert any("low and circuit high touch" in str(f) for f in check_net(wiring, bare))


def test_a_cover_sewn_too_late_insulates_nothing(bench) -> None:
    _, plan = bench.good()
    marks, first, cover, second = plan.blocks
    late = net_of(bench, StitchPlan((marks, first, second, cover)), bench.wire_mm)
    assert len(late.shorts) == 8


def test_a_stage_left_out_or_moved_is_another_net(bench) -> None:
    circuit, plan = bench.good()
    marks, first, cover, second = plan.blocks
    half = net_of(bench, StitchPlan((marks, first, cover)), bench.wire_mm)
    assert any("the stitches make" in str(fault) for fault in check_net(circuit, half))
    run = second.runs[0]
    moved = replace(second, runs=(Run(run.approach, run.needles + 500),))
    two = net_of(bench, StitchPlan((marks, first, cover, moved)), bench.wire_mm)
    (fault,) = check_net(circuit, two)
    assert "2 separate wires instead of 1" in fault.message


def test_a_plan_without_wire_has_no_net(bench) -> None:
    circuit, plan = bench.good()
    net = net_of(bench, StitchPlan(plan.blocks[:1]), bench.wire_mm)
    assert net.wires == ()
    (fault,) = check_net(circuit, net)
    assert "0 separate wires" in fault.message


def test_resistance_of_known_nets() -> None:
    bridge: nx.MultiGraph[int] = nx.MultiGraph()
    for a, b, ohm in [(0, 1, 1.0), (1, 3, 2.0), (0, 2, 2.0), (2, 3, 4.0), (1, 2, 7.0)]:
        bridge.add_edge(a, b, ohm=ohm)
    assert effective_resistance_ohm(bridge, 0, 3) == pytest.approx(2.0)  # balanced: 3 and 6 ohm
    bridge.add_edge(0, 3, ohm=2.0)
    assert effective_resistance_ohm(bridge, 0, 3) == pytest.approx(1.0)
    bridge.add_node(9)
    assert effective_resistance_ohm(bridge, 0, 9) == float("inf")
    assert effective_resistance_ohm(bridge, 2, 2) == 0.0


@given(st.lists(st.floats(0.1, 100.0), min_size=1, max_size=8))
def test_resistances_in_series_and_in_parallel(ohms: list[float]) -> None:
    series: nx.MultiGraph[int] = nx.MultiGraph()
    parallel: nx.MultiGraph[int] = nx.MultiGraph()
    for k, ohm in enumerate(ohms):
        series.add_edge(k, k + 1, ohm=ohm)
        parallel.add_edge(0, 1, ohm=ohm)
    assert effective_resistance_ohm(series, 0, len(ohms)) == pytest.approx(sum(ohms))
    together = 1 / sum(1 / ohm for ohm in ohms)
    assert effective_resistance_ohm(parallel, 0, 1) == pytest.approx(together)
