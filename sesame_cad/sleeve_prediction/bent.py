"""Where what lies straight along a beam comes to lie when the beam is bent."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.strip.state import StripState

Vectors = NDArray[np.float64]


@dataclass(frozen=True)
class BentBeam:
    """A bent beam in the plane y = 0, its first rivet at the origin, its second on the x-axis.

    Sections stay plane and square to the beam's middle, as in the theory of the strip: what lies z
    above it is lengthened by 1 - κ z where the beam's curvature is κ.

    Attributes
    ----------
    points_mm : array (n, 2)
        Of the middle, equally spaced from rivet to rivet.
    headings_rad : array (n,)
    length_mm : float
        From rivet to rivet.
    """

    points_mm: Vectors
    headings_rad: Vectors
    length_mm: float

    @classmethod
    def of_state(cls, state: StripState, length_mm: float) -> BentBeam:
        """Give the beam of a state."""
        return cls(state.points_m * 1e3, state.headings_rad, length_mm)

    def carried(self, straight_mm: Vectors) -> Vectors:
        """Bend points (n, 3) in mm: along the straight beam from its first rivet, across, above.

        Past the rivets the beam goes straight on.
        """
        along, across, above = straight_mm.T
        place = np.linspace(0, self.length_mm, len(self.headings_rad))
        within = np.clip(along, 0, self.length_mm)
        heading = np.interp(within, place, self.headings_rad)
        x, z = (np.interp(within, place, self.points_mm[:, k]) for k in (0, 1))
        past = along - within
        cosine, sine = np.cos(heading), np.sin(heading)
        return np.stack(
            [x + past * cosine - above * sine, across, z + past * sine + above * cosine], axis=1
        )
