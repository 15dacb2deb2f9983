"""One wire through every loop, laid in stages that meet each contact once each."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

import numpy as np

from patterns.layout import Layout
from patterns.path import WirePath

CLOSING_TOLERANCE_MM = 1e-6


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
    """

    layout: Layout
    switches: tuple[int, ...]
    stages: tuple[WirePath, ...]
    crossings: tuple[Crossing, ...]

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

    def crossings_of(self, stage: int) -> tuple[Crossing, ...]:
        """Give the crossings that the wire passes for the second time in a stage."""
        ends = (*self.starts_mm, np.inf)
        return tuple(c for c in self.crossings if ends[stage] < c.second_mm <= ends[stage + 1])

    @property
    def wire_length_mm(self) -> float:
        """Length of the wire with both tails."""
        return sum(stage.length_mm for stage in self.stages)

    @property
    def smallest_radius_mm(self) -> float:
        """Smallest bend radius of the wire."""
        return min(stage.smallest_radius_mm for stage in self.stages)

    @property
    def closed(self) -> bool:
        """Whether the wire, its tails taken off, is one curve that ends where it starts."""
        wire = self.wire
        gaps, _ = wire.joints()
        (leaves,), _ = wire.pieces[0].at(np.array([wire.pieces[0].length_mm]))
        (returns,), _ = wire.pieces[-1].at(np.array([0.0]))
        gap = max(float(gaps.max(initial=0.0)), float(np.hypot(*(leaves - returns))))
        return gap < CLOSING_TOLERANCE_MM
