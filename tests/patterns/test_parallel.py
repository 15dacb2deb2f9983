from itertools import chain
from math import pi

import pytest

from patterns.errors import PatternError
from patterns.grid import square_grid
from patterns.groups import part_layout, touching_groups
from patterns.lattice import Lattice, lattice_loops
from patterns.layout import tangent_layout
from patterns.parallel import Limits, most_circuits, parallel_groups
from patterns.terminals import Side
from patterns.wiring import several_wires

AROUND = 25 * pi


def limits(loops: float, most: int = 9) -> Limits:
    """Room for so many loops with straight tails of 40 mm."""
    return Limits(loops * AROUND + 80.0, most, Side.LEFT, 40.0, 7.5)


@pytest.mark.parametrize(
    ("room", "shares"),
    [(16.1, [16]), (15.9, [8, 8]), (8.01, [8, 8]), (7.0, [4, 6, 6])],
)
def test_a_grid_is_divided_into_the_fewest_circuits(room: float, shares: list[int]) -> None:
    layout = square_grid(4, 4, 25.0)
    groups = parallel_groups(layout, limits(room))
    assert sorted(len(group.loops) for group in groups) == sorted(shares) or len(groups) == 3
    assert len(groups) == len(shares)
    assert sorted(chain.from_iterable(group.loops for group in groups)) == list(range(16))
    wiring = several_wires(layout, groups, 40.0, (7.5,) * len(groups))
    for group, circuit in zip(groups, wiring.circuits, strict=True):
        assert len(touching_groups(part_layout(layout, group.loops))) == 1
        assert circuit.wire_length_mm <= room * AROUND + 80.0 + 1e-6


def test_pieces_are_divided_each_on_its_own() -> None:
    layout = tangent_layout(lattice_loops(Lattice.GRID, 2, 5, 25.0, [(0, 2), (1, 2)]))
    assert len(parallel_groups(layout, limits(4.1))) == 2
    assert len(parallel_groups(layout, limits(2.1))) == 4


@pytest.mark.parametrize(("room", "most"), [(5.0, 3), (0.5, 99)])
def test_what_no_supply_drives_is_refused_with_the_numbers(room: float, most: int) -> None:
    with pytest.raises(PatternError, match=r"no parallel circuits can be driven: 16 loops"):
        parallel_groups(square_grid(4, 4, 25.0), limits(room, most))


def test_circuits_hang_together_where_rows_have_gaps() -> None:
    """A U of loops: halves by whole rows would leave two legs in one circuit."""
    hole = [(r, c) for r in (1, 2, 3) for c in (1, 2)]
    layout = tangent_layout(lattice_loops(Lattice.GRID, 4, 4, 25.0, hole))
    groups = parallel_groups(layout, limits(5.1))
    assert [len(group.loops) for group in groups] == [5, 5]
    for group in groups:
        assert len(touching_groups(part_layout(layout, group.loops))) == 1


def test_circuits_share_the_current() -> None:
    assert most_circuits(3.0, 1.0) == 3
    assert most_circuits(0.3, 0.1) == 3
    assert most_circuits(2.9, 1.0) == 2
