"""What is to be solved: one loop, in dimensionless numbers."""

from __future__ import annotations

import math
from dataclasses import dataclass

from solver.ellipse import semi_axes
from solver.errors import SceneError
from solver.reading import Reading, check_poisson, density_coefficients

LARGEST_STRAIN = 2.0
"""Knits tear long before; beyond it St. Venant–Kirchhoff elasticity means nothing."""

LARGEST_AXIS_RATIO = 10.0
LARGEST_NATURAL_CURVATURE = 10.0
LARGEST_TWIST_RATIO = 10.0
LARGEST_ALPHA = 1.0
"""Of fabric more than twice as thick as the loop's radius; what is a sheet ends far below."""

ROUND_WIRE_TWIST_RATIO = 0.75
"""GJ/EI = 1/(1 + ν) of a round wire (J = 2I, G = E/2(1 + ν)), for ν = 1/3 of nickel-titanium.

A maker's table gives 0.33 ("Nitinol technical properties", Principles of Nitinol, at
medicaldevicecomponents.com); another's says "approximately 0.3" (ti-mart.com/cases/cases154.html),
which would make it 0.77.
"""


@dataclass(frozen=True, slots=True)
class LoopScene:
    """A loop of perimeter 2π on fabric stretched by ``strain`` in all directions.

    The energy is U = ∫ w(E) dA0 + α ∫ H² dA + β ∮ (κ − κ0)² dl + (k/2) ∮ (λ − 1)² ds + 2π β ρ Wr²,
    with dA0 the unstretched and dA the deformed area, H the fabric's mean curvature, κ the wire's
    curvature, λ its stretch, k its axial stiffness and Wr the loop's writhe. Lengths are in units
    of the radius R of the circle of the same perimeter, energies in units of E_f t R²
    (docs/theory.md, eq. (1)).

    Attributes
    ----------
    strain : float
        ε, at least 0: the unstretched disc is smaller by 1/(1+ε).
    beta : float
        β, greater than 0.
    poisson : float
        ν of the fabric.
    reading : Reading
        How the fabric's energy density is read.
    axial_stiffness : float
        k = E_w A_w / (E_f t R); large for a wire that hardly stretches.
    axis_ratio : float
        Length over width of the flat loop, an ellipse along x; 1 is a circle.
    modulus_ratio : float
        r = E1/E2 of an orthotropic fabric, E1 = 2r/(1+r) along x and E2 = 2/(1+r) along y in units
        of their mean E_f.
    natural_curvature : float
        κ0, in units of 1/R, at least 0, of a wire that is free to turn about its own axis.
    twist_ratio : float
        ρ = GJ/EI, the wire's stiffness against twist over that against bending, of a straight
        wire laid flat without twist; 0 leaves its twist out.
    alpha : float
        α, bending stiffness of the fabric in units of E_f t R²; see `solver.fabric_bending`.

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
    axis_ratio: float = 1.0
    modulus_ratio: float = 1.0
    natural_curvature: float = 0.0
    twist_ratio: float = 0.0
    alpha: float = 0.0

    def __post_init__(self) -> None:
        _check_range("strain", self.strain, 0, LARGEST_STRAIN)
        _check_range("axis_ratio", self.axis_ratio, 1, LARGEST_AXIS_RATIO)
        _check_range("natural_curvature", self.natural_curvature, 0, LARGEST_NATURAL_CURVATURE)
        _check_range("twist_ratio", self.twist_ratio, 0, LARGEST_TWIST_RATIO)
        _check_range("alpha", self.alpha, 0, LARGEST_ALPHA)
        for key, value in (
            ("beta", self.beta),
            ("axial_stiffness", self.axial_stiffness),
            ("modulus_ratio", self.modulus_ratio),
        ):
            if not (value > 0 and math.isfinite(value)):
                raise SceneError(f"{key} = {value:g}: must be greater than 0 and finite")
        check_poisson(self.poisson, self.reading)
        self._check_orthotropy()
        self._check_twist()

    def _check_orthotropy(self) -> None:
        """Refuse moduli so different that the density is no longer positive definite."""
        along, across = self.moduli
        a, b = density_coefficients(self.poisson, self.reading)
        if self.modulus_ratio != 1 and along * across <= (b / (a + b)) ** 2:
            raise SceneError(
                f"modulus_ratio = {self.modulus_ratio:g}: too far from 1 for poisson = "
                f"{self.poisson:g} ({self.reading} reading); the fabric would not be stable"
            )

    def _check_twist(self) -> None:
        """Refuse twist of a curved wire, which would not spread evenly along it."""
        if self.twist_ratio > 0 and self.natural_curvature > 0:
            raise SceneError(
                f"twist_ratio = {self.twist_ratio:g}: twist is modelled for a straight wire only, "
                f"and natural_curvature = {self.natural_curvature:g}; use 0 for one of them"
            )

    @property
    def moduli(self) -> tuple[float, float]:
        """E1 along x and E2 along y, in units of their mean."""
        r = self.modulus_ratio
        return 2 * (r / (1 + r)), 2 / (1 + r)

    @property
    def semi_axes(self) -> tuple[float, float]:
        """Half the length and half the width of the flat loop, in units of R."""
        return semi_axes(self.axis_ratio)

    @property
    def isotropic_circle(self) -> bool:
        """Whether every direction in the flat loop is like every other."""
        return self.axis_ratio == 1 and self.modulus_ratio == 1


def _check_range(key: str, value: float, lowest: float, highest: float) -> None:
    if not lowest <= value <= highest:
        raise SceneError(f"{key} = {value:g}: must be from {lowest:g} to {highest:g}")
