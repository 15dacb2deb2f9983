import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solver.newton import minimise, trust_step


def _rosenbrock(q):
    x, y = q
    value = (1 - x) ** 2 + 100 * (y - x * x) ** 2
    slope = np.array([-2 * (1 - x) - 400 * x * (y - x * x), 200 * (y - x * x)])
    hessian = np.array([[2 - 400 * (y - 3 * x * x), -400 * x], [-400 * x, 200]])
    return value, slope, hessian


def _double_well(q):
    x, y = q
    hessian = np.diag([3 * x * x - 1, 1.0])
    return x**4 / 4 - x * x / 2 + y * y / 2, np.array([x**3 - x, y]), hessian


def test_curved_valley():
    found = minimise(_rosenbrock, np.array([-1.2, 1.0]), tolerance=1e-10, radius=1.0)
    assert found.converged
    assert found.unknowns == pytest.approx([1, 1])


def test_a_saddle_point_is_left():
    found = minimise(_double_well, np.zeros(2), tolerance=1e-10, radius=0.5)
    assert found.converged
    assert abs(found.unknowns[0]) == pytest.approx(1)
    assert found.lowest_eigenvalue == pytest.approx(1)


def test_too_few_steps_are_told():
    found = minimise(_rosenbrock, np.array([-1.2, 1.0]), tolerance=1e-10, radius=0.1, most_steps=3)
    assert not found.converged
    assert found.steps == 3


@settings(deadline=None, max_examples=60)
@given(
    st.lists(st.floats(-5, 5), min_size=4, max_size=4).map(sorted),
    st.lists(st.floats(-3, 3), min_size=4, max_size=4),
    st.floats(0.01, 10),
)
def test_trust_step_beats_every_other_step_in_the_ball(eigenvalues, slope, radius):
    lam, g = np.array(eigenvalues), np.array(slope)
    step = trust_step(lam, g, radius)
    assert np.linalg.norm(step) <= 1.01 * radius

    def model(p):
        return p @ g + p @ (lam * p) / 2

    others = np.random.default_rng(0).normal(size=(300, 4))
    others *= radius / np.linalg.norm(others, axis=1)[:, None]
    best = min(model(p * t) for p in others for t in (0.3, 1.0))
    assert model(step) <= best + 0.02 * abs(best) + 1e-9
