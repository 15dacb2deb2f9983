import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solver.compact import solve_loop
from solver.reading import Reading
from solver.scene import LoopScene
from solver.threshold import critical_beta, critical_strain, line_tension


def test_line_tension_of_both_readings():
    e = (1.3**2 - 1) / 2
    assert line_tension(0.3, 0.3, Reading.PLANE_STRESS) == pytest.approx(e / 0.7)
    assert line_tension(0.3, 0.3, Reading.PUBLISHED) == pytest.approx(2 * e / (1.3 * 0.4))


def test_known_threshold():
    assert critical_beta(0.3, 0.3, Reading.PLANE_STRESS) == pytest.approx(0.041071, abs=1e-6)


@settings(deadline=None)
@given(st.floats(1e-4, 1.0), st.floats(-0.8, 0.45), st.sampled_from(list(Reading)))
def test_critical_strain_inverts_critical_beta(strain, poisson, reading):
    beta = critical_beta(strain, poisson, reading)
    assert critical_strain(beta, poisson, reading) == pytest.approx(strain, rel=1e-9)


@pytest.mark.parametrize("reading", list(Reading))
@pytest.mark.parametrize("strain", [0.05, 0.3, 0.5])
def test_the_solver_buckles_at_the_exact_threshold(strain, reading):
    beta = critical_beta(strain, 0.3, reading)
    stiff = {"poisson": 0.3, "reading": reading, "axial_stiffness": 1e6}
    assert not solve_loop(LoopScene(strain, 1.001 * beta, **stiff)).buckled
    assert solve_loop(LoopScene(strain, 0.999 * beta, **stiff)).buckled


def test_height_grows_with_the_square_root_beyond_the_threshold():
    beta = critical_beta(0.3, 0.3, Reading.PLANE_STRESS)
    below = np.array([1e-3, 4e-3])
    heights = [
        solve_loop(LoopScene(0.3, beta * (1 - d), 0.3, axial_stiffness=1e6)).shape.height
        for d in below
    ]
    assert heights[1] / heights[0] == pytest.approx(2.0, rel=0.01)


@pytest.mark.parametrize("offset", [-1e-6, -1e-9, 0.0, 1e-9, 1e-6])
def test_at_the_threshold_itself_the_solve_ends_well(offset):
    beta = critical_beta(0.3, 0.3, Reading.PLANE_STRESS) * (1 + offset)
    found = solve_loop(LoopScene(0.3, beta, 0.3, axial_stiffness=1000.0))
    assert found.status == "converged"
    assert found.shape.height_over_perimeter < 0.005
