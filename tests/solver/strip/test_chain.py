import numpy as np
import pytest

from solver.errors import SceneError
from solver.strip.chain import chain
from solver.strip.scene import StripScene
from solver.strip.snap import solve_strip
from solver.strip.state import Side


@pytest.fixture(scope="module")
def shapes():
    return solve_strip(StripScene(0.12, 0.115, 0.02, 0.38e-3)).unloaded


def _angles(points):
    d = np.diff(points, axis=0)
    return np.unwrap(np.arctan2(d[:, 1], d[:, 0]))


def test_one_segment_lies_as_it_does_alone(shapes):
    assert chain("-", shapes)[0] == pytest.approx(shapes[Side.DOWN].points_m)


@pytest.mark.parametrize("states", ["++", "+-", "++-+", "-+--+"])
def test_joined_ends_meet_and_share_their_tangent(states, shapes):
    segments = chain(states, shapes)
    assert segments[1:, 0] == pytest.approx(segments[:-1, -1], abs=1e-15)
    # polygon edges next to a joint differ by what the strip bends over one edge: next to nothing
    angles = _angles(np.vstack([segments[0], *(s[1:] for s in segments[1:])]))
    assert np.abs(np.diff(angles)).max() < 1.5 * np.abs(np.diff(_angles(segments[0]))).max()


def test_equal_states_turn_by_equal_angles(shapes):
    state = shapes[Side.UP]
    turn = state.headings_rad[-1] - state.headings_rad[0]
    ends = np.vstack([[0.0, 0.0], chain("+++", shapes)[:, -1]])
    assert np.diff(_angles(ends)) == pytest.approx(turn, rel=1e-9)


def test_alternating_states_go_straight_on(shapes):
    ends = chain("+-+-", shapes)[:, -1]
    assert np.diff(_angles(ends)) == pytest.approx(0, abs=1e-9)


def test_the_opposite_states_are_the_mirror_image(shapes):
    one, other = chain("++-+", shapes), chain("--+-", shapes)
    assert one == pytest.approx(other * [1, -1], abs=1e-12)


@pytest.mark.parametrize("states", ["", "+x", "+ -", "between"])
def test_other_states_are_refused(states, shapes):
    with pytest.raises(SceneError, match=r"states = .* must be one or more of \+ and -"):
        chain(states, shapes)
