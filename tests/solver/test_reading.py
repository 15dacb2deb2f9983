import pytest

from solver.errors import SceneError
from solver.reading import Reading, density_coefficients


def test_published_is_twice_the_three_dimensional_density():
    # 3-D: w = 1/(2(1+nu)) (Tr E^2 + nu/(1-2nu) (Tr E)^2)
    a, b = density_coefficients(0.3, Reading.PUBLISHED)
    assert (a, b) == pytest.approx((1 / 1.3, 0.3 / (1.3 * 0.4)))


def test_plane_stress_gives_the_modulus_in_a_tension_test():
    # uniaxial stress: minimise w over the transverse strain; the slope of 2w is E_f = 1
    a, b = density_coefficients(0.3, Reading.PLANE_STRESS)
    along, across = 1.0, -0.3
    assert 2 * a * across + 2 * b * (along + across) == pytest.approx(0)
    assert 2 * a * along + 2 * b * (along + across) == pytest.approx(1)


def test_readings_agree_at_poisson_zero_but_for_the_factor_two():
    plane, published = (density_coefficients(0.0, reading) for reading in Reading)
    assert published == pytest.approx((2 * plane[0], 2 * plane[1]))


@pytest.mark.parametrize(
    ("poisson", "reading"),
    [(0.5, Reading.PUBLISHED), (0.51, Reading.PLANE_STRESS), (-1.0, Reading.PLANE_STRESS)],
)
def test_poisson_out_of_range_is_refused(poisson, reading):
    with pytest.raises(SceneError, match="poisson"):
        density_coefficients(poisson, reading)


def test_nan_is_refused():
    with pytest.raises(SceneError):
        density_coefficients(float("nan"), Reading.PLANE_STRESS)
