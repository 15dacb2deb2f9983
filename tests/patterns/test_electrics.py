import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from patterns.electrics import AUSTENITE_UOHM_CM, MARTENSITE_UOHM_CM, resistance_ohm
from patterns.errors import PatternError

OHM_PER_M = {0.10: 126, 0.15: 55, 0.20: 29, 0.25: 18.5, 0.31: 12.2, 0.38: 8.3, 0.51: 4.3}


@pytest.mark.parametrize("diameter_mm", OHM_PER_M)
def test_the_makers_table_lies_between_cold_and_hot(diameter_mm: float) -> None:
    cold = resistance_ohm(1000.0, diameter_mm, MARTENSITE_UOHM_CM)
    hot = resistance_ohm(1000.0, diameter_mm, AUSTENITE_UOHM_CM)
    assert 0.99 * cold <= OHM_PER_M[diameter_mm] <= 1.01 * hot


@settings(deadline=None, max_examples=30)
@given(st.floats(1, 1e5), st.floats(0.05, 2), st.floats(1, 200))
def test_resistance_scales_with_length_and_area(length: float, diameter: float, rho: float) -> None:
    once = resistance_ohm(length, diameter, rho)
    assert resistance_ohm(3 * length, diameter, rho) == pytest.approx(3 * once)
    assert resistance_ohm(length, 2 * diameter, rho) == pytest.approx(once / 4)


def test_a_wire_without_diameter_is_refused() -> None:
    with pytest.raises(PatternError, match="diameter"):
        resistance_ohm(1.0, 0.0, 80.0)
    with pytest.raises(PatternError, match="negative"):
        resistance_ohm(-1.0, 0.3, 80.0)
