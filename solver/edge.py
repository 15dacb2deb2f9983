"""The closed curve of the wire, as the Fourier sum that it is."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.float64]

_SAMPLES = 128
_NEWTON_STEPS = 6
_CLOSE = 1e-9
"""Of a last step; heights change by its square."""


@lru_cache(maxsize=16)
def _samples(count: int, waves: int) -> tuple[Vectors, Vectors]:
    """Cosines and sines (count, waves) of all waves at equally spaced angles."""
    phase = np.outer(np.arange(count) * (2 * np.pi / count), np.arange(waves))
    return np.cos(phase), np.sin(phase)


@dataclass(frozen=True)
class EdgeCurve:
    """Curve x(θ) = Σ cosines[m] cos mθ + sines[m] sin mθ, lengths in units of R.

    Attributes
    ----------
    cosines, sines : array (M, 3)
    """

    cosines: Vectors
    sines: Vectors

    def position(self, theta: Vectors, derivative: int = 0) -> Vectors:
        """Positions (n, 3) at angles of the disc's edge, or a derivative by the angle."""
        m = np.arange(len(self.cosines))
        phase = np.multiply.outer(theta, m) + derivative * (np.pi / 2)
        power = m.astype(float) ** derivative
        return (np.cos(phase) * power) @ self.cosines + (np.sin(phase) * power) @ self.sines

    def samples(self, count: int) -> Vectors:
        """Positions (count, 3) at equally spaced angles, from 0; quick for a count used before."""
        cosine, sine = _samples(count, len(self.cosines))
        return cosine @ self.cosines + sine @ self.sines

    @property
    def crest(self) -> float:
        """Angle of the highest point; 0 when all are level."""
        return self._highest(1.0)

    @property
    def extent(self) -> float:
        """Difference in z of the highest and the lowest point."""
        ends = np.array([self._highest(1.0), self._highest(-1.0)])
        crest, valley = self.position(ends)[:, 2]
        return float(crest - valley)

    def _highest(self, sign: float) -> float:
        """Angle of the largest sign·z: the highest sample, refined by Newton's steps on z'."""
        cosine, sine = _samples(_SAMPLES, len(self.cosines))
        rise = cosine @ self.cosines[:, 2] + sine @ self.sines[:, 2]
        start = float(np.argmax(sign * rise)) * (2 * np.pi / _SAMPLES)
        best = start
        for _ in range(_NEWTON_STEPS):
            at = np.array([best])
            slope = float(self.position(at, 1)[0, 2])
            bend = float(self.position(at, 2)[0, 2])
            if sign * bend >= 0:  # level, or not near a crest
                return start
            step = slope / bend
            best -= step
            if abs(step) < _CLOSE:
                return best
            if abs(best - start) > 2 * np.pi / _SAMPLES:
                return start
        return best
