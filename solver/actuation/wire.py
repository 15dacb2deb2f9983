"""A shape-memory wire that a current heats, per metre of its length."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.actuation.transformation import Transformation
from solver.errors import SceneError

Values = NDArray[np.float64]

MELTING_C = 1300.0
"""Of nickel-titanium (Dynalloy, Technical Characteristics of Flexinol, F1140 Rev I.2)."""

HEAT_CAPACITY_J_KGK = 0.2 * 4186.8
"""0.2 cal/g°C, same source."""

LATENT_HEAT_J_KG = 5.78 * 4186.8
"""5.78 cal/g of the whole transformation, same source."""


@dataclass(frozen=True, slots=True)
class HeatedWire:
    """What the wire is made of; it is uniform, and so thin that one temperature is all.

    Modulus and resistivity lie between those of both phases in proportion to their fractions
    (rule of mixtures: Tanaka, Res Mechanica 18 (1986) 251; the resistivity's is usual).

    Attributes
    ----------
    diameter_m, density_kg_m3 : float
    resistivity_cold_ohm_m, resistivity_hot_ohm_m : float
        Of martensite and of austenite.
    modulus_cold_Pa, modulus_hot_Pa : float
        The same of Young's modulus.
    transformation : Transformation
    heat_capacity_J_kgK : float
        cp, of both phases.
    latent_heat_J_kg : float
        L, taken up when martensite becomes austenite, and given back; at least 0.

    Raises
    ------
    SceneError
        When a number is out of its range.
    """

    diameter_m: float
    density_kg_m3: float
    resistivity_cold_ohm_m: float
    resistivity_hot_ohm_m: float
    modulus_cold_Pa: float  # noqa: N815 - the unit's own spelling
    modulus_hot_Pa: float  # noqa: N815
    transformation: Transformation
    heat_capacity_J_kgK: float = HEAT_CAPACITY_J_KGK  # noqa: N815
    latent_heat_J_kg: float = LATENT_HEAT_J_KG  # noqa: N815

    def __post_init__(self) -> None:
        positive = (
            "diameter_m",
            "density_kg_m3",
            "resistivity_cold_ohm_m",
            "resistivity_hot_ohm_m",
            "modulus_cold_Pa",
            "modulus_hot_Pa",
            "heat_capacity_J_kgK",
        )
        for key in positive:
            value = float(getattr(self, key))
            if not (value > 0 and math.isfinite(value)):
                raise SceneError(f"{key} = {value:g}: must be greater than 0 and finite")
        if not (self.latent_heat_J_kg >= 0 and math.isfinite(self.latent_heat_J_kg)):
            raise SceneError(f"latent_heat_J_kg = {self.latent_heat_J_kg:g}: must be at least 0")

    @property
    def area_m2(self) -> float:
        """Cross section."""
        return math.pi * self.diameter_m**2 / 4

    @property
    def mass_kg_m(self) -> float:
        """Mass of a metre."""
        return self.density_kg_m3 * self.area_m2

    def modulus_Pa(self, fraction: Values | float) -> Values:  # noqa: N802
        """E at a fraction of austenite."""
        share = np.asarray(fraction, dtype=float)
        return self.modulus_cold_Pa + share * (self.modulus_hot_Pa - self.modulus_cold_Pa)

    def resistance_ohm_m(self, fraction: Values | float) -> Values:
        """Resistance of a metre at a fraction of austenite."""
        share = np.asarray(fraction, dtype=float)
        cold, hot = self.resistivity_cold_ohm_m, self.resistivity_hot_ohm_m
        return (cold + share * (hot - cold)) / self.area_m2

    def stored_J_m(  # noqa: N802
        self,
        temperature_C: Values | float,  # noqa: N803
        fraction: Values | float,
    ) -> Values:
        """Heat in a metre of wire, from 0 °C and martensite."""
        there, share = np.asarray(temperature_C, dtype=float), np.asarray(fraction, dtype=float)
        return self.mass_kg_m * (self.heat_capacity_J_kgK * there + self.latent_heat_J_kg * share)


@dataclass(frozen=True, slots=True)
class Surroundings:
    """What cools the wire.

    Attributes
    ----------
    ambient_C : float
    convection_W_m2K : float
        h, heat given away per area of the wire's surface and difference of temperature; at least
        0, which is a wire that keeps all its heat.

    Raises
    ------
    SceneError
        When a number is out of its range.
    """

    ambient_C: float  # noqa: N815
    convection_W_m2K: float  # noqa: N815

    def __post_init__(self) -> None:
        if not (self.convection_W_m2K >= 0 and math.isfinite(self.convection_W_m2K)):
            raise SceneError(f"convection_W_m2K = {self.convection_W_m2K:g}: must be at least 0")
        if not -273.15 <= self.ambient_C < MELTING_C:
            raise SceneError(
                f"ambient_C = {self.ambient_C:g}: must be from absolute zero to below "
                f"{MELTING_C:g}, where the wire melts"
            )

    def loss_W_mK(self, wire: HeatedWire) -> float:  # noqa: N802
        """Heat that a metre of wire gives away per degree: h π d."""
        return self.convection_W_m2K * math.pi * wire.diameter_m


@dataclass(frozen=True, slots=True)
class WireState:
    """Temperature and fraction of austenite."""

    temperature_C: float  # noqa: N815
    fraction: float


def at_rest(wire: HeatedWire, ambient_C: float) -> WireState:  # noqa: N803
    """State of wire that was cold and has taken the temperature around it."""
    return WireState(ambient_C, float(wire.transformation.heated(ambient_C)))
