"""Derivatives of every family of elements, what must not change it, and known values."""

import numpy as np
import pytest

from solver.loop_energy import scene_membrane
from solver.membrane import Membrane
from solver.mesh.array_mesh import Between, Grid, array_fan
from solver.mesh.bonds import BondEnergy, bond_energy
from solver.mesh.elements import Curvature
from solver.mesh.loop_mesh import loop_fan
from solver.mesh.plane_tensor import principal
from solver.mesh.rod_energy import AxialEnergy, BendingEnergy, WireStiffness, rod_energies
from solver.mesh.triangle_energy import triangle_energy
from solver.mesh.triangulation import embedded, refinements
from solver.scene import LoopScene

STIFFNESS = scene_membrane(LoopScene(0.3, 0.01, 0.3, modulus_ratio=1.4)).stiffness


def _triangles():
    mesh = refinements(loop_fan(), 1)[-1]
    return triangle_energy(mesh, 0.3, STIFFNESS), embedded(mesh.points)[mesh.triangles]


def _bends(natural_curvature=0.0):
    rng = np.random.default_rng(7)
    count = 30
    energy = BendingEnergy(
        np.arange(3 * count).reshape(-1, 3),
        rng.uniform(0.5, 2, count),
        np.full(count, natural_curvature),
    )
    corners = rng.normal(0, 0.4, (count, 3, 3)) + np.array([[0, 0, 0], [1, 0, 0], [1.8, 0.5, 0]])
    # some nearly straight, where series take over
    corners[:10] = np.array([[0.0, 0, 0], [1.0, 1e-3, 0], [2.0, 0, 0]])
    corners[:10] *= rng.uniform(0.5, 1.5, (10, 1, 1))
    return energy, corners


def _springs():
    rng = np.random.default_rng(8)
    energy = AxialEnergy(np.arange(40).reshape(-1, 2), rng.uniform(1, 5, 20), np.ones(20))
    return energy, rng.normal(size=(20, 2, 3))


def _bonds():
    rng = np.random.default_rng(9)
    energy = BondEnergy(np.arange(80).reshape(-1, 4), rng.uniform(1, 5, 20))
    return energy, rng.normal(size=(20, 4, 3))


FAMILIES = {
    "triangles": _triangles,
    "bends": _bends,
    "curved bends": lambda: _bends(0.8),
    "springs": _springs,
    "bonds": _bonds,
}


def _noisy(corners):
    return corners + np.random.default_rng(2).normal(0, 0.02, corners.shape)


@pytest.mark.parametrize("name", FAMILIES)
def test_derivatives_against_centred_differences(name):
    energy, corners = FAMILIES[name]()
    if name not in {"curved bends", "bends"}:
        corners = _noisy(corners)
    direction = np.random.default_rng(3).normal(size=corners.shape)
    step = 1e-6

    def at(amount):
        return energy.derivatives(corners + amount * direction, Curvature.TRUE)

    value, gradient, hessian = at(0.0)
    ahead, behind = at(step), at(-step)
    flat = direction.reshape(len(corners), -1)
    slope = np.sum(gradient * flat, axis=1)
    assert value == pytest.approx(energy.energies(corners))
    scale = 1 + np.abs(slope).max()
    assert (ahead[0] - behind[0]) / (2 * step) == pytest.approx(slope, rel=1e-5, abs=1e-6 * scale)
    bent = (hessian @ flat[:, :, None])[:, :, 0]
    difference = (ahead[1] - behind[1]) / (2 * step)
    scale = np.abs(bent).max(axis=1, keepdims=True)
    assert np.abs(difference - bent).max() < 1e-5 * scale.max()
    assert hessian == pytest.approx(np.swapaxes(hessian, 1, 2))


@pytest.mark.parametrize("name", FAMILIES)
def test_rigid_motions_change_no_energy(name):
    energy, corners = FAMILIES[name]()
    turn = np.linalg.qr(np.random.default_rng(4).normal(size=(3, 3)))[0]
    moved = energy.energies(corners @ turn + np.array([1.0, -2.0, 0.5]))
    assert moved == pytest.approx(energy.energies(corners), abs=1e-12)


@pytest.mark.parametrize("name", FAMILIES)
def test_convex_curvature_has_no_negative_eigenvalue(name):
    energy, corners = FAMILIES[name]()
    true = energy.derivatives(0.7 * _noisy(corners), Curvature.TRUE)
    convex = energy.derivatives(0.7 * _noisy(corners), Curvature.CONVEX)
    lowest = np.linalg.eigvalsh(convex[2])
    assert lowest.min() > -1e-10 * lowest.max()
    assert convex[1] == pytest.approx(true[1])
    assert np.linalg.eigvalsh(true[2]).min() < -1e-4


def test_convex_curvature_is_the_true_one_where_all_is_in_tension():
    energy, corners = _triangles()
    true, convex = (energy.derivatives(corners, c)[2] for c in (Curvature.TRUE, Curvature.CONVEX))
    assert convex == pytest.approx(true)


def test_unstretched_fabric_has_no_energy():
    energy, corners = _triangles()
    assert energy.energies(corners / 1.3) == pytest.approx(0, abs=1e-15)


def test_triangles_have_the_energy_of_the_membrane():
    """Under a uniform deformation nothing is lost to the mesh but the area beyond its edge."""
    mesh = refinements(loop_fan(), 2)[-1]
    membrane = Membrane(0.3, 0.4, 0.2, moduli=(1.1, 0.9))
    gradient = np.array([[0.9, 0.1], [-0.2, 1.1], [0.3, 0.2]])
    energy = triangle_energy(mesh, 0.3, membrane.stiffness)
    positions = mesh.points @ gradient.T
    whole = membrane.energy(gradient[None], np.array([mesh.areas.sum()]))
    assert energy.energies(positions[mesh.triangles]).sum() == pytest.approx(whole)


def test_stress_and_its_principal_values():
    energy, corners = _triangles()
    stress = energy.stress(_noisy(corners))
    low, high = principal(stress)
    matrices = stress[:, [[0, 2], [2, 1]]]
    values = np.linalg.eigvalsh(matrices)
    assert low == pytest.approx(values[:, 0])
    assert high == pytest.approx(values[:, 1])


def _ring(count, radius=1.0, natural_curvature=0.0):
    angle = np.arange(count) * (2 * np.pi / count)
    ring = radius * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    order = np.arange(count)
    rows = np.stack([np.roll(order, 1), order, np.roll(order, -1)], axis=1)
    energy = BendingEnergy(rows, np.full(count, 0.2), np.full(count, natural_curvature))
    return energy.energies(ring[rows]).sum()


def test_bending_of_a_circle_has_second_order():
    exact = 0.2 * 2 * np.pi / 0.7
    errors = [abs(_ring(count, 0.7) - exact) for count in (20, 40, 80)]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2, abs=0.05)
    assert np.log2(errors[1] / errors[2]) == pytest.approx(2, abs=0.02)


def test_a_circle_of_the_wires_own_curvature_costs_nothing():
    assert _ring(400, 0.5, 2.0) == pytest.approx(0, abs=1e-8)
    assert _ring(400, 1.0, 2.0) == pytest.approx(0.2 * 2 * np.pi, rel=1e-3)


def test_wires_rest_as_they_lie_flat():
    coarsest = array_fan(Grid(1, 1), Between.CUT)
    bending, springs = rod_energies(coarsest, (WireStiffness(0.1, 50.0),))
    assert len(bending.vertices) == len(springs.vertices) == 20
    flat = embedded(coarsest.points)
    assert springs.energies(flat[springs.vertices]) == pytest.approx(0)


def test_bonds_rest_on_parallel_tangents():
    mesh = refinements(array_fan(Grid(2, 3), Between.CUT), 1)[-1]
    bonds = bond_energy(mesh, 3.0)
    assert len(bonds.vertices) == 7
    flat = embedded(mesh.points)
    assert bonds.energies(flat[bonds.vertices]) == pytest.approx(0, abs=1e-12)
    # a hinge about the common tangent of the first pair costs nothing either
    ends = flat[bonds.vertices[:1]]
    ends[0, 2:] += np.array([0.0, 0.0, 0.4])
    assert bonds.energies(ends)[0] == pytest.approx(0, abs=1e-12)


def test_bond_energy_of_an_angle():
    ends = np.array([[[0, 0, 0], [1, 0, 0], [0, 0, 0], [np.cos(0.3), np.sin(0.3), 0]]])
    energy = BondEnergy(np.arange(4)[None], np.array([5.0]))
    assert energy.energies(ends)[0] == pytest.approx(5 * (1 - np.cos(0.3)))
