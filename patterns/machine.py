"""What the embroidery machine can do."""

from __future__ import annotations

from dataclasses import dataclass

DST_LARGEST_STEP_MM = 12.1
"""Largest displacement of one record along each axis (121 units of 0.1 mm; Tajima DST)."""


@dataclass(frozen=True, slots=True)
class Machine:
    """Field and limits of a machine with a tailored-wire head.

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
    """

    hoop_width_mm: float
    hoop_height_mm: float
    needle_diameter_mm: float
    longest_stitch_mm: float = DST_LARGEST_STEP_MM
    shortest_stitch_mm: float = 0.3
    jumps_per_trim: int = 3
