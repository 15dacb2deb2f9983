"""The net that the stitches alone make is the one that was designed."""

from __future__ import annotations

from patterns.circuit import Circuit
from patterns.meetings import Meeting
from patterns.net import SewnNet
from patterns.violation import Violation

LARGEST_DIFFERENCE = 0.03
"""Of the resistance of a wire as sewn from that as designed: it is rebuilt to a fraction of 1 %."""

_RULE = "net"


def check_net(circuit: Circuit, net: SewnNet) -> tuple[Violation, ...]:
    """Every wire leads from its one terminal to its other, past no short, with its resistance.

    Parameters
    ----------
    circuit
        As designed.
    net
        As rebuilt from the stitches, with wires of the design's kinds.

    Returns
    -------
    tuple of Violation
        Empty when all is well; each short with its place and what it does.
    """
    designed = len(circuit.parts)
    if len(net.wires) != designed:
        message = f"the stitches lay {len(net.wires)} separate wires instead of {designed}; one"
        x, y = net.wires[-1][0].points_mm[0].tolist() if net.wires else (0.0, 0.0)
        return (Violation(_RULE, f"{message} begins", x, y),)
    found = [_short(circuit, net, short) for short in net.shorts]
    return (*found, *_differences(circuit, net))


def _short(circuit: Circuit, net: SewnNet, short: Meeting) -> Violation:
    under, over = (net.wire_of[block][0] for block in (short.under, short.over))
    if under == over:
        what = f"two passes of the wire of {_named(circuit, under)} touch"
    else:
        what = (
            f"the wires of {_named(circuit, under)} and {_named(circuit, over)} touch, which "
            "bridges their terminals"
        )
    message = f"short circuit in the stitches: {what} and no cover lies between them"
    return Violation(_RULE, message, short.x_mm, short.y_mm, short.over)


def _differences(circuit: Circuit, net: SewnNet) -> list[Violation]:
    """Resistances between terminals that are not as designed."""
    found: list[Violation] = []
    for wire, (part, kind) in enumerate(zip(circuit.parts, net.kinds, strict=True)):
        designed, sewn = part.wire_length_mm * kind.ohm_per_mm, net.resistance_ohm(wire)
        if sewn is None or abs(sewn - designed) <= LARGEST_DIFFERENCE * designed:
            continue
        x, y = net.wires[wire][0].points_mm[0].tolist()
        message = (
            f"between the terminals of {_named(circuit, wire)} the stitches make {sewn:.3f} ohm, "
            f"and {designed:.3f} ohm are designed; it begins"
        )
        found.append(Violation(_RULE, message, x, y, net.wires[wire][0].block))
    return found


def _named(circuit: Circuit, part: int) -> str:
    return f"circuit {circuit.part_names[part]}" if len(circuit.parts) > 1 else "the circuit"
