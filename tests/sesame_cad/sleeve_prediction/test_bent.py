import numpy as np
import pytest

from sesame_cad.sleeve_prediction.bent import BentBeam

LENGTH, RADIUS = 100.0, 80.0


@pytest.fixture(scope="module")
def arc():
    """A beam bent to a circle that opens upward, its middle's heading 0."""
    s = np.linspace(0, LENGTH, 2001)
    heading = (s - LENGTH / 2) / RADIUS
    points = RADIUS * np.stack([np.sin(heading), 1 - np.cos(heading)], axis=1)
    return BentBeam(points - points[0], heading, LENGTH)


def test_a_straight_beam_moves_nothing():
    straight = BentBeam(np.array([[0.0, 0], [50, 0], [100, 0]]), np.zeros(3), LENGTH)
    points = np.array([[-5.0, 1, 2], [30, -2, 0], [110, 0, -3]])
    assert straight.carried(points) == pytest.approx(points)


def test_on_a_circle_heights_are_radii(arc):
    along = np.linspace(0, LENGTH, 23)
    points = np.stack([along, np.full(23, 4.0), np.full(23, 10.0)], axis=1)
    bent = arc.carried(points)
    centre = RADIUS * np.array([np.sin(LENGTH / 2 / RADIUS), np.cos(LENGTH / 2 / RADIUS)])
    distance = np.hypot(bent[:, 0] - centre[0], bent[:, 2] - centre[1])
    assert distance == pytest.approx(RADIUS - 10.0, abs=1e-5)
    assert bent[:, 1] == pytest.approx(4.0)
    # what lies above is shortened by 1 - κ z
    step = np.linalg.norm(np.diff(bent[:, [0, 2]], axis=0), axis=1)
    chord = 2 * (RADIUS - 10) * np.sin(LENGTH / 22 / RADIUS / 2)
    assert step == pytest.approx(chord, rel=1e-4)


def test_past_the_rivets_it_goes_straight_on(arc):
    ends = arc.carried(np.array([[-7.0, 0, 0], [0, 0, 0], [LENGTH, 0, 0], [LENGTH + 9, 0, 0]]))
    assert np.linalg.norm(ends[1] - ends[0]) == pytest.approx(7.0)
    assert np.linalg.norm(ends[3] - ends[2]) == pytest.approx(9.0)
    along = (ends[3] - ends[2])[[0, 2]] / 9
    assert along == pytest.approx([np.cos(LENGTH / 2 / RADIUS), np.sin(LENGTH / 2 / RADIUS)])
