import pytest

from solver.materials import LoopMaterials
from solver.round_wire import solid_diameter, wire_diameter
from solver.scene import LoopScene


def test_the_large_arrays_wire():
    materials = LoopMaterials(700e3, 0.27e-3, 28e9, 0.5e-3, 25e-3)
    scene = LoopScene(0.3, materials.beta, 0.3, axial_stiffness=materials.axial_stiffness)
    assert wire_diameter(scene) == pytest.approx(0.5 / 25, rel=1e-12)


def test_a_wire_is_no_thicker_than_half_the_narrowest_loop():
    scene = LoopScene(0.3, 0.02, 0.3, axial_stiffness=1e-2, axis_ratio=10)
    assert wire_diameter(scene) == pytest.approx(min(scene.semi_axes) / 2)


def test_a_solid_wire_may_be_thicker_than_any_loop():
    assert solid_diameter(2.0, 1.0) == 8.0
