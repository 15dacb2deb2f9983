"""What the embroidery machine can do."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

DST_LARGEST_STEP_MM = 12.1
"""Largest displacement of one record along each axis (121 units of 0.1 mm; Tajima DST)."""

CouchingMode = Literal["zigzag", "centreline"]
"""What a stitch file holds of the couching: needle points beside the wire, or places on the wire at
which a head swings its needle to both sides."""


@dataclass(frozen=True, slots=True)
class Machine:
    """Field and limits of a machine that couches wire.

    Attributes
    ----------
    hoop_width_mm, hoop_height_mm : float
        Inside of the hoop; the design is centred in it.
    needle_diameter_mm : float
        Shaft of the needle (Nm 75 is 0.75 mm).
    longest_stitch_mm : float
        Longest stitch along each axis, at most `DST_LARGEST_STEP_MM`.
    shortest_stitch_mm : float
        Below this some machines drop the following stitch.
    jumps_per_trim : int
        So many jumps in a row make the machine trim the thread.
    hoop_rim_mm : float
        Strip along the inside of the hoop in which the machine does not sew.
    couching : {"zigzag", "centreline"}
        What the stitch file holds of the couching.
    swing_mm : float
        From needle point to needle point of a head that swings across the wire; only of use with
        "centreline".
    hand_guided : bool
        Whether a hand, not a head, leads the wire.
    """

    hoop_width_mm: float
    hoop_height_mm: float
    needle_diameter_mm: float
    longest_stitch_mm: float = DST_LARGEST_STEP_MM
    shortest_stitch_mm: float = 0.3
    jumps_per_trim: int = 3
    hoop_rim_mm: float = 0.0
    couching: CouchingMode = "zigzag"
    swing_mm: float = 4.0
    hand_guided: bool = False

    @property
    def field_mm(self) -> tuple[float, float]:
        """Width and height of what the machine can sew, centred in the hoop."""
        rims = 2 * self.hoop_rim_mm
        return self.hoop_width_mm - rims, self.hoop_height_mm - rims
