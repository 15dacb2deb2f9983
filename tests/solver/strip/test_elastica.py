import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from solver.strip.elastica import Elastica
from solver.strip.ends import Ends

SHORTENINGS = [1e-6, 1e-2, 0.3, 0.9]


def _integral(function):
    return quad(function, 0, 1, epsabs=1e-13, epsrel=1e-12, limit=200)[0]


@pytest.mark.parametrize("mode", [1, 2])
@pytest.mark.parametrize("shortening", SHORTENINGS)
def test_headings_have_the_chord_and_the_energy(shortening, mode):
    found, step = Elastica(shortening, mode), 1e-5

    def curvature(s):
        a, b = found.heading(np.array([s - step, s + step]))
        return (b - a) / (2 * step)

    lost = _integral(lambda s: 2 * np.sin(found.heading(np.array([s]))[0] / 2) ** 2)
    assert lost == pytest.approx(shortening, rel=1e-9)
    rise = _integral(lambda s: np.sin(found.heading(np.array([s]))[0]))
    assert rise == pytest.approx(0, abs=1e-9)
    energy = _integral(lambda s: curvature(s) ** 2 / 2)
    assert energy == pytest.approx(found.energy, rel=1e-7)


def test_clamped_heading_lies_along_the_chord_at_its_ends():
    heading = Elastica(0.3, 2).heading(np.array([0.0, 0.25, 0.5, 1.0]), Ends.CLAMPED)
    assert heading[[0, 2, 3]] == pytest.approx(0, abs=1e-12)
    assert heading[1] > 0


@settings(deadline=None, max_examples=30)
@given(st.floats(1e-3, 0.95), st.integers(1, 3))
def test_the_force_is_the_energys_slope(shortening, mode):
    step = 1e-4 * shortening
    high, low = (Elastica(shortening + d, mode).energy for d in (step, -step))
    assert (high - low) / (2 * step) == pytest.approx(Elastica(shortening, mode).force, rel=1e-6)


def test_eulers_load_is_the_limit():
    assert Elastica(1e-10).force == pytest.approx(np.pi**2, rel=1e-9)
    # P = π² (1 + δ/2 + …)
    excess = [Elastica(d).force / np.pi**2 - 1 for d in (1e-3, 1e-4)]
    assert excess[0] / excess[1] == pytest.approx(10, rel=1e-2)


def test_the_ends_meet_at_the_known_angle():
    """Modulus k = 0.9089, at which 2E = K (Love 1927, section 263: an angle of 130.7°)."""
    assert np.degrees(2 * np.arcsin(np.sqrt(Elastica(1.0).parameter))) == pytest.approx(
        130.71, abs=0.01
    )
