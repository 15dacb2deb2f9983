"""Heat that a thin horizontal wire gives to still air."""

from __future__ import annotations

from solver.actuation.transformation import ABSOLUTE_ZERO_C
from solver.errors import SceneError

_GRAVITY_M_S2 = 9.80665
_PRESSURE_PA = 101325.0
_GAS_CONSTANT_J_KGK = 287.05
"""Of dry air."""

_HEAT_CAPACITY_J_KGK = 1006.0
"""Of air at constant pressure, near room temperature."""

_LEAST_EXCESS_C = 1.0
"""The coefficient is that of at least this much warmer wire; it would be 0 for none."""


def _sutherland(value: float, constant_K: float, temperature_K: float) -> float:  # noqa: N803
    """Sutherland's law from a value at 273.15 K."""
    ratio = temperature_K / 273.15
    return value * ratio**1.5 * (273.15 + constant_K) / (temperature_K + constant_K)


def natural_convection_W_m2K(  # noqa: N802 - the unit's own spelling
    diameter_m: float,
    surface_C: float,  # noqa: N803
    ambient_C: float,  # noqa: N803
) -> float:
    """Coefficient of natural convection about a horizontal cylinder in still air.

    Churchill and Chu's correlation for all Rayleigh numbers above 1e-5 (Int. J. Heat Mass Transfer
    18 (1975) 1049): Nu = {0.60 + 0.387 Ra^(1/6) / [1 + (0.559/Pr)^(9/16)]^(8/27)}². Air is an ideal
    gas at 1 atm and at the mean of both temperatures, with Sutherland's laws for its viscosity
    (1.716e-5 Pa s, 110.6 K) and conductivity (0.0241 W/mK, 194 K; White, Viscous Fluid Flow).

    Raises
    ------
    SceneError
        When the diameter is not positive, or a temperature is below absolute zero.
    """
    if not diameter_m > 0:
        raise SceneError(f"diameter_m = {diameter_m:g}: must be greater than 0")
    if min(surface_C, ambient_C) <= ABSOLUTE_ZERO_C:
        raise SceneError(f"temperature {min(surface_C, ambient_C):g} C: is below absolute zero")
    excess = max(abs(surface_C - ambient_C), _LEAST_EXCESS_C)
    film_K = (surface_C + ambient_C) / 2 - ABSOLUTE_ZERO_C  # noqa: N806
    viscosity = _sutherland(1.716e-5, 110.6, film_K)
    conductivity = _sutherland(0.0241, 194.0, film_K)
    density = _PRESSURE_PA / (_GAS_CONSTANT_J_KGK * film_K)
    prandtl = viscosity * _HEAT_CAPACITY_J_KGK / conductivity
    grashof = _GRAVITY_M_S2 / film_K * excess * diameter_m**3 * (density / viscosity) ** 2
    shape = (1 + (0.559 / prandtl) ** (9 / 16)) ** (8 / 27)
    nusselt = (0.60 + 0.387 * (grashof * prandtl) ** (1 / 6) / shape) ** 2
    return nusselt * conductivity / diameter_m
