"""What the fabric of a shape feels: its stretch and its tension."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.mesh.fabric_law import FabricLaw
from solver.mesh.plane_tensor import principal

Vectors = NDArray[np.float64]


@dataclass(frozen=True)
class FabricFields:
    """Values (m,) at points of the fabric, each in the direction in which it is largest.

    Attributes
    ----------
    stretch_percent : array (m,)
        How much longer the fabric is there than without any load.
    tension_N_m : array (m,)
        Force over a length of the fabric as it is now.
    """

    stretch_percent: Vectors
    tension_N_m: Vectors  # noqa: N815 - the unit's name


def fabric_fields(deformation: Vectors, law: FabricLaw, sheet_modulus_N_m: float) -> FabricFields:  # noqa: N803
    """Find both from deformation gradients.

    With stretches λ₁ ≥ λ₂ and second Piola–Kirchhoff stresses S₁ ≥ S₂ along the same axes, as
    isotropic fabric has them, the tension is E_f t S₁ λ₁/λ₂ (Cauchy's stress F S Fᵀ/J, times the
    thickness that the unloaded fabric has; Holzapfel, Nonlinear Solid Mechanics, 2000, 3.65).

    Parameters
    ----------
    deformation : array (m, 3, 2)
        Derivatives of the position by the two coordinates of the unloaded fabric.
    law : FabricLaw
        Isotropic.
    sheet_modulus_N_m : float
        E_f t.
    """
    along, across = deformation[..., 0], deformation[..., 1]
    strain = np.stack(
        [
            (np.sum(along * along, axis=-1) - 1) / 2,
            (np.sum(across * across, axis=-1) - 1) / 2,
            np.sum(along * across, axis=-1),
        ],
        axis=-1,
    )
    narrow, wide = principal(strain * (1, 1, 0.5))
    _, stress = principal(law.stress(strain))
    longest, shortest = np.sqrt(1 + 2 * wide), np.sqrt(1 + 2 * narrow)
    return FabricFields(100 * (longest - 1), sheet_modulus_N_m * stress * longest / shortest)
