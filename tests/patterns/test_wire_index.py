from math import inf, pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from patterns.path import Arc, Line, WirePath
from patterns.wire_index import WireIndex

PATH = WirePath(
    (
        Line(-10.0, -5.0, 0.0, -5.0),
        Arc(0.0, 0.0, 5.0, -pi / 2, pi),
        Arc(0.0, 8.0, 3.0, -pi / 2, -1.2 * pi),
    )
)
WIRE = WireIndex(PATH)


@settings(deadline=None, max_examples=100)
@given(st.floats(-20, 20), st.floats(-20, 20))
def test_the_nearest_place_is_the_nearest_of_many(x: float, y: float) -> None:
    point = np.array([[x, y]])
    places, _ = PATH.at(np.linspace(0, PATH.length_mm, 20001))
    nearest = WIRE.nearest(point, 100.0)
    assert nearest.distance_mm[0] == pytest.approx(np.hypot(*(places - point).T).min(), abs=2e-3)
    foot, tangent = PATH.at(nearest.station_mm)
    away = point - foot
    assert np.hypot(*away[0]) == pytest.approx(nearest.distance_mm[0], abs=1e-9)
    side = tangent[0, 0] * away[0, 1] - tangent[0, 1] * away[0, 0]
    assert nearest.side_mm[0] == pytest.approx(side, abs=1e-9)


@settings(deadline=None, max_examples=50)
@given(st.floats(0, PATH.length_mm))
def test_places_along_the_wire_are_those_of_the_path(s: float) -> None:
    assert WIRE.at(np.array([s])) == pytest.approx(PATH.at(s)[0], abs=1e-9)


def test_left_is_positive_and_beyond_the_end_is_overshoot() -> None:
    nearest = WIRE.nearest(np.array([[-5.0, -4.0], [-5.0, -6.5], [-13.0, -1.0]]), 9.0)
    assert nearest.side_mm == pytest.approx([1.0, -1.5, 4.0])
    assert nearest.overshoot_mm == pytest.approx([0.0, 0.0, 3.0])
    assert nearest.distance_mm[2] == pytest.approx(5.0)


def test_beyond_reach_there_is_nothing() -> None:
    nearest = WIRE.nearest(np.array([[0.0, 0.0], [-5.0, -4.5]]), 1.0)
    assert nearest.distance_mm[0] == inf
    assert np.isnan(nearest.station_mm[0])
    assert nearest.distance_mm[1] == pytest.approx(0.5)


def test_a_piece_is_found_from_where_its_box_ends() -> None:
    just_left = np.array([[-10.4, -5.0], [0.0, -5.4], [5.4, 0.0], [-3.4, 8.0]])
    assert WIRE.nearest(just_left, 0.41).distance_mm == pytest.approx(0.4)


def test_the_same_stretch_of_wire_can_be_left_out() -> None:
    place = WIRE.at(np.array([9.9]))
    away = (np.array([9.9]), 1.0)
    assert WIRE.nearest(place, 1.0).distance_mm[0] == pytest.approx(0.0, abs=1e-9)
    assert WIRE.nearest(place, 1.0, away_from=away).distance_mm[0] == inf


@pytest.mark.parametrize("sweep", [0.0, -0.0])
def test_an_arc_of_no_length_is_a_point(sweep: float) -> None:
    """A gap of an ellipse's arcs may close to nothing; its circle is not there."""
    wire = WireIndex(WirePath((Arc(0.0, 0.0, 5.0, 0.0, sweep), Line(5.0, 0.0, 5.0, -1.0))))
    nearest = wire.nearest(np.array([[0.0, 5.1], [5.0, 0.5]]), 20.0)
    assert nearest.distance_mm == pytest.approx([np.hypot(5.0, 5.1), 0.5])
