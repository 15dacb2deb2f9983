import numpy as np
import pytest

from solver.disc_basis import disc_basis, position_map, transfer
from solver.disc_functions import DiscFunction
from solver.shape import from_expansion
from solver.symmetry import DIAGONAL, HALF_TURN, displacements, mirror_class, saddle

R = np.array([0.3, 0.8, 1.0])
THETA = np.array([0.2, 1.1, 2.5])


@pytest.mark.parametrize(("degree", "count"), [(3, 5), (5, 10), (7, 16), (9, 24)])
def test_number_of_unknowns(degree, count):
    assert len(saddle(degree)) == count


def test_a_quarter_turn_of_the_saddle_turns_it_over():
    here = position_map(saddle(7), R, THETA)
    there = position_map(saddle(7), R, THETA + np.pi / 2)
    assert there[:, 0] == pytest.approx(-here[:, 1])
    assert there[:, 1] == pytest.approx(here[:, 0])
    assert there[:, 2] == pytest.approx(-here[:, 2])


@pytest.mark.parametrize("odd_in_x", [0, 1])
@pytest.mark.parametrize("odd_in_y", [0, 1])
def test_mirrors_keep_or_change_the_sign_of_a_class(odd_in_x, odd_in_y):
    unknowns = mirror_class(5, odd_in_x, odd_in_y)
    here = position_map(unknowns, R, THETA)
    for angle, mirror, odd in (
        (np.pi - THETA, np.array([-1, 1, 1]), odd_in_x),
        (-THETA, np.array([1, -1, 1]), odd_in_y),
    ):
        mirrored = mirror[:, None] * position_map(unknowns, R, angle)
        assert mirrored == pytest.approx((-1) ** odd * here)


def test_the_classes_together_are_all_polynomials():
    count = sum(len(mirror_class(5, x, y)) for x in (0, 1) for y in (0, 1))
    polynomials = (6 + 1) * (6 + 2) // 2
    assert count == 3 * polynomials


def test_oblique_shapes_and_a_turn_are_all_with_a_half_turn():
    """The turn of the flat disc about z is kept out, and nothing else is."""
    whole, part = disc_basis(5, HALF_TURN), disc_basis(5, "oblique")
    x, y = DiscFunction(1, 0, "cos"), DiscFunction(1, 0, "sin")
    turn = from_expansion(whole.unknowns, {(0, y): -1.0, (1, x): 1.0})
    into = transfer(part, whole)
    assert part.size == whole.size - 1
    assert np.linalg.matrix_rank(into) == part.size
    assert turn @ into == pytest.approx(np.zeros(part.size))


def test_diagonal_shapes_know_three_half_turns():
    unknowns = displacements(5, DIAGONAL)
    here = position_map(unknowns, R, THETA)
    for angle, turn in ((-THETA, [1, -1, -1]), (np.pi - THETA, [-1, 1, -1])):
        assert np.array(turn)[:, None] * position_map(unknowns, R, angle) == pytest.approx(here)
