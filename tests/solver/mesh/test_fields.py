"""Stretch, stress and curvature in every place, where they are known."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from solver.mesh.fields import chain_curvature, fabric_fields
from solver.mesh.loop_mesh import loop_fan
from solver.mesh.triangulation import refined

STRAIN, POISSON = 0.3, 0.3
PLANE_STRESS = np.array([[1, POISSON, 0], [POISSON, 1, 0], [0, 0, (1 - POISSON) / 2]]) / (
    1 - POISSON**2
)


@pytest.mark.parametrize("seed", range(4))
def test_fabric_that_is_sheared_and_turned_has_the_principal_values_of_its_map(seed):
    rng = np.random.default_rng(seed)
    plane = np.eye(2) + 0.3 * rng.normal(size=(2, 2))
    turn = Rotation.random(random_state=seed).as_matrix()
    mesh = refined(loop_fan())
    flat = np.column_stack([mesh.points @ plane.T, np.zeros(len(mesh.points))])
    found = fabric_fields(mesh, flat @ turn.T, STRAIN, PLANE_STRESS, tension_field=False)
    larger, smaller = (1 + STRAIN) * np.linalg.svd(plane, compute_uv=False)
    assert found.larger_stretch == pytest.approx(larger)
    assert found.smaller_stretch == pytest.approx(smaller)
    # isotropic: stress and strain share their axes
    e = (np.array([larger, smaller]) ** 2 - 1) / 2
    high, low = (e + POISSON * e[::-1]) / (1 - POISSON**2)
    assert found.larger_stress == pytest.approx(high)
    assert found.smaller_stress == pytest.approx(low)


def test_fabric_that_wrinkles_bears_no_compression():
    mesh = loop_fan()
    pressed = np.column_stack([mesh.points * [0.5, 1.0], np.zeros(len(mesh.points))])
    plain, wrinkled = (
        fabric_fields(mesh, pressed, STRAIN, PLANE_STRESS, tension_field=field)
        for field in (False, True)
    )
    assert (plain.smaller_stress < 0).all()
    assert wrinkled.smaller_stress == pytest.approx(0, abs=1e-12)
    assert (wrinkled.larger_stress > 0).all()


def test_a_helix_has_its_curvature():
    along = np.linspace(0, 4 * np.pi, 400)
    helix = np.stack([2 * np.cos(along), 2 * np.sin(along), 0.5 * along], axis=1)
    assert chain_curvature(helix, closed=False) == pytest.approx(2 / (4 + 0.25), rel=1e-3)


def test_a_polygon_of_a_circle_has_the_circles_curvature():
    angle = np.linspace(0, 2 * np.pi, 12, endpoint=False)
    circle = 3 * np.stack([np.cos(angle), np.sin(angle), np.zeros(12)], axis=1)
    assert chain_curvature(circle, closed=True) == pytest.approx(1 / 3)
    assert chain_curvature(circle[:2], closed=False).tolist() == [0, 0]
