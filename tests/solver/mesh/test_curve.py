"""Curves along which wires lie."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solver.errors import SceneError
from solver.mesh.curve import Arc, Ellipse, Through, circle, direction, length, line, nearest

ANGLES = np.arange(12) * (2 * np.pi / 12)
ROUND = Through(tuple((float(np.cos(a)), float(np.sin(a))) for a in ANGLES), closed=True)
CURVES = [
    Ellipse((0.5, -1.0), (2.0, 0.7), 0.4),
    circle((1.0, 2.0), 0.6),
    Arc((0.0, 1.0), 2.0, 0.3, 4.0),
    ROUND,
    line((0.0, 0.0), (3.0, 4.0)),
    Through(((0.0, 0.0), (1.0, 0.4), (2.0, 0.0), (3.0, -0.5)), closed=False),
]


@pytest.mark.parametrize("curve", CURVES)
@settings(max_examples=20)
@given(parameter=st.floats(0.0, 0.999))
def test_the_nearest_point_of_a_point_on_the_curve_is_itself(curve, parameter):
    point = curve.at(np.array([parameter]))[0]
    found, distance = nearest(curve, tuple(point))
    assert distance < 1e-7
    assert curve.at(np.array([found]))[0] == pytest.approx(point, abs=1e-7)


@pytest.mark.parametrize("curve", CURVES)
def test_scaling(curve):
    parameters = np.linspace(0, 0.9, 7)
    assert curve.scaled(3.0).at(parameters) == pytest.approx(3 * curve.at(parameters))
    assert curve.scaled(3.0).closed == curve.closed


def test_lengths():
    assert length(circle((0, 0), 2.0)) == pytest.approx(4 * np.pi, rel=1e-4)
    assert length(line((0.0, 0.0), (3.0, 4.0))) == pytest.approx(5)
    assert length(Arc((0, 0), 2.0, 0.0, 1.0), 0.5, 1.0) == pytest.approx(1.0, rel=1e-5)
    assert length(ROUND) == pytest.approx(2 * np.pi, rel=1e-3)


def test_a_turned_ellipse_starts_on_its_first_axis():
    ellipse = Ellipse((1.0, 1.0), (2.0, 1.0), np.pi / 2)
    assert ellipse.at(np.array([0.0, 0.25])) == pytest.approx(np.array([[1.0, 3.0], [0.0, 1.0]]))
    assert direction(ellipse, 0.0) == pytest.approx([-1.0, 0.0], abs=1e-6)


def test_a_closed_spline_is_smooth_where_it_ends():
    assert direction(ROUND, 0.0) == pytest.approx([0.0, 1.0], abs=1e-3)


def test_closed_splines_run_counterclockwise():
    backwards = Through(ROUND.points[::-1], closed=True)
    for curve in (ROUND, backwards):
        x, y = curve.at(np.linspace(0, 1, 50)).T
        assert np.sum(x[:-1] * np.diff(y) - y[:-1] * np.diff(x)) == pytest.approx(
            2 * np.pi, rel=0.02
        )


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: circle((0, 0), 0.0), "greater than 0"),
        (lambda: Arc((0, 0), 1.0, 0.0, 7.0), "shorter than the circle"),
        (lambda: Through(((0, 0),), closed=False), "needs 2"),
        (lambda: Through(((0, 0), (1, 0), (1, 1)), closed=True), "needs 4"),
        (lambda: Through(((0, 0), (0, 0)), closed=False), "the same"),
        (lambda: Through(((0, 0), (np.nan, 0)), closed=False), "finite"),
    ],
)
def test_curves_that_are_none_are_refused(make, message):
    with pytest.raises(SceneError, match=message):
        make()
