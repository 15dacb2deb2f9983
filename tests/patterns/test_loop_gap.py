from math import cos, pi, sin, tau

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import Polygon

from patterns.errors import PatternError
from patterns.layout import check_spaced, check_tangent, nearest_pair_text, tangent_layout
from patterns.loop import Loop
from patterns.loop_gap import LoopGaps

RATIOS = st.one_of(st.just(1.0), st.floats(1, 5))
ONE, OTHER = np.array([0]), np.array([1])


@st.composite
def pairs(draw):
    """Two loops and the gap between them, laid along the normal that they share."""
    one = Loop(3.0, -2.0, draw(st.floats(10, 60)), draw(RATIOS), draw(st.floats(0, 3)))
    shape = draw(st.floats(10, 60)), draw(RATIOS), draw(st.floats(0, 3))
    normal, gap = draw(st.floats(0, tau)), draw(st.floats(-1e-3, 20))
    x, y = one.point_mm(normal)
    back_x, back_y = Loop(0.0, 0.0, *shape).point_mm(normal + pi)
    place = (x + gap * cos(normal) - back_x, y + gap * sin(normal) - back_y)
    return one, Loop(*place, *shape), gap, (x, y), normal


@settings(deadline=None, max_examples=200)
@given(pairs())
def test_a_gap_laid_on_purpose_is_found(pair):
    one, other, gap, (x, y), normal = pair
    (found,), (point,) = LoopGaps((one, other)).of(ONE, OTHER)
    assert found == pytest.approx(gap, abs=1e-10)
    along = (point - (x, y)) @ (cos(normal), sin(normal))
    assert -1e-9 <= along / gap <= 1 + 1e-9 if abs(gap) > 1e-4 else abs(along) < 1e-3
    assert abs((point - (x, y)) @ (-sin(normal), cos(normal))) < 1e-5
    assert LoopGaps((one, other)).at_least_mm(ONE, OTHER)[0] <= found + 1e-12


@settings(deadline=None, max_examples=40)
@given(pairs())
def test_gaps_are_those_between_polygons(pair):
    one, other, gap, *_ = pair
    angle = np.linspace(0, tau, 4001)
    rings = [Polygon(loop.at_eccentric(angle)[0]) for loop in (one, other)]
    if gap > 0:
        assert rings[0].distance(rings[1]) == pytest.approx(gap, abs=1e-3)


def test_overlap_is_the_way_out():
    flat, upright = Loop(0, 0, 40, 3.0), Loop(0, 0, 40, 3.0, pi / 2)
    long, short = flat.semi_axes_mm
    (gap,), _ = LoopGaps((flat, flat)).of(ONE, OTHER)
    assert gap == pytest.approx(-2 * short)
    (gap,), _ = LoopGaps((flat, upright)).of(ONE, OTHER)
    assert gap == pytest.approx(-(long + short))


def test_ellipses_that_overlap_or_nearly_touch_are_named_with_the_distance():
    long = Loop(0, 0, 40, 2.0).semi_axes_mm[0]
    over = (Loop(0, 0, 40, 2.0), Loop(2 * long - 0.25, 0, 40, 2.0))
    with pytest.raises(PatternError, match=r"loops 0 and 1 overlap: .* at least 0\.25 mm"):
        tangent_layout(over)
    near = tangent_layout((over[0], Loop(2 * long + 0.5, 0, 40, 2.0)))
    with pytest.raises(PatternError, match=r"loops 0 at \(0, 0\) mm and 1 .* 0\.5000 mm apart"):
        check_spaced(near)


def test_loops_apart_are_named_by_row_and_column():
    loops = tuple(Loop(25.0 * x, 0, 25, cell=(1, x)) for x in (0, 1, 3))
    with pytest.raises(PatternError, match=r"1 and 2, .*25\.000 mm apart \(in row 2, column 2 and"):
        check_tangent(tangent_layout(loops))


@settings(deadline=None, max_examples=30)
@given(st.lists(st.tuples(st.floats(-200, 200), st.floats(-200, 200)), min_size=4, max_size=12))
def test_the_nearest_pair_is_that_of_measuring_every_pair(places):
    loops = tuple(Loop(x, y, 20, 1 + k % 3, k) for k, (x, y) in enumerate(places))
    some, others = [0, 1], list(range(2, len(loops)))
    gaps = LoopGaps(loops)
    every = [gaps.of(np.array([i]), np.array([j]))[0][0] for i in some for j in others]
    text = nearest_pair_text(loops, some, others)
    assert f"is {max(min(every), 0):.3f} mm" in text
