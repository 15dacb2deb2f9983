import numpy as np
import pytest

from solver.disc_functions import DiscFunction
from solver.edge import EdgeCurve
from solver.shape import LoopShape, from_expansion
from solver.symmetry import HALF_TURN, displacements


def _curve():
    rng = np.random.default_rng(2)
    return EdgeCurve(rng.normal(size=(6, 3)), rng.normal(size=(6, 3)))


@pytest.mark.parametrize("derivative", [1, 2])
def test_derivatives_against_differences(derivative):
    curve, theta, step = _curve(), np.linspace(0, 6, 9), 1e-6
    ahead, behind = (curve.position(theta + s * step, derivative - 1) for s in (1, -1))
    assert curve.position(theta, derivative) == pytest.approx(
        (ahead - behind) / (2 * step), abs=1e-6
    )


def test_extent_is_that_of_fine_samples():
    curve = _curve()
    z = curve.position(np.linspace(0, 2 * np.pi, 400_001))[:, 2]
    assert curve.extent == pytest.approx(np.ptp(z), rel=1e-9)
    assert curve.position(np.array([curve.crest]))[0, 2] == pytest.approx(z.max(), rel=1e-9)


def test_a_level_curve_has_no_height():
    flat = EdgeCurve(np.zeros((3, 3)), np.zeros((3, 3)))
    assert flat.extent == 0
    assert flat.crest == 0


def test_the_edge_is_the_disc_at_radius_1():
    unknowns = displacements(5, HALF_TURN)
    shape = LoopShape(unknowns, np.random.default_rng(0).normal(size=len(unknowns)))
    theta = np.linspace(0, 6, 7)
    assert shape.curve.position(theta) == pytest.approx(shape.position(1.0, theta))


def test_height_and_width_of_a_saddle_turned_by_any_angle():
    unknowns = displacements(5, HALF_TURN)
    for turn in (0.0, 0.3, np.pi / 4, 1.2):
        wave = {"cos": np.cos(2 * turn), "sin": np.sin(2 * turn)}
        expansion = {(0, DiscFunction(1, 0, "cos")): 0.5, (1, DiscFunction(1, 0, "sin")): 0.5}
        for trig in ("cos", "sin"):
            rise = DiscFunction(2, 0, trig)
            expansion[2, rise] = 0.2 * wave[trig] / rise.edge_value
        shape = LoopShape(unknowns, from_expansion(unknowns, expansion))
        assert shape.height == pytest.approx(0.4, rel=1e-10)
        assert shape.width == pytest.approx(2)
