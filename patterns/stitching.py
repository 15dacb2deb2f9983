"""How wire is tied down and covered: the numbers an operator sets."""

from __future__ import annotations

from dataclasses import dataclass

ROUNDING_MM = 0.0708
"""How far rounding to the 0.1 mm grid of stitch files can move a point (half a diagonal)."""


@dataclass(frozen=True, slots=True)
class Stitching:
    """Settings of couching, covers, locks, tails and marks.

    Attributes
    ----------
    couching_interval_mm : float
        Distance along the wire from one needle point to the next, on the other side.
    needle_margin_mm : float
        Free space between needle and wire in the plan, beyond which a needle point is laid; more
        than `ROUNDING_MM`, so that rounding never brings the needle to the wire.
    cover_spacing_mm : float
        Distance along the wire between the needle points of the satin that covers it.
    cover_reach_mm : float
        Laid wire is covered wherever the surface of wire of the next stage comes nearer than this.
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
    needle_margin_mm: float = 0.1
    cover_spacing_mm: float = 0.4
    cover_reach_mm: float = 0.5
    lock_length_mm: float = 0.7
    tail_length_mm: float = 40.0
    mark_size_mm: float = 8.0
    mark_gap_mm: float = 6.0
    smallest_bend_diameters: float = 25.0

    @property
    def largest_cover_gap_mm(self) -> float:
        """Cover stitches that cross a wire farther apart than this leave it bare in between."""
        return 1.5 * self.cover_spacing_mm + 2 * ROUNDING_MM
