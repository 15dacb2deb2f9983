import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.special import ellipe

from patterns.ellipse import perimeter, semi_axes


def test_perimeters_known_to_many_figures():
    assert perimeter(1, 1) == pytest.approx(6.283185307179586, rel=1e-15)
    assert perimeter(2, 1) == pytest.approx(9.688448220547675, rel=1e-15)  # DLMF 19.9.9, tables
    assert perimeter(1, 1e-9) == pytest.approx(4, rel=1e-14)


@given(st.floats(0.01, 100), st.floats(0.01, 100))
def test_perimeter_is_the_complete_elliptic_integral(one, other):
    long, short = max(one, other), min(one, other)
    assert perimeter(one, other) == pytest.approx(4 * long * ellipe(1 - (short / long) ** 2))


@given(st.floats(0.1, 1000), st.floats(1, 5))
def test_an_ellipse_is_as_long_around_as_its_circle(diameter, ratio):
    long, short = semi_axes(diameter, ratio)
    assert long / short == pytest.approx(ratio)
    assert perimeter(long, short) == pytest.approx(perimeter(diameter / 2, diameter / 2))
