import numpy as np
import pytest
from scipy.integrate import cumulative_simpson

from solver.strip.balance import at_couple
from solver.strip.basis import strip_basis
from solver.strip.elastica import Elastica
from solver.strip.ends import Ends
from solver.strip.phase import at_rest, first_state, saddles
from solver.strip.scene import StripScene
from solver.strip.state import Side, inflections, positions, strip_state

SCENE = StripScene(0.12, 0.1, 0.02, 0.38e-3, covered=(0.1, 0.4))


def _solved(couple):
    balance = at_rest(strip_basis(SCENE.covered, SCENE.ends, 24), SCENE.shortening)
    return balance, at_couple(balance, first_state(balance, Ends.PINNED), couple)


def test_points_are_the_integral_of_the_heading():
    balance, point = _solved(1.5)
    arc = np.linspace(0, 1, 4001)
    heading = balance.basis.headings_at(arc) @ point.x
    found = positions(balance.basis, point.x, arc)
    for axis, values in enumerate((np.cos(heading), np.sin(heading))):
        assert found[:, axis] == pytest.approx(
            cumulative_simpson(values, x=arc, initial=0), abs=1e-9
        )


def test_a_state_in_si_units():
    balance, point = _solved(0.0)
    state, exact = strip_state(SCENE, balance, point, Side.UP), Elastica(SCENE.shortening)
    unit = SCENE.stiffness_N_m2 / SCENE.length_m
    assert state.energy_J == state.bending_J == pytest.approx(unit * exact.energy, rel=1e-9)
    assert state.force_N == pytest.approx(unit / SCENE.length_m * exact.force, rel=1e-9)
    assert state.points_m[-1] == pytest.approx([SCENE.constraint_m, 0], abs=1e-12)
    steps = np.linalg.norm(np.diff(state.points_m, axis=0), axis=1)
    assert steps.sum() == pytest.approx(SCENE.length_m, rel=1e-4)
    # between pinned ends the height halfway is 2 k / β
    height = 2 * np.sqrt(exact.parameter) / exact.beta * SCENE.length_m
    assert state.height_m == pytest.approx(height, rel=1e-9)
    largest = 2 * np.sqrt(exact.parameter) * exact.beta / SCENE.length_m
    assert -state.curvatures_per_m.min() == pytest.approx(largest, rel=1e-9)
    assert state.inflections_m == ()


def test_energy_under_a_couple():
    balance, point = _solved(1.5)
    state = strip_state(SCENE, balance, point, Side.UP)
    ends = balance.basis.headings_at(np.array(SCENE.covered)) @ point.x
    work = state.couple_N_m * (ends[1] - ends[0])
    assert state.energy_J == pytest.approx(state.bending_J - work, rel=1e-12)
    assert state.gradient_norm < 1e-10


def test_inflections():
    balance, point = _solved(0.0)
    saddle = saddles(balance, Ends.PINNED, point)[0]
    assert inflections(balance.basis, saddle.x) == pytest.approx([0.5], abs=1e-6)
    clamped = at_rest(strip_basis(SCENE.covered, Ends.CLAMPED, 24), SCENE.shortening)
    state = first_state(clamped, Ends.CLAMPED)
    assert inflections(clamped.basis, state.x) == pytest.approx([0.25, 0.75], abs=1e-6)
