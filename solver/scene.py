"""What is to be solved: one loop, in dimensionless numbers."""

from __future__ import annotations

import math
from dataclasses import dataclass

from solver.errors import SceneError
from solver.reading import Reading, check_poisson

LARGEST_STRAIN = 2.0
"""Knits tear long before; beyond it St. Venant–Kirchhoff elasticity means nothing."""


@dataclass(frozen=True, slots=True)
class LoopScene:
    """A circular loop of radius 1 on fabric stretched by ``strain`` in all directions.

    The energy is U = ∫ w(E) dA0 + β ∮ κ² dl + (k/2) ∮ (λ − 1)² ds, with dA0 the unstretched area,
    κ the wire's curvature, λ its stretch and k its axial stiffness.

    Attributes
    ----------
    strain : float
        ε, at least 0: the unstretched disc has radius 1/(1+ε).
    beta : float
        β, greater than 0.
    poisson : float
        ν of the fabric.
    reading : Reading
        How the fabric's energy density is read.
    axial_stiffness : float
        k = E_w A_w / (E_f t R); large for a wire that hardly stretches.

    Raises
    ------
    SceneError
        When a number is out of its range.
    """

    strain: float
    beta: float
    poisson: float
    reading: Reading = Reading.PLANE_STRESS
    axial_stiffness: float = 1000.0

    def __post_init__(self) -> None:
        if not 0 <= self.strain <= LARGEST_STRAIN:
            raise SceneError(f"strain = {self.strain:g}: must be from 0 to {LARGEST_STRAIN:g}")
        for key, value in (("beta", self.beta), ("axial_stiffness", self.axial_stiffness)):
            if not (value > 0 and math.isfinite(value)):
                raise SceneError(f"{key} = {value:g}: must be greater than 0 and finite")
        check_poisson(self.poisson, self.reading)
