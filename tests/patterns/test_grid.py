import numpy as np
import pytest

from patterns.grid import serpentine, square_grid


@pytest.mark.parametrize(("rows", "columns"), [(1, 1), (1, 4), (3, 1), (3, 4), (4, 3)])
def test_grid_is_centred_and_touches_its_neighbours(rows, columns):
    layout = square_grid(rows, columns, 25.0)
    centre = np.array([(loop.x_mm, loop.y_mm) for loop in layout.loops])
    assert centre.mean(axis=0) == pytest.approx([0, 0])
    assert np.ptp(centre, axis=0) == pytest.approx([25 * (columns - 1), 25 * (rows - 1)])
    assert len(layout.contacts) == rows * (columns - 1) + columns * (rows - 1)


def test_first_loop_is_at_the_bottom_left():
    first = square_grid(2, 3, 10.0).loops[0]
    assert (first.x_mm, first.y_mm) == (-10, -5)


@pytest.mark.parametrize(("rows", "columns"), [(1, 1), (1, 4), (3, 1), (3, 4), (4, 3)])
def test_serpentine_goes_from_neighbour_to_neighbour_through_all_loops(rows, columns):
    order = np.array(serpentine(rows, columns))
    assert sorted(order.tolist()) == list(range(rows * columns))
    step = np.abs(np.diff(order // columns)) + np.abs(np.diff(order % columns))
    assert np.all(step == 1)
