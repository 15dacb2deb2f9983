"""One wire through every loop, laid in stages that meet each contact once each."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

import numpy as np

from patterns.layout import Layout
from patterns.path import WirePath

CLOSING_TOLERANCE_MM = 1e-6

Diameters = float | tuple[float, ...]
"""One wire diameter in mm for all circuits, or one a circuit."""


class CrossingKind(StrEnum):
    """Why two passes of the wire come together."""

    CONTACT = "contact"
    TERMINALS = "terminals"


@dataclass(frozen=True, slots=True)
class Crossing:
    """A point that the wire passes twice, in different stages.

    Attributes
    ----------
    x_mm, y_mm : float
        The common point, where both passes have the same tangent line.
    first_mm, second_mm : float
        Where it lies along the whole wire, tails included, at the first and at the second pass.
    """

    kind: CrossingKind
    x_mm: float
    y_mm: float
    first_mm: float
    second_mm: float


@dataclass(frozen=True)
class Circuit:
    """One wire from terminal to terminal, laid in stages with covers in between.

    Attributes
    ----------
    layout : Layout
        The loops it runs through.
    switches : tuple of int
        The contacts (indices into ``layout.contacts``) in which the wire changes from loop to loop:
        a spanning tree of the touching graph.
    stages : tuple of WirePath
        Each starts where the one before ends; the first starts, and the last ends, with a straight
        tail. No stage passes a contact twice.
    crossings : tuple of Crossing
        Every point in which stages come together: all contacts, and the terminals.
    tail_pieces : int
        How many pieces make up each tail.
    links : tuple of WirePath
        Where the wire lies beside the loops between its tails: from one row of loops to the next.
    """

    layout: Layout
    switches: tuple[int, ...]
    stages: tuple[WirePath, ...]
    crossings: tuple[Crossing, ...]
    tail_pieces: int = 1
    links: tuple[WirePath, ...] = ()

    @property
    def parts(self) -> tuple[Circuit, ...]:
        """The circuits that this one is made of, in laying order: itself alone."""
        return (self,)

    @property
    def part_names(self) -> tuple[str, ...]:
        """What the operator calls each part."""
        return ("all",)

    @property
    def part_loops(self) -> tuple[tuple[int, ...], ...]:
        """The loops of each part, as indices into ``layout.loops``."""
        return (tuple(range(len(self.layout.loops))),)

    @property
    def tails(self) -> tuple[WirePath, WirePath]:
        """The tails, at which the wire comes and goes."""
        first, last = self.stages[0].pieces, self.stages[-1].pieces
        return WirePath(first[: self.tail_pieces]), WirePath(last[-self.tail_pieces :])

    @cached_property
    def part_of_stage(self) -> tuple[int, ...]:
        """Which of the parts lays each stage."""
        return tuple(k for k, part in enumerate(self.parts) for _ in part.stages)

    def begins_wire(self, stage: int) -> bool:
        """Whether a new wire begins with a stage."""
        return stage == 0 or self.part_of_stage[stage - 1] != self.part_of_stage[stage]

    def ends_wire(self, stage: int) -> bool:
        """Whether a wire ends with a stage."""
        return stage == len(self.stages) - 1 or self.begins_wire(stage + 1)

    def stage_name(self, stage: int) -> str:
        """Name a stage to the operator, as counted from 1."""
        return f"stage {stage + 1}"

    def own_name(self, stage: int) -> str:
        """Name a stage as counted among those of its own wire."""
        return self.stage_name(stage).partition(" of ")[0]

    def of_stages(self, diameter_mm: Diameters) -> tuple[float, ...]:
        """Wire diameter of each stage."""
        if isinstance(diameter_mm, tuple):
            return tuple(diameter_mm[part] for part in self.part_of_stage)
        return (diameter_mm,) * len(self.stages)

    def span_mm(self, part: int) -> tuple[float, float]:
        """Where along all wire that of a part begins and ends."""
        own = [k for k, of in enumerate(self.part_of_stage) if of == part]
        return self.starts_mm[own[0]], self.starts_mm[own[-1]] + self.stages[own[-1]].length_mm

    @cached_property
    def wire(self) -> WirePath:
        """The whole wire, from the end of one tail to the end of the other."""
        return self.laid_before(len(self.stages))

    @cached_property
    def starts_mm(self) -> tuple[float, ...]:
        """Where along the whole wire each stage starts."""
        lengths = [stage.length_mm for stage in self.stages]
        return tuple(sum(lengths[:k]) for k in range(len(lengths)))

    def laid_before(self, stage: int) -> WirePath:
        """Give the wire of all stages before one."""
        return WirePath(tuple(piece for path in self.stages[:stage] for piece in path.pieces))

    def crossings_of(self, stage: int, part: int | None = None) -> tuple[Crossing, ...]:
        """Give the crossings that the wire passes for the second time in a stage.

        Parameters
        ----------
        part
            Only those at which the wire that is passed for the first time is that of a part.
        """
        ends = (*self.starts_mm, np.inf)
        found = (c for c in self.crossings if ends[stage] < c.second_mm <= ends[stage + 1])
        if part is None:
            return tuple(found)
        begin, end = self.span_mm(part)
        return tuple(c for c in found if begin < c.first_mm < end)

    @property
    def wire_length_mm(self) -> float:
        """Length of the wire with both tails."""
        return sum(stage.length_mm for stage in self.stages)

    @property
    def smallest_radius_mm(self) -> float:
        """Smallest bend radius of the wire, on a loop that of the ellipse itself."""
        laid = min(stage.smallest_radius_mm for stage in self.stages)
        return min([laid, *(loop.smallest_radius_mm for loop in self.layout.loops)])

    @property
    def closed(self) -> bool:
        """Whether the wire, its tails taken off, is one curve that ends where it starts.

        One with links ends on another row of loops, and need only be one curve.
        """
        gaps, _ = self.wire.joints()
        if self.links:
            return float(gaps.max(initial=0.0)) < CLOSING_TOLERANCE_MM
        comes, goes = self.tails
        (leaves,), _ = comes.pieces[-1].at(np.array([comes.pieces[-1].length_mm]))
        (returns,), _ = goes.pieces[0].at(np.array([0.0]))
        gap = max(float(gaps.max(initial=0.0)), float(np.hypot(*(leaves - returns))))
        return gap < CLOSING_TOLERANCE_MM
