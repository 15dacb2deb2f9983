"""What the choice of the tree can change, and what it cannot."""

from itertools import combinations

import networkx as nx
import pytest

from patterns.grid import square_grid
from patterns.lattice import Lattice, lattice_loops
from patterns.layout import Layout, tangent_layout
from patterns.spanning_tree import fewest_stages_tree
from patterns.tangent_switch import single_circuit
from patterns.terminals import Side, terminals
from patterns.touching import touching


def spanning_trees(layout: Layout) -> list[tuple[int, ...]]:
    ends = [(contact.first, contact.second) for contact in layout.contacts]
    size = len(layout.loops) - 1
    return [
        chosen
        for chosen in combinations(range(len(ends)), size)
        if nx.is_tree(nx.Graph([ends[k] for k in chosen]))
        and len({loop for k in chosen for loop in ends[k]}) == len(layout.loops)
    ]


@pytest.mark.parametrize(
    ("layout", "count"),
    [
        (square_grid(2, 3, 25.0), 15),
        (square_grid(3, 3, 25.0), 192),
        (tangent_layout(lattice_loops(Lattice.BRICK, 2, 3, 25.0)), 55),
    ],
)
def test_no_tree_needs_fewer_covers_or_less_wire(layout: Layout, count: int) -> None:
    loop, start = terminals(layout.loops, Side.CORNER)
    trees = spanning_trees(layout)
    assert len(trees) == count  # Kirchhoff's matrix-tree theorem
    circuits = [single_circuit(layout, tree, loop, start, 40.0) for tree in trees]
    assert {len(circuit.crossings) for circuit in circuits} == {len(layout.contacts) + 1}
    lengths = [circuit.wire_length_mm for circuit in circuits]
    assert max(lengths) - min(lengths) < 1e-9
    chosen = fewest_stages_tree(touching(layout), loop, start)
    stages = len(single_circuit(layout, chosen, loop, start, 40.0).stages)
    assert stages == min(len(circuit.stages) for circuit in circuits)
