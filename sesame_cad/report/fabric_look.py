"""How the page colours fabric: its stretch and its tension, in a maker's units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sesame_cad.specification import Specification
from solver.mesh.fields import FabricFields

Vectors = NDArray[np.float64]


@dataclass(frozen=True)
class FabricLook:
    """Values (m,) at places of the fabric, each in the direction in which it is largest.

    Attributes
    ----------
    stretch_percent : array (m,)
        How much longer the fabric is there than without any load.
    tension_N_m : array (m,)
        Force over a length of the fabric as it is now.
    """

    stretch_percent: Vectors
    tension_N_m: Vectors  # noqa: N815 - the unit's name


def fabric_look(spec: Specification, fields: FabricFields) -> FabricLook:
    """Give both from principal stretches and stresses.

    With stretches λ₁ ≥ λ₂ and second Piola–Kirchhoff stresses S₁ ≥ S₂ along the same axes, as
    isotropic fabric has them, the tension is E_f t S₁ λ₁/λ₂ (Cauchy's stress F S Fᵀ/J, times the
    thickness that the unloaded fabric has; Holzapfel, Nonlinear Solid Mechanics, 2000, 3.65).
    """
    modulus = spec.fabric.modulus_kPa * spec.fabric.thickness_mm  # kPa mm = N/m
    tension = fields.larger_stress * fields.larger_stretch / fields.smaller_stretch
    return FabricLook(100 * (fields.larger_stretch - 1), modulus * tension)
