import numpy as np
import pytest

from solver.disc_functions import DiscFunction

FUNCTIONS = [
    DiscFunction(m, k, trig)
    for m in range(5)
    for k in range(3)
    for trig in ("cos", "sin")
    if m > 0 or trig == "cos"
]


def _disc_points():
    nodes, weights = np.polynomial.legendre.leggauss(12)
    theta = np.arange(32) * (2 * np.pi / 32)
    r, angle = np.meshgrid(np.sqrt((nodes + 1) / 2), theta, indexing="ij")
    return r.ravel(), angle.ravel(), np.repeat(weights / 2 / 32, 32)


def test_orthonormal_in_the_mean_square():
    r, theta, weight = _disc_points()
    values = np.stack([f.value(r, theta) for f in FUNCTIONS])
    assert values * weight @ values.T == pytest.approx(np.eye(len(FUNCTIONS)), abs=1e-12)


@pytest.mark.parametrize("function", FUNCTIONS)
def test_gradient_against_differences(function):
    rng = np.random.default_rng(1)
    x, y = rng.uniform(-0.6, 0.6, (2, 7))
    step = 1e-6

    def value(dx, dy):
        return function.value(np.hypot(x + dx, y + dy), np.arctan2(y + dy, x + dx))

    along_x, along_y = function.gradient(np.hypot(x, y), np.arctan2(y, x))
    assert along_x == pytest.approx((value(step, 0) - value(-step, 0)) / (2 * step), abs=1e-7)
    assert along_y == pytest.approx((value(0, step) - value(0, -step)) / (2 * step), abs=1e-7)


@pytest.mark.parametrize("function", FUNCTIONS)
@pytest.mark.parametrize("order", [1, 2, 3])
def test_angular_derivatives_against_differences(function, order):
    theta, step = np.linspace(0, 6, 9), 1e-6
    difference = (
        function.angular(theta + step, order - 1) - function.angular(theta - step, order - 1)
    ) / (2 * step)
    assert function.angular(theta, order) == pytest.approx(difference, abs=1e-7)
