from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from patterns.circuit import Circuit
from patterns.machine import Machine
from patterns.plan import Block, BlockKind, Run, StitchPlan
from patterns.registration import registration_marks
from patterns.rules import check_plan
from patterns.stitch_plan import stitch_plan
from patterns.stitching import Stitching
from patterns.tangent_switch import grid_circuit
from patterns.violation import Violation

Part = tuple[BlockKind, int]
"""Kind and stage of a block."""


class Bench:
    """A good plan, ways to spoil it, and the rules to find that out."""

    machine = Machine(hoop_width_mm=600, hoop_height_mm=600, needle_diameter_mm=0.75)
    stitching = Stitching()
    wire_mm = 0.3

    @cache  # noqa: B019
    def planned(
        self, rows: int, columns: int, loop_mm: float, wire_mm: float
    ) -> tuple[Circuit, StitchPlan]:
        circuit = grid_circuit(rows, columns, loop_mm, self.stitching.tail_length_mm)
        x, y = columns * loop_mm / 2 + 45, rows * loop_mm / 2 + 45
        marks = registration_marks((-x, -y, x, y), 8.0, 6.0)
        return circuit, stitch_plan(circuit, self.stitching, self.machine, wire_mm, marks)

    def good(self) -> tuple[Circuit, StitchPlan]:
        return self.planned(2, 3, 25.0, self.wire_mm)

    def check(self, circuit: Circuit, plan: StitchPlan, **changes: object) -> tuple[Violation, ...]:
        settings = {"machine": self.machine, "stitching": self.stitching, **changes}
        return check_plan(circuit, plan, wire_diameter_mm=self.wire_mm, **settings)

    def broken(self, circuit: Circuit, plan: StitchPlan, **changes: object) -> set[str]:
        return {violation.rule for violation in self.check(circuit, plan, **changes)}

    marks = (BlockKind.MARKS, 0)
    first = (BlockKind.WIRE, 0)
    cover = (BlockKind.COVER, 1)
    second = (BlockKind.WIRE, 1)
    parts = (marks, first, cover, second)

    def block_of(self, plan: StitchPlan, part: Part) -> Block:
        return next(block for block in plan.blocks if (block.kind, block.stage) == part)

    def with_runs(self, plan: StitchPlan, part: Part, *runs: Run) -> StitchPlan:
        blocks = (replace(b, runs=runs) if (b.kind, b.stage) == part else b for b in plan.blocks)
        return StitchPlan(tuple(blocks))

    def with_needles(self, plan: StitchPlan, part: Part, needles: np.ndarray) -> StitchPlan:
        return self.with_runs(
            plan, part, replace(self.block_of(plan, part).runs[0], needles=needles)
        )

    def with_mark(self, plan: StitchPlan, *needles: tuple[int, int]) -> StitchPlan:
        runs = self.block_of(plan, self.marks).runs
        x, y = needles[0]
        run = Run((x - 10, y), np.array(needles))
        return self.with_runs(plan, self.marks, *runs, run)


@pytest.fixture(scope="session")
def bench() -> Bench:
    return Bench()
