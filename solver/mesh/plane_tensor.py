"""Principal values of symmetric tensors in the plane of the fabric."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.float64]


def principal(tensor: Vectors) -> tuple[Vectors, Vectors]:
    """Smaller and larger principal value (m,) of plane tensors (S₁₁, S₂₂, S₁₂), (m, 3)."""
    mean = (tensor[:, 0] + tensor[:, 1]) / 2
    radius = np.hypot((tensor[:, 0] - tensor[:, 1]) / 2, tensor[:, 2])
    return mean - radius, mean + radius


def tensile(stress: Vectors) -> Vectors:
    """Stress (m, 3) with its compressive principal values set to 0."""
    low, high = principal(stress)
    kept_low, kept_high = np.maximum(low, 0), np.maximum(high, 0)
    # S⁺ = p 1 + q S has the principal values kept_low and kept_high
    spread = high - low
    q = np.where(spread > 0, (kept_high - kept_low) / np.where(spread > 0, spread, 1.0), 0.0)
    p = kept_high - q * high
    return q[:, None] * stress + p[:, None] * np.array([1.0, 1.0, 0.0])
