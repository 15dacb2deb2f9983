import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import Point

from patterns.path import Arc, Line, WirePath

STADIUM = WirePath(
    (
        Line(0, 0, 10, 0),
        Arc(10, 5, 5, -np.pi / 2, np.pi),
        Line(10, 10, 0, 10),
        Arc(0, 15, 5, -np.pi / 2, -np.pi),
    )
)


def test_length_is_that_of_lines_and_half_circles():
    assert STADIUM.length_mm == pytest.approx(20 + 10 * np.pi)


def test_smooth_path_has_neither_gaps_nor_kinks():
    gaps, kinks = STADIUM.joints()
    assert gaps == pytest.approx([0, 0, 0], abs=1e-12)
    assert kinks == pytest.approx([0, 0, 0], abs=1e-12)


def test_kink_and_gap_are_seen():
    gaps, kinks = WirePath((Line(0, 0, 10, 0), Line(10, 3, 10, 5))).joints()
    assert gaps == pytest.approx([3])
    assert kinks == pytest.approx([np.sqrt(2)])


def test_points_in_any_order_lie_at_their_arclength():
    s = [10 + 2.5 * np.pi, 3, 25 + 5 * np.pi - 6, 10 + 5 * np.pi]
    point, tangent = STADIUM.at(s)
    assert point == pytest.approx(np.array([[15, 5], [3, 0], [1, 10], [10, 10]]), abs=1e-12)
    assert tangent == pytest.approx(np.array([[0, 1], [1, 0], [-1, 0], [-1, 0]]), abs=1e-12)


def test_points_beyond_the_ends_are_the_ends():
    point, _ = STADIUM.at([-1.0, 1e3])
    assert point == pytest.approx(np.array([[0, 0], [0, 20]]), abs=1e-12)


def test_no_points_of_no_arclengths():
    point, tangent = STADIUM.at([])
    assert point.shape == tangent.shape == (0, 2)


@settings(deadline=None, max_examples=50)
@given(st.lists(st.floats(0, 51), min_size=1, max_size=8))
def test_polyline_stays_within_its_tolerance(s):
    line = STADIUM.line_string(0.01)
    assert all(line.distance(Point(p)) <= 0.01 + 1e-9 for p in STADIUM.at(s)[0])


def test_smallest_radius():
    assert STADIUM.smallest_radius_mm == pytest.approx(5)
    assert WirePath((Line(0, 0, 1, 0),)).smallest_radius_mm == np.inf
