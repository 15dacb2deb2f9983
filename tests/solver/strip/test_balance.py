import numpy as np
import pytest

from solver.errors import NotConvergedError
from solver.strip.balance import Point, at_couple
from solver.strip.basis import strip_basis
from solver.strip.elastica import Elastica
from solver.strip.ends import Ends
from solver.strip.phase import amplitudes, at_rest, first_state, holding_phase

COVERED = (0.1, 0.5)


def _balance(ends=Ends.PINNED, shortening=0.2, degree=24):
    return at_rest(strip_basis(COVERED, ends, degree), shortening)


@pytest.mark.parametrize("ends", list(Ends))
def test_derivatives_against_differences(ends):
    balance = _balance(ends, degree=5)
    held = holding_phase(balance, amplitudes(balance.basis, ends), 0.7)
    rng, step = np.random.default_rng(3), 1e-6
    n = balance.basis.size
    z = rng.normal(size=n + 4)
    matrix = held.residual(Point(z[:n], z[n:-1], z[-1]))[1]

    def residual(z):
        return held.residual(Point(z[:n], z[n:-1], z[-1]))[0]

    numeric = np.array(
        [(residual(z + d) - residual(z - d)) / (2 * step) for d in step * np.eye(n + 4)]
    ).T
    assert matrix == pytest.approx(numeric[:, :-1], abs=1e-6)
    assert matrix == pytest.approx(matrix.T, abs=1e-12)
    assert held.couple_slope == pytest.approx(numeric[:, -1], abs=1e-6)


def test_the_residual_is_the_energys_slope():
    balance, step = _balance(degree=5), 1e-6
    n = balance.basis.size
    x = np.random.default_rng(4).normal(size=n)
    slope = balance.residual(Point(x, np.zeros(2), 0.6))[0][:n]
    numeric = [
        (balance.energy(x + d, 0.6) - balance.energy(x - d, 0.6)) / (2 * step)
        for d in step * np.eye(n)
    ]
    assert slope == pytest.approx(np.array(numeric), abs=1e-6)


@pytest.mark.parametrize("ends", list(Ends))
def test_the_force_is_the_energys_slope_by_the_shortening(ends):
    """dU/dc = −P, under a couple too."""

    def solved(shortening):
        balance = _balance(ends, shortening)
        point = at_couple(balance, first_state(balance, ends), 0.8)
        return balance.energy(point.x, 0.8), point.force[0]

    step = 1e-4
    slope = (solved(0.2 + step)[0] - solved(0.2 - step)[0]) / (2 * step)
    assert slope == pytest.approx(solved(0.2)[1], rel=1e-6)


def test_the_turn_is_the_energys_slope_by_the_couple():
    balance = _balance()
    start, step = first_state(balance, Ends.PINNED), 1e-4
    low, at, high = (at_couple(balance, start, 0.8 + d) for d in (-step, 0, step))
    slope = (balance.energy(high.x, high.couple) - balance.energy(low.x, low.couple)) / (2 * step)
    assert slope == pytest.approx(-balance.basis.turn @ at.x, rel=1e-6)


def test_no_force_across_the_chord_between_pinned_ends():
    balance = _balance()
    point = at_couple(balance, first_state(balance, Ends.PINNED), 0.8)
    assert point.force[1] == pytest.approx(0, abs=1e-10)


@pytest.mark.parametrize("shortening", [1e-9, 1e-6, 1e-2, 0.5, 0.9, 0.99])
@pytest.mark.parametrize(("ends", "mode"), [(Ends.PINNED, 1), (Ends.CLAMPED, 2)])
def test_states_in_closed_form(shortening, ends, mode):
    balance, exact = _balance(ends, shortening), Elastica(shortening, mode)
    state = first_state(balance, ends)
    assert balance.energy(state.x, 0.0) == pytest.approx(exact.energy, rel=1e-9)
    assert state.force[0] == pytest.approx(exact.force, rel=1e-9)
    heading = balance.basis.heading @ state.x
    assert heading == pytest.approx(exact.heading(balance.basis.arc, ends), abs=1e-7)
    assert balance.lowest_eigenvalue(state) > 0


def test_lowest_eigenvalue_of_the_nearly_straight_strip():
    """P2 − P1 times the square of the second mode's wave number, over the latter: 3 π²."""
    balance = _balance(shortening=1e-8)
    state = first_state(balance, Ends.PINNED)
    assert balance.lowest_eigenvalue(state) == pytest.approx(3 * np.pi**2, rel=1e-6)


def test_a_hopeless_start_is_refused():
    balance = _balance()
    with pytest.raises(NotConvergedError, match="did not come to balance"):
        at_couple(balance, first_state(balance, Ends.PINNED), 1e4)
