"""The quadratic programme of one step, against its conditions of optimality."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solver.contact_newton import convex_along, pushed_step
from solver.touching import Touches


def _touches(rows, excess):
    k = len(excess)
    return Touches(
        excess, rows, np.zeros_like(rows), np.full(k, np.inf), np.ones(k), np.zeros(k), np.ones(k)
    )


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 10_000), st.integers(0, 4))
def test_conditions_of_karush_kuhn_and_tucker(seed, k):
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(6, 6))
    hessian, slope = root @ root.T + 0.1 * np.eye(6), rng.normal(size=6)
    touches = _touches(rng.normal(size=(k, 6)), rng.normal(size=k))
    found = pushed_step(hessian, slope, touches, touches.excess > 0)
    assert found is not None
    step, force = found
    beyond = touches.excess + touches.rows @ step
    assert force.min(initial=0) >= 0
    assert beyond.max(initial=-1) <= 1e-9
    assert np.abs(force * beyond).max(initial=0) < 1e-7
    assert hessian @ step + slope + force @ touches.rows == pytest.approx(np.zeros(6), abs=1e-8)


def test_convex_along_what_is_allowed():
    hessian = np.diag([-1.0, 2.0, 3.0])
    assert convex_along(hessian, np.array([[1.0, 0.0, 0.0]]))
    assert not convex_along(hessian, np.array([[0.0, 1.0, 0.0]]))
    assert not convex_along(hessian, np.zeros((0, 3)))
