"""How the ends of a strip are held, and what that makes of its first two buckling modes."""

from __future__ import annotations

from enum import StrEnum
from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

Vectors = NDArray[np.float64]


class Ends(StrEnum):
    """Whether a rivet lets an end turn (``pinned``) or keeps it along the chord (``clamped``)."""

    PINNED = "pinned"
    CLAMPED = "clamped"


@cache
def second_clamped_load() -> float:
    """β = √(P L²/EI) of the second mode between clamped ends: tan(β/2) = β/2.

    Timoshenko and Gere, Theory of Elastic Stability (1961), section 2.2: P = 8.18 π² EI/L².
    """
    return 2 * float(brentq(lambda x: np.sin(x) - x * np.cos(x), 4.0, 4.7, xtol=1e-15))


def buckling_loads(ends: Ends) -> tuple[float, float]:
    """P of the first two modes of the nearly straight strip, in units of EI/L².

    The barrier between its states is their difference times δ: docs/theory.md, eq. (21).
    """
    if ends is Ends.PINNED:
        return np.pi**2, 4 * np.pi**2
    return 4 * np.pi**2, second_clamped_load() ** 2


def buckling_headings(ends: Ends, arc: Vectors) -> tuple[Vectors, Vectors]:
    """Headings θ(s) of the first two modes at s in 0 to 1, each with ∫θ² ds = 1.

    They are orthogonal, so that a nearly straight strip of headings A1 θ1 + A2 θ2 is shorter by
    (A1² + A2²)/2.
    """
    if ends is Ends.PINNED:
        return np.sqrt(2) * np.cos(np.pi * arc), np.sqrt(2) * np.cos(2 * np.pi * arc)
    half = second_clamped_load() / 2
    second = 1 - np.cos(2 * half * (arc - 0.5)) / np.cos(half)
    # its mean square, with sin(half) = half cos(half)
    square = 1 - 2 + (1 / np.cos(half) ** 2 + 1) / 2
    return np.sqrt(2) * np.sin(2 * np.pi * arc), second / np.sqrt(square)
