"""Resistance of wire, the current that heats it, and whether a supply can drive it."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, log, pi

from patterns.errors import PatternError

MARTENSITE_UOHM_CM = 80.0
"""Resistivity of cold nickel-titanium wire (makers' data sheets)."""

AUSTENITE_UOHM_CM = 100.0
"""Resistivity of hot nickel-titanium wire (makers' data sheets)."""

ONE_SECOND_A = (
    (0.10, 0.20),
    (0.15, 0.41),
    (0.20, 0.66),
    (0.25, 1.05),
    (0.31, 1.5),
    (0.38, 2.25),
    (0.51, 4.0),
)
"""Diameter in mm of nickel-titanium wire, and the current in A that heats it through its transition
in one second in still air at room temperature (as makers of actuator wire give it; a start for
wire on fabric, which cools it more)."""

_OHM_MM_PER_UOHM_CM = 1e-5


@dataclass(frozen=True, slots=True)
class Supply:
    """What heats the wire: the most it gives in V and A."""

    voltage_V: float  # noqa: N815 - the unit's own spelling
    current_A: float  # noqa: N815 - the unit's own spelling


@dataclass(frozen=True, slots=True)
class Drive:
    """One circuit at its design current.

    Attributes
    ----------
    current_A : float
        The design current.
    resistance_ohm : float
        Of the hot wire, which resists more.
    """

    current_A: float  # noqa: N815 - the unit's own spelling
    resistance_ohm: float

    @property
    def voltage_V(self) -> float:  # noqa: N802 - the unit's own spelling
        """Ohm's law: I R."""
        return self.current_A * self.resistance_ohm

    @property
    def power_W(self) -> float:  # noqa: N802 - the unit's own spelling
        """Joule's law: I² R."""
        return self.current_A**2 * self.resistance_ohm

    def faults(self, supply: Supply) -> tuple[str, ...]:
        """Say what the supply lacks to drive this circuit alone; nothing when it can."""
        found: list[str] = []
        if self.voltage_V > supply.voltage_V * (1 + _ROUND_OFF):
            found.append(
                f"{self.current_A:.3g} A through {self.resistance_ohm:.3g} ohm (hot) need "
                f"{self.voltage_V:.3g} V, and the supply gives {supply.voltage_V:g} V"
            )
        if self.current_A > supply.current_A * (1 + _ROUND_OFF):
            found.append(
                f"the wire needs {self.current_A:.3g} A, and the supply gives "
                f"{supply.current_A:g} A"
            )
        return tuple(found)


_ROUND_OFF = 1e-9


def one_second_current_A(wire_diameter_mm: float) -> float:  # noqa: N802 - the unit's own spelling
    """Current that heats wire in one second: `ONE_SECOND_A`, a power law from row to row.

    Beyond the table the power law of its first or last two rows goes on.

    Raises
    ------
    PatternError
        When the diameter is not positive.
    """
    if wire_diameter_mm <= 0:
        raise PatternError(f"no current for wire of {wire_diameter_mm:g} mm")
    last = len(ONE_SECOND_A) - 2
    row = sum(wire_diameter_mm >= diameter for diameter, _ in ONE_SECOND_A) - 1
    (thin, low), (thick, high) = ONE_SECOND_A[min(max(row, 0), last) :][:2]
    power = log(high / low) / log(thick / thin)
    return low * exp(power * log(wire_diameter_mm / thin))


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
