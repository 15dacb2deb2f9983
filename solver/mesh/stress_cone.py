"""Coordinates in which any plane stiffness is three numbers, and tension a round cone.

A plane stress S is tensile in all directions where s₀ ≥ √(s₁² + s₂²), with s₀ = (S₁₁ + S₂₂)/2,
s₁ = (S₁₁ − S₂₂)/2 and s₂ = S₁₂: a cone, along whose surface S is uniaxial. Stretching and shearing
the plane turns this cone into itself, as changes of the observer do the light cone, and with two
quadratic forms of which one is definite there is such a change that makes both diagonal: the energy
of taut fabric becomes ½ Σ dᵢ sᵢ², with d₁ ≤ d₂, and the cone stays as it was. Where fabric is alike
in all directions d₁ = d₂, and there is nothing to change.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

Vectors = NDArray[np.float64]

_CONE = np.diag([1.0, -1.0, -1.0])
_PARTS = np.array([[1.0, 1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 0.0, 1.0]])
"""From (E₁₁, E₂₂, 2E₁₂) to what does work on (s₀, s₁, s₂)."""


@dataclass(frozen=True)
class StressCone:
    """The change of coordinates that suits a stiffness.

    Attributes
    ----------
    frame : array (3, 3)
        From strain (E₁₁, E₂₂, 2E₁₂) to its coordinates e; its transpose leads from coordinates s
        of the stress to (S₁₁, S₂₂, S₁₂).
    compliance : array (3,)
        d: e = d s where the fabric is taut, in units of 1/E_f.
    """

    frame: Vectors
    compliance: Vectors


def stress_cone(stiffness: Vectors) -> StressCone:
    """Find it for a positive definite stiffness (3, 3), from (E₁₁, E₂₂, 2E₁₂) to stress."""
    compliance = _PARTS @ np.linalg.inv(stiffness) @ _PARTS.T
    values, vectors = scipy.linalg.eigh(_CONE, compliance)
    # the cone's form has one positive value, which comes last, and two negative ones
    order = [2, 0, 1]
    size = np.abs(values[order])
    change = vectors[:, order] / np.sqrt(size)
    change[:, 0] *= np.sign(change[0, 0])
    return StressCone(change.T @ _PARTS, 1 / size)
