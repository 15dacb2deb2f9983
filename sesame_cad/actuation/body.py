"""Mass and resistance of an array, from its wire as it is laid and its fabric as it is cut."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from patterns.electrics import Drive, Supply
from sesame_cad.electrics_data import circuit_resistances_ohm
from sesame_cad.pipeline import wire_and_cut
from sesame_cad.specification import Specification


@dataclass(frozen=True)
class Body:
    """What an array is made of.

    Attributes
    ----------
    cells : int
    wire_length_mm : float
        Of all circuits, with tails.
    wire_g, fabric_g : float
        Masses; thread is left out.
    resistances_ohm : tuple of (float, float)
        Of each circuit, cold and hot.
    """

    cells: int
    wire_length_mm: float
    wire_g: float
    fabric_g: float
    resistances_ohm: tuple[tuple[float, float], ...]

    @property
    def mass_g(self) -> float:
        """Wire and fabric together."""
        return self.wire_g + self.fabric_g

    def drives(self, current_A: float) -> tuple[Drive, ...]:  # noqa: N803
        """Each circuit at a current."""
        return tuple(Drive(current_A, hot) for _, hot in self.resistances_ohm)

    def supply_faults(self, supply: Supply, current_A: float) -> tuple[str, ...]:  # noqa: N803
        """Say what a supply lacks to drive all circuits at the same time."""
        faults = [fault for drive in self.drives(current_A) for fault in drive.faults(supply)]
        total_A = len(self.resistances_ohm) * current_A  # noqa: N806
        if len(self.resistances_ohm) > 1 and total_A > supply.current_A * (1 + 1e-9):
            faults.append(
                f"all circuits at the same time need {total_A:.3g} A, and the supply gives "
                f"{supply.current_A:g} A"
            )
        return tuple(dict.fromkeys(faults))


def array_body(spec: Specification) -> Body:
    """Lay the wire, cut the fabric, and weigh both.

    Raises
    ------
    InputError
        When the array cannot be laid or cut.
    """
    circuit, outline = wire_and_cut(spec)
    wire_mm3 = circuit.wire_length_mm * pi * spec.wire.diameter_mm**2 / 4
    unstretched_mm2 = outline.fabric().area / (1 + spec.fabric.prestrain) ** 2
    return Body(
        cells=spec.layout.count,
        wire_length_mm=circuit.wire_length_mm,
        wire_g=wire_mm3 * spec.wire.density_g_cm3 / 1e3,
        fabric_g=unstretched_mm2 * spec.fabric.areal_density_g_m2 / 1e6,
        resistances_ohm=circuit_resistances_ohm(spec, circuit),
    )
