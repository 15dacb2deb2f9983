"""From materials in SI units to the dimensionless model.

Lengths are in units of the loop radius R, energies in units of E_f t R².
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace


@dataclass(frozen=True, slots=True)
class LoopMaterials:
    """One loop of wire on fabric.

    Attributes
    ----------
    fabric_modulus_Pa, fabric_thickness_m : float
        E_f and t.
    wire_modulus_Pa, wire_diameter_m : float
        E_w and d_w.
    loop_radius_m : float
        R, of the wire's centreline.
    """

    fabric_modulus_Pa: float  # noqa: N815 - Pa is the unit's name
    fabric_thickness_m: float
    wire_modulus_Pa: float  # noqa: N815
    wire_diameter_m: float
    loop_radius_m: float

    @property
    def force_unit_N(self) -> float:  # noqa: N802
        """E_f t R, the unit of force."""
        return self.fabric_modulus_Pa * self.fabric_thickness_m * self.loop_radius_m

    @property
    def energy_unit_J(self) -> float:  # noqa: N802
        """E_f t R², the unit of energy."""
        return self.force_unit_N * self.loop_radius_m

    @property
    def beta(self) -> float:
        """β = E_w I_w / (2 E_f t R³) with I_w = π r_w⁴/4 (Eq. 4 of the SESAME paper, L = R).

        See docs/theory.md, eq. (2).
        """
        second_moment = math.pi * (self.wire_diameter_m / 2) ** 4 / 4
        return self.wire_modulus_Pa * second_moment / (2 * self.energy_unit_J * self.loop_radius_m)

    def radius_of_beta(self, beta: float) -> float:
        """Radius in m of the loop of these materials that has that β; the loop's own has no say."""
        at_one_metre = replace(self, loop_radius_m=1.0).beta
        return (at_one_metre / beta) ** (1 / 3)

    @property
    def axial_stiffness(self) -> float:
        """E_w A_w / (E_f t R): what it takes to stretch the wire."""
        area = math.pi * self.wire_diameter_m**2 / 4
        return self.wire_modulus_Pa * area / self.force_unit_N

    def alpha(self, poisson: float) -> float:
        """α = t² / (6 R² (1 − ν²)): the fabric's own bending (Eq. 4 of the paper, L = R)."""
        return (self.fabric_thickness_m / self.loop_radius_m) ** 2 / (6 * (1 - poisson**2))
