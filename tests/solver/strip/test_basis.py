import numpy as np
import pytest

from solver.strip.basis import strip_basis
from solver.strip.ends import Ends
from solver.strip.phase import at_rest, first_state, saddles

COVERED = (0.0, 0.5)


@pytest.mark.parametrize("covered", [COVERED, (0.1, 0.4), (0.5, 1.0)])
@pytest.mark.parametrize("ends", list(Ends))
def test_curvature_is_the_slope_of_the_heading(ends, covered):
    basis, step = strip_basis(covered, ends, 6), 1e-6
    arc = np.array([0.05, 0.23, 0.45, 0.61, 0.97])
    slope = (basis.headings_at(arc + step) - basis.headings_at(arc - step)) / (2 * step)
    assert basis.curvature_at(arc) == pytest.approx(slope, abs=1e-6)


@pytest.mark.parametrize("ends", list(Ends))
def test_tables_agree_with_headings_at_points(ends):
    basis = strip_basis((0.1, 0.4), ends, 6)
    assert basis.headings_at(basis.arc) == pytest.approx(basis.heading, abs=1e-13)
    begin, end = basis.headings_at(np.array([0.1, 0.4]))
    assert end - begin == pytest.approx(basis.turn, abs=1e-13)
    curvature = basis.curvature_at(basis.arc)
    assert curvature.T @ (basis.weight[:, None] * curvature) == pytest.approx(
        basis.stiffness, abs=1e-11
    )


def test_clamped_headings_vanish_at_both_ends():
    basis = strip_basis(COVERED, Ends.CLAMPED, 6)
    assert basis.headings_at(np.array([0.0, 1.0])) == pytest.approx(0, abs=1e-12)


def test_the_error_falls_exponentially_with_the_degree():
    """By more than a factor of 20 for every two degrees, down to rounding."""
    energies = []
    for degree in (4, 6, 8, 10, 30):
        balance = at_rest(strip_basis(COVERED, Ends.PINNED, degree), 0.5)
        fine = saddles(balance, Ends.PINNED, first_state(balance, Ends.PINNED))[0]
        energies.append(balance.energy(fine.x, 0.0))
    errors = np.abs(np.array(energies[:-1]) / energies[-1] - 1)
    assert np.all(errors[1:] < errors[:-1] / 20)
    assert errors[-1] < 1e-6


def test_the_tail_tells_of_too_few_polynomials():
    def tail(degree):
        basis = strip_basis(COVERED, Ends.PINNED, degree)
        return basis.tail(first_state(at_rest(basis, 0.5), Ends.PINNED).x)

    assert tail(4) > 1e-4
    assert tail(24) < 1e-10
