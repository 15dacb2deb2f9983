"""What every rule looks at: the circuit, the plan as it will be sewn, and the limits."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from patterns.circuit import Circuit
from patterns.machine import Machine
from patterns.path import Vectors
from patterns.plan import UNITS_PER_MM, Block, BlockKind, StitchPlan
from patterns.stitching import ROUNDING_MM, Stitching
from patterns.violation import Violation
from patterns.wire_index import WireIndex


@dataclass(frozen=True)
class Subject:
    """A plan, the circuit it is meant to sew, and the settings and machine it is meant for."""

    circuit: Circuit
    plan: StitchPlan
    machine: Machine
    stitching: Stitching
    wire_diameter_mm: float

    @cached_property
    def halves(self) -> dict[BlockKind, WireIndex]:
        """The wire that each of the two wire blocks lays."""
        return {
            BlockKind.WIRE_FIRST: WireIndex(self.circuit.first_half),
            BlockKind.WIRE_SECOND: WireIndex(self.circuit.second_half),
        }

    @cached_property
    def needles_mm(self) -> tuple[Vectors, ...]:
        """Needle points (n, 2) of each block, all runs after one another."""
        return tuple(_needles_mm(block) for block in self.plan.blocks)

    @property
    def clearance_mm(self) -> float:
        """Smallest distance between needle point and wire centreline at which they do not meet."""
        return (self.wire_diameter_mm + self.machine.needle_diameter_mm) / 2

    @property
    def reach_mm(self) -> float:
        """Farthest from the wire that a stitch still holds it: four half-widths of the couching."""
        return 4 * (self.clearance_mm + self.stitching.needle_margin_mm) + ROUNDING_MM

    @property
    def separation_mm(self) -> float:
        """Distance of two centrelines below which a cover must lie between the wires."""
        return self.wire_diameter_mm + self.stitching.cover_reach_mm

    def fault(
        self,
        rule: str,
        message: str,
        block: int,
        stitch: int,
        *,
        actual: float | None = None,
        allowed: float | None = None,
    ) -> Violation:
        """Report a fault at a needle point."""
        x, y = self.needles_mm[block][stitch]
        return Violation(rule, message, float(x), float(y), block, stitch, actual, allowed)


def _needles_mm(block: Block) -> Vectors:
    runs = [np.empty((0, 2)), *(run.needles / UNITS_PER_MM for run in block.runs)]
    return np.concatenate(runs)
