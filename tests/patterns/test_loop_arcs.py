from math import pi, tau

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from patterns.loop import Loop
from patterns.loop_arcs import ARC_TOLERANCE_MM, loop_arcs
from patterns.path import Arc, WirePath


@settings(deadline=None, max_examples=60)
@given(
    st.floats(5, 200),
    st.floats(1.001, 5),
    st.floats(0, 3),
    st.floats(0, tau),
    st.floats(0.05, tau) | st.floats(-tau, -0.05),
)
def test_wire_along_an_ellipse(diameter, ratio, axis, start, sweep):
    loop = Loop(4.0, -3.0, diameter, ratio, axis)
    path = WirePath(loop_arcs(loop, start, sweep))
    gaps, kinks = path.joints()
    assert max(gaps.max(initial=0), kinks.max(initial=0)) < 1e-9
    points, tangents = path.at([0.0, path.length_mm])
    ends = np.array([start, start + sweep])
    assert points == pytest.approx(np.array([loop.point_mm(end) for end in ends]), abs=1e-9)
    along = np.sign(sweep) * np.stack([-np.sin(ends), np.cos(ends)], axis=1)
    assert tangents == pytest.approx(along, abs=1e-9)
    assert _away(loop, path.at(np.linspace(0, path.length_mm, 999))[0]).max() < ARC_TOLERANCE_MM
    assert path.smallest_radius_mm > loop.smallest_radius_mm * (1 - 1e-7)


def test_a_round_is_as_long_as_the_perimeter():
    for ratio in (1.0, 1.3, 3.0):
        loop = Loop(0, 0, 50, ratio)
        length = WirePath(loop_arcs(loop, 1.0, -tau)).length_mm
        assert length == pytest.approx(loop.around_mm, abs=2e-4)


def test_a_circle_is_one_arc():
    assert loop_arcs(Loop(1, 2, 30), 0.5, -pi) == (Arc(1, 2, 15, 0.5, -pi),)


def _away(loop, points):
    """Distance to an ellipse, to first order."""
    turned = (points - (loop.x_mm, loop.y_mm)) @ np.array(
        [
            (np.cos(loop.axis_rad), -np.sin(loop.axis_rad)),
            (np.sin(loop.axis_rad), np.cos(loop.axis_rad)),
        ]
    )
    axes = np.array(loop.semi_axes_mm)
    level = np.sum((turned / axes) ** 2, axis=1) - 1
    return np.abs(level) / (2 * np.hypot(*(turned / axes**2).T))
