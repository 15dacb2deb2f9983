from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from patterns.errors import PatternError
from patterns.registration import Mark, registration_marks

TURNS = [np.array(m) for m in ([[0, -1], [1, 0]], [[-1, 0], [0, -1]], [[0, 1], [-1, 0]])]
MIRROR = np.array([[-1, 0], [0, 1]])
SYMMETRIES = [*TURNS, MIRROR, *(MIRROR @ turn for turn in TURNS)]


def ink(marks: tuple[Mark, ...]) -> np.ndarray:
    """Points close together along every stroke."""
    share = np.linspace(0, 1, 101)[:, None]
    return np.concatenate(
        [
            a + share * (b - a)
            for mark in marks
            for stroke in mark.strokes
            for a, b in pairwise(stroke)
        ]
    )


def farthest(points: np.ndarray, target: np.ndarray) -> float:
    return max(np.hypot(*(target - point).T).min() for point in points)


@pytest.mark.parametrize("symmetry", SYMMETRIES, ids=range(7))
def test_no_turn_or_mirror_image_is_mistaken(symmetry: np.ndarray) -> None:
    drawn = ink(registration_marks((-30, -30, 30, 30), 8.0, 6.0))
    assert farthest(drawn @ symmetry.T, drawn) > 1.0
    assert farthest(drawn, drawn) == 0.0


def test_the_f_is_at_the_top_left_and_stands_upright() -> None:
    f, *crosses = registration_marks((0, 0, 50, 20), 8.0, 6.0)
    assert (f.x_mm, f.y_mm) == (-10, 30)
    stem = f.strokes[0][:2]
    assert stem == pytest.approx(np.array([[-12.4, 26], [-12.4, 34]]))
    assert all(len(cross.strokes) == 2 for cross in crosses)


@settings(deadline=None, max_examples=40)
@given(
    st.tuples(st.floats(-500, 0), st.floats(-500, 0), st.floats(0, 500), st.floats(0, 500)),
    st.floats(1, 20),
    st.floats(0, 20),
)
def test_marks_clear_the_box(
    box: tuple[float, float, float, float], size: float, gap: float
) -> None:
    points = ink(registration_marks(box, size, gap))
    outside = np.maximum(np.array(box[:2]) - points, points - np.array(box[2:]))
    assert outside.min() >= gap - 1e-9


@pytest.mark.parametrize(
    ("box", "size", "gap"),
    [((1, 0, 0, 1), 8, 6), ((0, 0, 1, 1), 0, 6), ((0, 0, 1, 1), 8, -1)],
)
def test_impossible_marks_are_refused(
    box: tuple[float, float, float, float], size: float, gap: float
) -> None:
    with pytest.raises(PatternError, match="registration"):
        registration_marks(box, size, gap)
