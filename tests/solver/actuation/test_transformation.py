"""Fraction of austenite: full branches, partial ones, and no jump between them."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solver.actuation.transformation import Transformation
from solver.errors import SceneError

LAW = Transformation(60.0, 70.0, 40.0, 30.0)
FAR = st.floats(-50, 300)


def test_full_branches_start_and_end_at_the_four_temperatures():
    assert LAW.heated([-50, 60, 65, 70, 300]) == pytest.approx([0, 0, 0.5, 1, 1])
    assert LAW.cooled([-50, 30, 35, 40, 300]) == pytest.approx([0, 0, 0.5, 1, 1])


@given(st.floats(0, 1))
def test_temperatures_of_fractions_are_the_inverse(fraction):
    assert float(LAW.heated(LAW.heated_to(fraction))) == pytest.approx(fraction, abs=1e-9)
    assert float(LAW.cooled(LAW.cooled_to(fraction))) == pytest.approx(fraction, abs=1e-9)


def test_from_martensite_and_from_austenite_it_is_the_full_branch():
    up, down = np.linspace(20, 90, 40), np.linspace(90, 20, 40)
    assert LAW.along(0.0, 20.0, up)[0] == pytest.approx(LAW.heated(up))
    assert LAW.along(1.0, 90.0, down)[0] == pytest.approx(LAW.cooled(down))


@given(st.floats(0, 1), FAR, FAR, FAR)
@settings(max_examples=40)
def test_a_pause_on_the_way_changes_nothing(fraction, begin, middle, end):
    begin, middle, end = sorted([begin, middle, end])
    start = float(np.clip(fraction, LAW.heated(begin), LAW.cooled(begin)))
    at_once = LAW.after(start, begin, end)
    assert LAW.after(LAW.after(start, begin, middle), middle, end) == pytest.approx(
        at_once, abs=1e-9
    )
    start = float(np.clip(fraction, LAW.heated(end), LAW.cooled(end)))
    at_once = LAW.after(start, end, begin)
    assert LAW.after(LAW.after(start, end, middle), middle, begin) == pytest.approx(
        at_once, abs=1e-9
    )


@given(st.lists(FAR, min_size=2, max_size=8))
def test_fractions_stay_between_the_branches(temperatures):
    fraction = float(LAW.heated(temperatures[0]))
    for begin, end in pairwise(temperatures):
        after = LAW.after(fraction, begin, end)
        assert (after - fraction) * (end - begin) >= -1e-12
        assert float(LAW.heated(end)) - 1e-9 <= after <= float(LAW.cooled(end)) + 1e-9
        fraction = after


@pytest.mark.parametrize(("fraction", "start", "end"), [(0.05, 62.0, 69.0), (0.95, 38.0, 31.0)])
def test_slope_is_the_derivative(fraction, start, end):
    places = np.linspace(start, end, 9)[1:-1]
    value, slope = LAW.along(fraction, start, places)
    ahead, behind = (LAW.along(fraction, start, places + d)[0] for d in (1e-5, -1e-5))
    assert (ahead - behind) / 2e-5 == pytest.approx(slope, rel=1e-6)
    assert np.all(np.diff(value) * (end - start) > 0)


def test_a_turn_in_the_middle_of_the_hysteresis_changes_nothing():
    halfway = LAW.after(0.0, 20.0, 65.0)
    assert LAW.after(halfway, 65.0, 45.0) == halfway
    assert LAW.after(halfway, 45.0, 64.0) == halfway
    assert LAW.after(halfway, 45.0, 68.0) == pytest.approx(float(LAW.heated(68.0)))


@pytest.mark.parametrize(
    ("temperatures", "key"),
    [
        ((60, 60, 40, 30), "austenite_start_C"),
        ((60, 70, 30, 30), "martensite_finish_C"),
        ((60, 70, 80, 30), "martensite_start_C"),
        ((60, 70, 65, 62), "martensite_finish_C"),
        ((float("nan"), 70, 40, 30), "austenite_start_C"),
        ((-300, 70, 40, -310), "austenite_start_C"),
    ],
)
def test_temperatures_out_of_order_are_refused(temperatures, key):
    with pytest.raises(SceneError, match=key):
        Transformation(*map(float, temperatures))
