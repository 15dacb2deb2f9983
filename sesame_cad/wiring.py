"""Which wire runs through which loops: from the specification to circuits."""

from __future__ import annotations

from patterns.circuit import Circuit
from patterns.electrics import resistance_ohm
from patterns.errors import PatternError
from patterns.groups import Group, touching_groups
from patterns.layout import Layout
from patterns.one_wire import one_wire
from patterns.parallel import Limits, most_circuits, parallel_groups
from patterns.terminals import Side
from patterns.wiring import several_wires
from sesame_cad.specification import Specification
from sesame_cad.specification.wiring_faults import circuit_loops


def wired(spec: Specification, layout: Layout) -> Circuit:
    """Run one wire through all loops, or one through each circuit's.

    Raises
    ------
    PatternError
        When a wire cannot run so, or no circuits can be found that the supply drives.
    """
    groups = _groups(spec, layout)
    tail = spec.stitching.tail_length_mm
    if groups is None:
        return one_wire(layout, spec.layout.side, tail)
    wires = spec.wires(len(groups))
    bends = (spec.stitching.smallest_bend_diameters * wire.diameter_mm for wire in wires)
    return several_wires(layout, groups, tail, tuple(bends))


def _groups(spec: Specification, layout: Layout) -> tuple[Group, ...] | None:
    """Give the loops of each circuit; none when one wire runs through all."""
    side, wiring = spec.layout.side, spec.wiring
    if wiring.circuits:
        return tuple(
            Group(
                one.name,
                circuit_loops(one, spec.layout),
                Side(one.terminals) if one.terminals else side,
                anywhere=one.terminals is None,
            )
            for one in wiring.circuits
        )
    if wiring.split == "none" or not layout.loops:
        return None
    if wiring.split == "auto":
        found = parallel_groups(layout, _limits(spec))
    else:
        pieces = enumerate(touching_groups(layout), start=1)
        found = tuple(Group(str(k), loops, side, anywhere=True) for k, loops in pieces)
    return found if len(found) > 1 else None


def _limits(spec: Specification) -> Limits:
    """Limits of circuits that the supply can drive."""
    wire, supply = spec.wire, spec.supply
    current = wire.design_current_A
    most = most_circuits(supply.current_A, current)
    if not most:
        raise PatternError(
            f"no circuit can be driven: the wire needs {current:.3g} A (wire.current_A), and the "
            f"supply gives {supply.current_A:g} A (supply.current_A)"
        )
    ohm_per_mm = resistance_ohm(1.0, wire.diameter_mm, wire.resistivity_hot_uohm_cm)
    return Limits(
        longest_mm=supply.voltage_V / current / ohm_per_mm,
        most=most,
        side=spec.layout.side,
        tail_length_mm=spec.stitching.tail_length_mm,
        smallest_bend_mm=spec.stitching.smallest_bend_diameters * wire.diameter_mm,
    )
