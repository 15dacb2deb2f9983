"""The circuits and what drives them, as plain data."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from patterns.circuit import Circuit, CrossingKind
from patterns.electrics import Drive, Supply, resistance_ohm
from patterns.net import SewnNet
from sesame_cad.pipeline import Pattern
from sesame_cad.specification import Specification

Data = dict[str, Any]


def in_parallel_ohm(resistances_ohm: Iterable[float]) -> float:
    """Resistance of circuits side by side; a single one's own, to the last digit."""
    own = list(resistances_ohm)
    return own[0] if len(own) == 1 else 1 / sum(1 / one for one in own)


def circuit_resistances_ohm(
    spec: Specification, circuit: Circuit
) -> tuple[tuple[float, float], ...]:
    """Resistance of each circuit with its tails, cold and hot."""
    wires = spec.wires(len(circuit.parts))
    return tuple(
        (
            resistance_ohm(part.wire_length_mm, wire.diameter_mm, wire.resistivity_cold_uohm_cm),
            resistance_ohm(part.wire_length_mm, wire.diameter_mm, wire.resistivity_hot_uohm_cm),
        )
        for part, wire in zip(circuit.parts, wires, strict=True)
    )


def circuits_data(spec: Specification, laid: Pattern) -> list[Data]:
    """Keys of each circuit, in laying order; contacts are counted where they are passed last."""
    circuit = laid.circuit
    insulated = set(laid.covered)
    resistances = circuit_resistances_ohm(spec, circuit)
    wires, names = spec.wires(len(circuit.parts)), circuit.part_names
    found: list[Data] = []
    for k, part in enumerate(circuit.parts):
        begin, end = circuit.span_mm(k)
        crossings = [c for c in circuit.crossings if begin < c.second_mm < end]
        contacts = [c for c in crossings if c.kind is CrossingKind.CONTACT]
        (starts, _), (ends, _) = part.wire.at(0.0), part.wire.at(part.wire_length_mm)
        found.append(
            {
                "name": names[k],
                "loops": list(circuit.part_loops[k]),
                "wire_diameter_mm": wires[k].diameter_mm,
                "wire_length_mm": part.wire_length_mm,
                "resistance_ohm_cold": resistances[k][0],
                "resistance_ohm_hot": resistances[k][1],
                "terminals_mm": [starts[0].tolist(), ends[0].tolist()],
                "stages": len(part.stages),
                "contacts": len(contacts),
                "covered_contacts": sum(c in insulated for c in contacts),
                "contacts_with_earlier_circuits": sum(c.first_mm < begin for c in contacts),
            }
        )
    return found


def net_data(net: SewnNet) -> Data:
    """Keys of the electrical net that the stitches alone make."""
    return {
        "wires": len(net.wires),
        "contacts": len(net.meetings),
        "shorts": len(net.shorts),
        "resistance_ohm_cold": [net.resistance_ohm(wire) for wire in range(len(net.wires))],
    }


def electrics_data(spec: Specification, laid: Pattern) -> Data:
    """Keys of what the supply must give, to each circuit and to all at the same time."""
    circuit = laid.circuit
    supply = Supply(spec.supply.voltage_V, spec.supply.current_A)
    wires = spec.wires(len(circuit.parts))
    resistances = circuit_resistances_ohm(spec, circuit)
    drives = [
        Drive(wire.design_current_A, hot) for wire, (_, hot) in zip(wires, resistances, strict=True)
    ]
    total = sum(drive.current_A for drive in drives)
    warnings = [
        f"the supply cannot drive {_named(circuit, name)}: {fault}"
        for name, drive in zip(circuit.part_names, drives, strict=True)
        for fault in drive.faults(supply)
    ]
    together = total <= supply.current_A * (1 + 1e-9)
    if not together and len(drives) > 1:
        warnings.append(
            f"the circuits cannot be driven at the same time: they need {total:.3g} A together, "
            f"and the supply gives {supply.current_A:g} A"
        )
    return {
        "supply_voltage_V": supply.voltage_V,
        "supply_current_A": supply.current_A,
        "circuits": [
            {
                "name": name,
                "current_A": drive.current_A,
                "voltage_V": drive.voltage_V,
                "power_W": drive.power_W,
                "drivable": not drive.faults(supply),
            }
            for name, drive in zip(circuit.part_names, drives, strict=True)
        ],
        "total_current_A": total,
        "total_power_W": sum(drive.power_W for drive in drives),
        "drivable_together": together and not any(drive.faults(supply) for drive in drives),
        "sewn_net": net_data(laid.net),
        "warnings": warnings,
    }


def _named(circuit: Circuit, name: str) -> str:
    return f"circuit {name}" if len(circuit.parts) > 1 else "the array"
