import numpy as np
import pytest

from solver.ellipse import semi_axes
from solver.errors import SceneError
from solver.reading import Reading
from solver.scene import LoopScene


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("strain", -0.1),
        ("strain", 2.1),
        ("beta", 0.0),
        ("beta", float("inf")),
        ("axial_stiffness", float("nan")),
        ("axis_ratio", 0.9),
        ("axis_ratio", 10.5),
        ("modulus_ratio", 0.0),
        ("natural_curvature", -0.1),
        ("natural_curvature", 11.0),
        ("alpha", -1e-9),
        ("alpha", 1.01),
        ("alpha", float("nan")),
    ],
)
def test_numbers_out_of_range_are_refused_by_name(key, value):
    with pytest.raises(SceneError, match=key):
        LoopScene(**{"strain": 0.3, "beta": 0.01, "poisson": 0.3, key: value})


def test_moduli_that_make_the_fabric_unstable_are_refused():
    LoopScene(0.3, 0.01, 0.49, modulus_ratio=3.0)
    with pytest.raises(SceneError, match="modulus_ratio"):
        LoopScene(0.3, 0.01, 0.49, Reading.PUBLISHED, modulus_ratio=3.0)


def test_moduli_have_the_mean_1():
    along, across = LoopScene(0.3, 0.01, 0.3, modulus_ratio=1.5).moduli
    assert along + across == pytest.approx(2)
    assert along / across == pytest.approx(1.5)


@pytest.mark.parametrize("axis_ratio", [1.0, 1.2, 3.0, 10.0])
def test_ellipses_keep_the_perimeter(axis_ratio):
    a, b = semi_axes(axis_ratio)
    theta = np.linspace(0, 2 * np.pi, 4000, endpoint=False)
    speed = np.hypot(a * np.sin(theta), b * np.cos(theta))
    assert speed.mean() == pytest.approx(1, rel=1e-9)
    assert a / b == pytest.approx(axis_ratio)
