from dataclasses import replace

import numpy as np
import pytest

from patterns.path import Line, WirePath
from patterns.plan import BlockKind
from patterns.rules.near import near_stretches
from patterns.wire_index import WireIndex


@pytest.mark.parametrize("dropped", range(8))
def test_every_cover_is_needed(bench, dropped: int) -> None:
    circuit, plan = bench.good()
    assert len(circuit.crossings) == 8
    runs = bench.block_of(plan, BlockKind.COVER).runs
    bare = bench.with_runs(plan, BlockKind.COVER, *runs[:dropped], *runs[dropped + 1 :])
    faults = bench.check(replace(circuit, crossings=()), bare)
    assert {fault.rule for fault in faults} == {"insulation"}
    middle = runs[dropped].needles.mean(axis=0) / 10
    assert any(np.hypot(f.x_mm - middle[0], f.y_mm - middle[1]) < 1.5 for f in faults)


def test_a_hole_in_a_cover_is_a_short(bench) -> None:
    circuit, plan = bench.good()
    first, *others = bench.block_of(plan, BlockKind.COVER).runs
    middle = len(first.needles) // 2
    thin = replace(first, needles=np.delete(first.needles, [middle, middle + 1], axis=0))
    assert bench.broken(circuit, bench.with_runs(plan, BlockKind.COVER, thin, *others)) == {
        "insulation"
    }


def test_a_wire_that_comes_near_itself_is_a_short(bench) -> None:
    circuit, plan = bench.good()
    there = Line(0.0, 500.0, 100.0, 500.0)
    back = Line(0.0, 500.5, 100.0, 500.5)
    doubled = WirePath((*circuit.second_half.pieces, there, back))
    faults = bench.check(replace(circuit, second_half=doubled), plan)
    assert any("near itself" in fault.message for fault in faults)


def test_near_stretches_of_two_tangent_circles(bench) -> None:
    circuit, _ = bench.planned(1, 4, 25.0, 0.2)
    radius, separation = 12.5, 0.7
    first, second = WireIndex(circuit.first_half), WireIndex(circuit.second_half)
    found = near_stretches(first, second, first.length_mm, separation)
    half = radius * np.arccos((5 - ((radius + separation) / radius) ** 2) / 4)
    contacts = [c.first_mm for c in circuit.crossings if c.kind == "contact"]
    for s in contacts:
        (stretch,) = found[(found[:, 0] < s) & (found[:, 1] > s)]
        assert stretch == pytest.approx([s - half, s + half], abs=0.01)
    assert len(found) == len(contacts) + 1
