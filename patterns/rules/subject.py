"""What every rule looks at: the circuit, the plan as it will be sewn, and the limits."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from patterns.circuit import Circuit, Diameters
from patterns.machine import Machine
from patterns.path import Vectors
from patterns.plan import UNITS_PER_MM, Block, StitchPlan
from patterns.stitching import ROUNDING_MM, Stitching
from patterns.violation import Violation
from patterns.wire_index import Indices, Nearest, Numbers, WireIndex

PARTING_MM = 100.0
"""Places along all wire are counted so much farther where a new wire begins."""


@dataclass(frozen=True)
class Subject:
    """A plan, the circuit it is meant to sew, and the settings and machine it is meant for."""

    circuit: Circuit
    plan: StitchPlan
    machine: Machine
    stitching: Stitching
    wire_diameter_mm: Diameters

    @cached_property
    def diameters_mm(self) -> tuple[float, ...]:
        """Wire diameter of each stage."""
        return self.circuit.of_stages(self.wire_diameter_mm)

    @cached_property
    def starts_mm(self) -> tuple[float, ...]:
        """Where along all wire each stage starts; from one wire to the next there is a gap.

        So places on two wires are never taken for one stretch of the same wire.
        """
        gaps = (PARTING_MM * part for part in self.circuit.part_of_stage)
        return tuple(map(sum, zip(self.circuit.starts_mm, gaps, strict=True)))

    def stage_at(self, station_mm: Numbers) -> Indices:
        """Stage (n,) of places along all wire, counted as in ``starts_mm``."""
        return np.maximum(np.searchsorted(self.starts_mm, station_mm, side="right") - 1, 0)

    @cached_property
    def wire(self) -> WireIndex:
        """All wire, places along it as in ``starts_mm``."""
        return WireIndex(
            self.circuit.wire,
            PARTING_MM * np.array(self.circuit.part_of_stage)[self.stage_of_piece],
        )

    @cached_property
    def stages(self) -> tuple[WireIndex, ...]:
        """The wire that each stage lays."""
        return tuple(WireIndex(stage) for stage in self.circuit.stages)

    @cached_property
    def stage_of_piece(self) -> Indices:
        """Stage of each piece of the whole wire."""
        counts = [len(stage.pieces) for stage in self.circuit.stages]
        return np.repeat(np.arange(len(counts)), counts)

    @cached_property
    def laying(self) -> dict[int, int]:
        """The block in which each stage is first laid, for stages that the circuit has."""
        found: dict[int, int] = {}
        for i, block in enumerate(self.plan.blocks):
            if block.kind.is_wire and 0 <= block.stage < len(self.circuit.stages):
                found.setdefault(block.stage, i)
        return found

    def laid_before(self, block: int) -> NDArray[np.bool_]:
        """Whether each piece of the whole wire has been laid before a block."""
        laid = [stage for stage, at in self.laying.items() if at < block]
        return np.isin(self.stage_of_piece, laid)

    @cached_property
    def needles_mm(self) -> tuple[Vectors, ...]:
        """Needle points (n, 2) of each block, all runs after one another."""
        return tuple(_needles_mm(block) for block in self.plan.blocks)

    @cached_property
    def couching_places(self) -> dict[int, Nearest]:
        """For each block that ties down a known stage, its needle points' places on that stage."""
        return {
            i: _nearest_in_order(self.stages[block.stage], self.needles_mm[i], self.reach_mm)
            for i, block in enumerate(self.plan.blocks)
            if block.kind.is_wire and 0 <= block.stage < len(self.stages)
            if len(self.needles_mm[i])
        }

    def clearance_mm(self, wire_diameter_mm: float) -> float:
        """Smallest distance between needle point and wire centreline at which they do not meet."""
        return (wire_diameter_mm + self.machine.needle_diameter_mm) / 2

    @property
    def reach_mm(self) -> float:
        """Farthest from the wire that a stitch still holds it: four half-widths of the couching."""
        thickest = self.clearance_mm(max(self.diameters_mm))
        half_width = thickest + self.stitching.needle_margin_mm
        return 4 * half_width + self.stitching.wider_by_mm + ROUNDING_MM

    def separation_mm(self, stage: int, other_diameter_mm: float) -> float:
        """Distance of a stage's centreline from another below which a cover must lie between."""
        mean = (self.diameters_mm[stage] + other_diameter_mm) / 2
        return mean + self.stitching.cover_reach_mm

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


def _nearest_in_order(wire: WireIndex, needles_mm: Vectors, reach_mm: float) -> Nearest:
    """Nearest places; of two, that which lies between those of the needle's neighbours.

    Beyond an earlier wire a needle may be nearer to another part of its own stage.
    """
    nearest = wire.nearest(needles_mm, reach_mm)
    other = wire.nearest(needles_mm, reach_mm, away_from=(nearest.station_mm, reach_mm))
    padded = np.pad(nearest.station_mm, 1, mode="reflect" if len(needles_mm) > 1 else "edge")
    expected = (padded[2:] + padded[:-2]) / 2
    swap = np.abs(other.station_mm - expected) < np.abs(nearest.station_mm - expected)
    return Nearest(
        np.where(swap, other.distance_mm, nearest.distance_mm),
        np.where(swap, other.station_mm, nearest.station_mm),
        np.where(swap, other.side_mm, nearest.side_mm),
    )
