"""How wire is tied down and covered: the numbers an operator sets."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

ROUNDING_MM = 0.0708
"""How far rounding to the 0.1 mm grid of stitch files can move a point (half a diagonal)."""

Underlay = Literal["none", "edge"]
"""What lies below the satin of a cover: nothing, or running stitches along both sides."""

Stripes = Literal["none", "rows", "columns"]
"""Lines of thread across the loops that do not stretch: none, along rows, or along columns."""

Ties = Literal["none", "contacts"]
"""Thread that holds loops to one another: none, or a tie in each point in which two touch."""


@dataclass(frozen=True, slots=True)
class Stitching:
    """Settings of couching, covers, locks, tails and marks.

    Attributes
    ----------
    couching_interval_mm : float
        Distance along the wire from one needle point to the next, on the other side.
    couching_angle_deg : float
        Largest turn of the wire from one needle point to the next, which are closer on bends for
        it. The straight way between two ties leaves a bend of radius R by R (1 - cos(angle / 2)):
        1.5 % of R at the default.
    needle_margin_mm : float
        Free space between needle and wire in the plan, beyond which a needle point is laid; more
        than `ROUNDING_MM`, so that rounding never brings the needle to the wire.
    cover_spacing_mm : float
        Distance along the wire between the needle points of the satin that covers it.
    cover_reach_mm : float
        Laid wire is covered wherever the surface of wire of the next stage comes nearer than this.
    cover_overlap_mm : float
        How far a cover goes on past that, on each side, before its last stitch.
    cover_margin_mm : float
        As ``needle_margin_mm``, of covers, which are wider for it; never less than that.
    cover_underlay : {"none", "edge"}
        What is sewn below the satin.
    stripes : {"none", "rows", "columns"}
        Lines of inextensible thread through the centres of the loops, sewn last.
    stripe_stitch_mm : float
        Longest stitch of a stripe, but for those that step over wire.
    stripe_passes : int
        How often a stripe is sewn over: 1, or 2 for there and back.
    ties : {"none", "contacts"}
        Thread over both wires where loops touch, sewn after the stripes.
    lock_length_mm : float
        Length of the small stitches back and forth that lock a thread.
    tail_length_mm : float
        Straight wire beyond each end of the circuit, for the crimp.
    mark_size_mm, mark_gap_mm : float
        Size of a registration mark, and its distance from everything else.
    smallest_bend_diameters : float
        Smallest bend radius of the wire, in wire diameters.
    """

    couching_interval_mm: float = 2.0
    couching_angle_deg: float = 20.0
    needle_margin_mm: float = 0.1
    cover_spacing_mm: float = 0.4
    cover_reach_mm: float = 0.5
    cover_overlap_mm: float = 0.0
    cover_margin_mm: float = 0.1
    cover_underlay: Underlay = "none"
    lock_length_mm: float = 0.7
    tail_length_mm: float = 40.0
    mark_size_mm: float = 8.0
    mark_gap_mm: float = 6.0
    smallest_bend_diameters: float = 25.0
    stripes: Stripes = "none"
    stripe_stitch_mm: float = 2.5
    stripe_passes: int = 1
    ties: Ties = "none"

    @property
    def largest_cover_gap_mm(self) -> float:
        """Cover stitches that cross a wire farther apart than this leave it bare in between."""
        return 1.5 * self.cover_spacing_mm + 2 * ROUNDING_MM

    @property
    def wider_by_mm(self) -> float:
        """How much farther from the wire covers are sewn than couching."""
        return max(0.0, self.cover_margin_mm - self.needle_margin_mm)
