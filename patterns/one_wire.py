"""One wire through any set of tangent loops, the tree and the terminals chosen well."""

from __future__ import annotations

from patterns.circuit import Circuit
from patterns.errors import PatternError
from patterns.layout import Layout, check_tangent
from patterns.spanning_tree import fewest_stages_tree
from patterns.tangent_switch import single_circuit
from patterns.terminals import Side, terminals
from patterns.touching import touching


def one_wire(layout: Layout, side: Side, tail_length_mm: float) -> Circuit:
    """Run one wire through all loops of a layout in as few stages as are found.

    Parameters
    ----------
    side
        Where the tails leave.
    tail_length_mm
        Length of each tail.

    Raises
    ------
    PatternError
        When there is no loop, loops nearly touch or are apart from the others, or the tails cannot
        leave on that side.
    """
    if not layout.loops:
        raise PatternError("there is no loop: nothing is left of the array")
    check_tangent(layout)
    loop, start_rad = terminals(layout.loops, side)
    switches = fewest_stages_tree(touching(layout), loop, start_rad)
    return single_circuit(layout, switches, loop, start_rad, tail_length_mm)
