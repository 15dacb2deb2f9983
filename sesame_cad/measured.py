"""What the SESAME paper plots and measured, for comparison."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class FigurePoint:
    """A point that the paper marks in the left half of its Fig. 2.

    Attributes
    ----------
    beta, strain : float
    marker, face : str
        How it is drawn.
    label : str
    """

    beta: float
    strain: float
    marker: str
    face: str
    label: str


FIG_2_POINTS = (
    FigurePoint(0.06, 0.02, "s", "#FFFFFF", "paper, Fig. 2: ε = 0.02"),
    FigurePoint(0.06, 0.1, "^", "#FFFFFF", "paper, Fig. 2: ε = 0.1"),
    FigurePoint(0.06, 0.3, "o", "#000000", "paper, Fig. 2: ε = 0.3, its devices"),
)
"""Fig. 2 and its caption."""

TABLE_1_POINTS = (
    FigurePoint(0.01454, 0.3, "D", "#E69F00", "devices by Table I, cold: β = 0.0145"),
    FigurePoint(0.03896, 0.3, "D", "#CC3311", "devices by Table I, hot: β = 0.0390"),
)
"""β = E_w I_w/(2 E_f t R³) of the large array at 28 and 75 GPa; the small one's is 4 % greater."""


@dataclass(frozen=True, slots=True)
class MeasuredArray:
    """An array of the paper's Table I, whose height was measured on a scan (Fig. 3).

    Attributes
    ----------
    name : str
    prestrain, fabric_thickness_mm, fabric_modulus_kPa, wire_modulus_cold_GPa : float
    wire_diameter_mm, loop_diameter_mm : float
        Table I.
    height_over_perimeter : float
        h/(π d_0), two digits as printed.
    """

    name: str
    prestrain: float
    fabric_thickness_mm: float
    fabric_modulus_kPa: float  # noqa: N815 - the unit's own spelling
    wire_modulus_cold_GPa: float  # noqa: N815
    wire_diameter_mm: float
    loop_diameter_mm: float
    height_over_perimeter: float


MEASURED = (
    MeasuredArray("large array", 0.3, 0.27, 700.0, 28.0, 0.5, 50.0, 0.15),
    MeasuredArray("small array", 0.3, 0.27, 700.0, 28.0, 0.3, 25.0, 0.14),
)
