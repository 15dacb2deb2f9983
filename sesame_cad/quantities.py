"""Quantities as people write them: a number and a unit, turned into the unit of a key."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal
from types import MappingProxyType

LONGEST_TEXT = 60
"""Characters; more is not a quantity."""

_QUANTITY = re.compile(r"([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,2})?)\s*(\D.*)?")


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of quantity and the units in which it may be written.

    Attributes
    ----------
    what : str
        "a length", for messages.
    units : mapping of str to (factor, offset)
        Value in the wanted unit = number × factor + offset, exact in decimals.
    example : str
        A quantity written as it should be.
    """

    what: str
    units: Mapping[str, tuple[str, str]]
    example: str

    def parse(self, text: str) -> float:
        """Turn text into the wanted unit.

        Raises
        ------
        ValueError
            With one line that says which units are allowed.
        """
        found = _QUANTITY.fullmatch(text.strip()) if len(text) <= LONGEST_TEXT else None
        if found is None:
            raise ValueError(f"{text[:LONGEST_TEXT]!r} is not {self.what}: write {self.example}")
        number, unit = found[1], (found[2] or "").strip()
        if unit not in self.units:
            raise ValueError(self._wrong_unit(text, number, unit))
        factor, offset = self.units[unit]
        return float(Decimal(number) * Decimal(factor) + Decimal(offset))

    def _wrong_unit(self, text: str, number: str, unit: str) -> str:
        allowed = [name for name in self.units if name]
        if not unit:
            return f"{text!r} has no unit: write {number}{allowed[0]} ({', '.join(allowed)})"
        if not allowed:
            return f"{text!r} must be a number without a unit"
        return f"{text!r} is not {self.what}: allowed units are {', '.join(allowed)}"


def _kind(what: str, example: str, **units: str) -> Kind:
    return Kind(what, MappingProxyType({unit: (by, "0") for unit, by in units.items()}), example)


def _pressure(wanted_power: int, example: str) -> Kind:
    powers = {"Pa": 0, "kPa": 3, "MPa": 6, "GPa": 9}
    ordered = sorted(powers, key=lambda unit: powers[unit] != wanted_power)
    units = {unit: f"1e{powers[unit] - wanted_power}" for unit in ordered}
    return _kind("a modulus", example, **units)


LENGTH_MM = _kind(
    "a length",
    "40mm",
    **{"mm": "1", "cm": "10", "m": "1000", "um": "0.001", "µm": "0.001", "in": "25.4"},
)
MODULUS_KPA = _pressure(3, "700kPa")
MODULUS_GPA = _pressure(9, "28GPa")
FORCE_N = _kind("a force", "0.5N", **{"N": "1", "mN": "0.001", "kN": "1000"})
STRAIN = _kind("a strain", "0.3 or 30%", **{"": "1", "%": "0.01"})
NUMBER = _kind("a number", "0.45", **{"": "1"})
RESISTIVITY_UOHM_CM = _kind(
    "a resistivity", "80 uohm cm", **{"uohm cm": "1", "µΩ cm": "1", "uohm m": "100", "ohm m": "1e8"}
)
DENSITY_G_CM3 = _kind(
    "a density", "6.45 g/cm3", **{"g/cm3": "1", "g/cm³": "1", "kg/m3": "0.001", "kg/m³": "0.001"}
)
AREAL_DENSITY_G_M2 = _kind(
    "a mass per area",
    "190 g/m2",
    **{"g/m2": "1", "g/m²": "1", "gsm": "1", "kg/m2": "1000", "kg/m²": "1000"},
)
TEMPERATURE_C = Kind(
    "a temperature",
    MappingProxyType(
        {"C": ("1", "0"), "°C": ("1", "0"), "degC": ("1", "0"), "K": ("1", "-273.15")}
    ),
    "40C",
)
MASS_G = _kind("a mass", "40g", **{"g": "1", "kg": "1000", "mg": "0.001"})
TIME_S = _kind("a time", "10s", **{"s": "1", "ms": "0.001", "min": "60"})
CURRENT_A = _kind("a current", "1.3A", **{"A": "1", "mA": "0.001"})

_BY_ENDING: Mapping[str, Kind] = MappingProxyType(
    {
        "_mm": LENGTH_MM,
        "_N": FORCE_N,
        "_kPa": MODULUS_KPA,
        "_GPa": MODULUS_GPA,
        "_C": TEMPERATURE_C,
        "_uohm_cm": RESISTIVITY_UOHM_CM,
        "_g_cm3": DENSITY_G_CM3,
        "_g_m2": AREAL_DENSITY_G_M2,
        "prestrain": STRAIN,
    }
)


_RANGE_UNIT = re.compile(r"[^\d.eE+-].*$")


def parse_range(kind: Kind, text: str) -> tuple[float, float]:
    """Read two quantities, "15..45mm" or "1.5cm..45mm", the first below the second.

    Raises
    ------
    ValueError
        With one line that says how to write it.
    """
    low, dots, high = text.partition("..")
    unit = _RANGE_UNIT.search(high.strip())
    if not dots:
        raise ValueError(f"{text!r} is not a range: write 2 of {kind.example} with .. between them")
    if unit and not _RANGE_UNIT.search(low.strip()):
        low = f"{low.strip()}{unit[0]}"
    first, second = kind.parse(low), kind.parse(high)
    if not first < second:
        raise ValueError(f"{text!r}: the first must be less than the second")
    return first, second


def kind_of(key: str) -> Kind:
    """Find the kind of quantity a key holds from the unit in its name; a plain number by default.

    Parameters
    ----------
    key
        With or without its section: ``layout.loop_diameter_mm``.
    """
    return next((kind for ending, kind in _BY_ENDING.items() if key.endswith(ending)), NUMBER)


def parse_quantity(key: str, text: str) -> float:
    """Turn text into the unit of a key: ``("wire.modulus_hot_GPa", "75000 MPa")`` gives 75.

    Raises
    ------
    ValueError
        With one line that says how to write it.
    """
    return kind_of(key).parse(text)


def parse_length_mm(text: str) -> float:
    """Read a length with its unit, in mm: "40mm", "4 cm", "0.04 m", "0.5in".

    Raises
    ------
    ValueError
        With one line that says how to write it; a number without a unit is refused.
    """
    return LENGTH_MM.parse(text)


def parse_modulus_kpa(text: str) -> float:
    """Read an elastic modulus with its unit, in kPa; faults as in `parse_length_mm`."""
    return MODULUS_KPA.parse(text)


def parse_modulus_gpa(text: str) -> float:
    """Read an elastic modulus with its unit, in GPa; faults as in `parse_length_mm`."""
    return MODULUS_GPA.parse(text)


def parse_strain(text: str) -> float:
    """Read a strain, "0.3" or "30%", as a ratio; faults as in `parse_length_mm`."""
    return STRAIN.parse(text)


def parse_temperature_c(text: str) -> float:
    """Read a temperature, "40C" or "313.15 K", in °C; faults as in `parse_length_mm`."""
    return TEMPERATURE_C.parse(text)
