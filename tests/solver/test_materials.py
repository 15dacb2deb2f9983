import pytest

from solver.compact import solve_loop
from solver.materials import LoopMaterials
from solver.scene import LoopScene

LARGE = LoopMaterials(700e3, 0.27e-3, 28e9, 0.5e-3, 25e-3)
SMALL = LoopMaterials(700e3, 0.27e-3, 28e9, 0.3e-3, 12.5e-3)


def test_table_i():
    """β of the paper's two arrays, with the loop radius as the length in β."""
    assert LARGE.beta == pytest.approx(0.01454, abs=5e-6)
    assert SMALL.beta == pytest.approx(0.01508, abs=5e-6)
    assert SMALL.beta / LARGE.beta == pytest.approx(1.037, abs=5e-4)


def test_units_of_the_large_array():
    assert LARGE.energy_unit_J == pytest.approx(0.118, abs=5e-4)
    assert LARGE.force_unit_N == pytest.approx(4.73, abs=0.01)
    assert LARGE.axial_stiffness == pytest.approx(1163, abs=1)
    assert LARGE.alpha(0.3) == pytest.approx(2.1e-5, abs=1e-6)


def test_beta_scales_with_the_fourth_power_over_the_third():
    thick = LoopMaterials(700e3, 0.27e-3, 28e9, 1.0e-3, 50e-3)
    assert thick.beta / LARGE.beta == pytest.approx(2**4 / 2**3)


@pytest.mark.parametrize(("poisson", "height"), [(0.45, 0.140), (0.3, 0.1312), (0.5, 0.1428)])
def test_height_of_the_large_array(poisson, height):
    scene = LoopScene(0.3, LARGE.beta, poisson, axial_stiffness=LARGE.axial_stiffness)
    assert solve_loop(scene).shape.height_over_perimeter == pytest.approx(height, abs=5e-4)
