"""Euler's elastica between its ends in closed form: the shapes of a strip without sleeves.

Units: length L of the strip, energy EI/L, force EI/L². Between pinned ends the n-th mode has
sin(θ/2) = k sn(β s + K), β = 2 n K(k), and a chord c = 2 E/K − 1 (Love, The Mathematical Theory of
Elasticity, 1927, sections 262 and 263). Between clamped ends the first mode is the second of pinned
ends, moved along by a quarter of its length.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.special import ellipj, ellipk, elliprd

from solver.strip.ends import Ends

Vectors = NDArray[np.float64]

_LARGEST_PARAMETER = 0.9
"""m = k² when the ends meet is 0.826."""


def _deficit(m: float) -> float:
    """1 − E/K, without cancellation for small m: K − E = (m/3) R_D(0, 1 − m, 1).

    Carlson, Numerical Algorithms 10 (1995) 13, equation 4.6.
    """
    return m / 3 * float(elliprd(0.0, 1 - m, 1.0)) / float(ellipk(m))


def parameter(shortening: float) -> float:
    """Parameter m = k² = sin²(α/2), α the ends' angle, of a strip of chord 1 − ``shortening``."""
    return float(
        brentq(
            lambda m: 2 * _deficit(m) - shortening,
            0.0,
            _LARGEST_PARAMETER,
            xtol=1e-16,
            rtol=1e-14,
        )
    )


@dataclass(frozen=True)
class Elastica:
    """One mode at one chord.

    Attributes
    ----------
    shortening : float
        1 − c, greater than 0 and at most 1.
    mode : int
        Number n of half waves, pinned ends.
    """

    shortening: float
    mode: int = 1

    @property
    def parameter(self) -> float:
        """Parameter m = k² of the elliptic functions."""
        return parameter(self.shortening)

    @property
    def beta(self) -> float:
        """β = √P = 2 n K."""
        return 2 * self.mode * float(ellipk(self.parameter))

    @property
    def force(self) -> float:
        """P, compression of the strip."""
        return self.beta**2

    @property
    def energy(self) -> float:
        """½ ∫ κ² ds = 2 P (k² − 1 + E/K)."""
        return 2 * self.force * (self.parameter - _deficit(self.parameter))

    def heading(self, arc: Vectors, ends: Ends = Ends.PINNED) -> Vectors:
        """θ(s) at s in 0 to 1, greater than 0 at first.

        Between clamped ends, of even modes only: they begin and end along the chord.
        """
        m = self.parameter
        shift = float(ellipk(m)) if ends is Ends.PINNED else 0.0
        sn = ellipj(self.beta * arc + shift, m)[0]
        return 2 * np.arcsin(np.sqrt(m) * sn)
