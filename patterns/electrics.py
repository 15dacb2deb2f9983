"""Resistance of the wire."""

from __future__ import annotations

from math import pi

from patterns.errors import PatternError

MARTENSITE_UOHM_CM = 80.0
"""Resistivity of cold nickel-titanium wire (makers' data sheets)."""

AUSTENITE_UOHM_CM = 100.0
"""Resistivity of hot nickel-titanium wire (makers' data sheets)."""

_OHM_MM_PER_UOHM_CM = 1e-5


def resistance_ohm(length_mm: float, wire_diameter_mm: float, resistivity_uohm_cm: float) -> float:
    """Resistance of a round wire, ``resistivity * length / area``.

    Raises
    ------
    PatternError
        When the diameter is not positive or another quantity is negative.
    """
    if wire_diameter_mm <= 0 or length_mm < 0 or resistivity_uohm_cm < 0:
        raise PatternError(
            f"no resistance for {length_mm:g} mm of {wire_diameter_mm:g} mm wire of "
            f"{resistivity_uohm_cm:g} uohm cm: "
            "the diameter must be positive, the others not negative"
        )
    area_mm2 = pi * wire_diameter_mm**2 / 4
    return resistivity_uohm_cm * _OHM_MM_PER_UOHM_CM * length_mm / area_mm2
