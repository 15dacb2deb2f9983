from math import cos, pi, sin, tau

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely import Point, Polygon

from patterns.loop import Loop
from patterns.loop_ring import CHORD_MM, ring_around

LOOPS = st.builds(
    Loop,
    st.floats(-50, 50),
    st.floats(-50, 50),
    st.floats(5, 100),
    st.one_of(st.just(1.0), st.floats(1.01, 5)),
    st.floats(-4, 4),
)
ANGLES = st.floats(0, tau - 1e-6)


@given(LOOPS, ANGLES)
def test_a_point_is_the_farthest_in_the_direction_of_its_normal(loop, angle):
    x, y = loop.point_mm(angle)
    out = (x - loop.x_mm) * cos(angle) + (y - loop.y_mm) * sin(angle)
    assert out == pytest.approx(loop.reach_mm(angle))
    around, along = loop.at_eccentric(np.linspace(0, tau, 500))
    beyond = (around - (loop.x_mm, loop.y_mm)) @ (cos(angle), sin(angle))
    assert beyond.max() <= out + 1e-9
    (here,), (tangent,) = loop.at_eccentric(loop.eccentric_rad(angle))
    assert here == pytest.approx((x, y))
    assert tangent == pytest.approx((-sin(angle), cos(angle)), abs=1e-9)
    assert np.hypot(*along.T) == pytest.approx(1)


@given(LOOPS, ANGLES)
def test_the_normal_in_a_point_is_that_which_led_to_it(loop, angle):
    turn = loop.normal_rad(*loop.point_mm(angle)) - angle
    assert (turn + pi) % tau - pi == pytest.approx(0, abs=1e-6)


@given(LOOPS, ANGLES)
def test_eccentric_angles_turn_as_often_as_normals(loop, angle):
    assert loop.eccentric_rad(angle + tau) - loop.eccentric_rad(angle) == pytest.approx(tau)


@given(LOOPS)
def test_radii_of_curvature_by_differences(loop):
    step = 1e-4
    for quarter, radius in ((0.0, loop.smallest_radius_mm), (pi / 2, loop.largest_radius_mm)):
        normal = loop.axis_rad + quarter + np.array([-step, step])
        (a, b), _ = loop.at_eccentric(loop.eccentric_rad(normal))
        assert np.hypot(*(b - a)) / (2 * step) == pytest.approx(radius, rel=1e-5)


@given(LOOPS, ANGLES)
def test_points_inside_and_outside(loop, angle):
    x, y = loop.point_mm(angle)
    out = np.array([cos(angle), sin(angle)])
    assert loop.holds(*((x, y) - loop.smallest_radius_mm * out))
    assert loop.holds(*((x, y) - 1e-6 * out))
    assert not loop.holds(*((x, y) + 1e-6 * out))


@given(LOOPS, st.floats(0, 10))
def test_a_ring_holds_all_within_its_distance_and_little_more(loop, grown):
    ring = Polygon(ring_around(loop, grown))
    assert ring.is_valid
    assert ring.exterior.is_ccw
    curve, _ = loop.at_eccentric(np.linspace(0, tau, 200))
    distance = [ring.exterior.distance(Point(place)) for place in curve]
    assert min(distance) >= grown - 1e-9
    assert max(distance) <= grown + CHORD_MM
    assert all(ring.covers(Point(place)) or grown == 0 for place in curve)


def test_a_place_is_told_by_row_and_column_or_by_coordinates():
    assert Loop(1, 2, 3, cell=(0, 4)).place == "in row 1, column 5"
    assert Loop(1, 2, 3).place == "at (1, 2) mm"
