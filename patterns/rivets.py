"""Where rivet snaps go through a strip."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import isfinite

from patterns.cut_piece import Hole
from patterns.errors import PatternError
from patterns.positive import check_positive


@dataclass(frozen=True, slots=True)
class RivetHoles:
    """A row of equal holes on a strip's axis.

    Attributes
    ----------
    diameter_mm : float
        Of each hole.
    positions_mm : tuple of float
        Centres along the axis, from the strip's left end, rising.
    """

    diameter_mm: float
    positions_mm: tuple[float, ...]

    def __post_init__(self) -> None:
        """Refuse what is no row of holes."""
        check_positive("row of rivet holes", diameter_mm=self.diameter_mm)
        rising = all(start < end for start, end in pairwise(self.positions_mm))
        if len(self.positions_mm) < 2 or not rising or not all(map(isfinite, self.positions_mm)):
            listed = ", ".join(f"{position:g}" for position in self.positions_mm)
            raise PatternError(
                f"no row of rivet holes at [{listed}] mm: there must be two or more, rising"
            )

    @property
    def segments_mm(self) -> tuple[tuple[float, float], ...]:
        """Start and end of each stretch between neighbouring holes."""
        return tuple(pairwise(self.positions_mm))

    def holes(self, strip_length_mm: float) -> tuple[Hole, ...]:
        """Give the holes of a strip whose centre is the origin."""
        return tuple(
            Hole(position - strip_length_mm / 2, 0.0, self.diameter_mm)
            for position in self.positions_mm
        )


def joined_segments(
    segments: int, segment_mm: float, end_mm: float, diameter_mm: float
) -> RivetHoles:
    """Put a hole at both ends of a strip and where its segments join.

    Parameters
    ----------
    segments : int
        How many segments the strip has.
    segment_mm : float
        Distance of neighbouring holes: the free length of a segment.
    end_mm : float
        From the centre of the first and last hole to the strip's end.
    diameter_mm : float
        Of the holes.

    Raises
    ------
    PatternError
        When a quantity is not positive.
    """
    check_positive(
        "row of rivet holes",
        segments=segments,
        segment_mm=segment_mm,
        end_mm=end_mm,
    )
    positions = (end_mm + k * segment_mm for k in range(segments + 1))
    return RivetHoles(diameter_mm, tuple(positions))
