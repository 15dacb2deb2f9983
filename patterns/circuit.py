"""One wire through every loop: two halves that meet each contact once each."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from patterns.layout import Layout
from patterns.path import WirePath

CLOSING_TOLERANCE_MM = 1e-6


class CrossingKind(StrEnum):
    """Why the two halves come together."""

    CONTACT = "contact"
    TERMINALS = "terminals"


@dataclass(frozen=True, slots=True)
class Crossing:
    """A point in which the second half touches or crosses the first.

    Attributes
    ----------
    x_mm, y_mm : float
        The common point, where both halves have the same tangent line.
    first_mm, second_mm : float
        Where it lies along the first and along the second half.
    """

    kind: CrossingKind
    x_mm: float
    y_mm: float
    first_mm: float
    second_mm: float


@dataclass(frozen=True)
class Circuit:
    """One wire from terminal to terminal, laid in two halves.

    Attributes
    ----------
    layout : Layout
        The loops it runs through.
    switches : tuple of int
        The contacts (indices into ``layout.contacts``) in which the wire changes from loop to loop:
        a spanning tree of the touching graph.
    first_half, second_half : WirePath
        The second half starts where the first one ends; the first starts, and the second ends,
        with a straight tail.
    crossings : tuple of Crossing
        Every point in which the halves come together: all contacts, and the terminals.
    """

    layout: Layout
    switches: tuple[int, ...]
    first_half: WirePath
    second_half: WirePath
    crossings: tuple[Crossing, ...]

    @property
    def wire_length_mm(self) -> float:
        """Length of the wire with both tails."""
        return self.first_half.length_mm + self.second_half.length_mm

    @property
    def closed(self) -> bool:
        """Whether the wire, its tails taken off, is one curve that ends where it starts."""
        first, second = self.first_half, self.second_half
        (turn,), (start,) = first.at(first.length_mm)[0], second.at(0.0)[0]
        (leaves,), (returns,) = (
            first.at(first.pieces[0].length_mm)[0],
            second.at(second.length_mm - second.pieces[-1].length_mm)[0],
        )
        gap = max(np.hypot(*(turn - start)), np.hypot(*(leaves - returns)))
        return bool(gap < CLOSING_TOLERANCE_MM)
