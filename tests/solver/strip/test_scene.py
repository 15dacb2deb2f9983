import math

import pytest

from solver.errors import SceneError
from solver.strip.scene import StripScene

BEAM = {"length_m": 0.12, "constraint_m": 0.115, "width_m": 0.02, "thickness_m": 0.38e-3}


def test_units():
    scene = StripScene(**BEAM, couple_top_N_m=1e-3, couple_bottom_N_m=3e-3)
    assert scene.shortening == pytest.approx(1 / 24)
    assert scene.stiffness_N_m2 == pytest.approx(2.35e9 * 0.02 * 0.38e-3**3 / 12)
    assert scene.energy_unit_J == pytest.approx(scene.stiffness_N_m2 / 0.12)
    assert scene.couple_N_m == pytest.approx(2e-3)


@pytest.mark.parametrize(
    ("key", "value", "allowed"),
    [
        ("constraint_m", 0.12, "must be less than length_m = 0.12"),
        ("constraint_m", 0.2, "must be less than length_m = 0.12"),
        ("constraint_m", 0.0005, "0.99"),
        ("constraint_m", 0.12 * (1 - 1e-12), "1e-09"),
        ("constraint_m", 0.0, "greater than 0"),
        ("length_m", math.inf, "finite"),
        ("width_m", -1.0, "greater than 0"),
        ("thickness_m", math.nan, "greater than 0"),
        ("modulus_Pa", 0.0, "greater than 0"),
        ("density_kg_m3", 0.0, "greater than 0"),
        ("poisson", 0.5, "between -1 and 0.5"),
        ("poisson", math.nan, "between -1 and 0.5"),
        ("covered", (0.0, 0.6), "no more than half"),
        ("covered", (0.4, 0.4), "at least 0.01"),
        ("covered", (-0.1, 0.4), "0 to 0.5"),
        ("couple_top_N_m", math.nan, "finite"),
        ("couple_bottom_N_m", 1.0, "within"),
    ],
)
def test_faults_are_named_in_one_line(key, value, allowed):
    with pytest.raises(SceneError, match=allowed) as fault:
        StripScene(**{**BEAM, key: value})
    assert key in str(fault.value)
    assert "\n" not in str(fault.value)
