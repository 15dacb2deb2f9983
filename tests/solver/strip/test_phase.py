import numpy as np
import pytest

from solver.strip.basis import strip_basis
from solver.strip.elastica import Elastica
from solver.strip.ends import Ends, buckling_loads
from solver.strip.phase import amplitudes, at_rest, first_state, phase_of, saddles


def _solved(shortening, ends=Ends.PINNED):
    balance = at_rest(strip_basis((0.0, 0.5), ends, 24), shortening)
    state = first_state(balance, ends)
    return balance, state, saddles(balance, ends, state)


@pytest.mark.parametrize("shortening", [1e-9, 1e-6, 1e-2, 0.5, 0.9, 0.98917])
def test_saddles_in_closed_form(shortening):
    balance, _, found = _solved(shortening)
    exact = Elastica(shortening, 2)
    for saddle in found:
        assert balance.energy(saddle.x, 0.0) == pytest.approx(exact.energy, rel=1e-9)
        assert saddle.force[0] == pytest.approx(exact.force, rel=1e-9)
        assert balance.lowest_eigenvalue(saddle) < 0


@pytest.mark.parametrize("ends", list(Ends))
def test_saddles_are_mirror_images(ends):
    _, _, (one, other) = _solved(0.1, ends)
    assert one.x == pytest.approx(-other.x, abs=1e-9)


@pytest.mark.parametrize("ends", list(Ends))
def test_the_barrier_of_the_nearly_straight_strip(ends):
    """It tends to (P2 − P1) δ, for pinned ends 3π² δ, with an error of the order of δ."""
    first, second = buckling_loads(ends)
    off = []
    for shortening in (1e-2, 1e-3):
        balance, state, (saddle, _) = _solved(shortening, ends)
        barrier = balance.energy(saddle.x, 0.0) - balance.energy(state.x, 0.0)
        off.append(barrier / ((second - first) * shortening) - 1)
    assert abs(off[1]) < 1e-3
    assert off[0] / off[1] == pytest.approx(10, rel=0.1)


@pytest.mark.parametrize("ends", list(Ends))
def test_phases_of_states(ends):
    balance, state, (one, other) = _solved(1e-6, ends)
    modes = amplitudes(balance.basis, ends)
    phases = [phase_of(modes, point.x) for point in (state, one, other)]
    assert phases == pytest.approx([0, np.pi / 2, -np.pi / 2], abs=1e-6)
    assert np.sum((modes @ state.x) ** 2) / 2 == pytest.approx(1e-6, rel=1e-5)
