"""The fabric's bending on a mesh: derivatives, Surface Evolver's number, the compact limit."""

import numpy as np
import pytest

from solver.compact import solve_loop
from solver.mesh.array_mesh import Between, Grid, array_fan
from solver.mesh.corner_area import CornerArea
from solver.mesh.elements import Curvature
from solver.mesh.loop_mesh import loop_fan
from solver.mesh.scene import ArrayScene
from solver.mesh.solve import solve_array, solve_loop_mesh
from solver.mesh.star_bending import star_bending, star_gauss_integral, stars
from solver.mesh.triangulation import embedded, refinements
from solver.scene import LoopScene


def _noisy_stars():
    mesh = refinements(loop_fan(), 1)[-1]
    positions = embedded(mesh.points)
    positions += np.random.default_rng(1).normal(0, 0.03, positions.shape)
    return [(stars, positions[stars.vertices]) for stars in star_bending(mesh, 0.7)]


def _energy(mesh, positions, alpha=1.0):
    return sum(e.energies(positions[e.vertices]).sum() for e in star_bending(mesh, alpha))


def test_derivatives_of_areas():
    rng = np.random.default_rng(0)
    corners, direction, step = rng.normal(size=(9, 3, 3)), rng.normal(size=(9, 3, 3)), 1e-6
    at, flat = CornerArea(corners), direction.reshape(9, 9)
    ahead, behind = (CornerArea(corners + s * step * direction) for s in (1, -1))
    slope = (ahead.area - behind.area) / (2 * step)
    assert np.sum(at.gradient() * flat, axis=1) == pytest.approx(slope, abs=1e-8)
    bent = (ahead.gradient() - behind.gradient()) / (2 * step)
    assert (at.hessian() @ flat[:, :, None])[:, :, 0] == pytest.approx(bent, abs=1e-8)
    direction[:, 1:] = 0
    ahead, behind = (CornerArea(corners + s * step * direction) for s in (1, -1))
    change = (ahead.hessian() - behind.hessian()) / (2 * step)
    assert at.hessian_change(direction[:, 0]) == pytest.approx(change, abs=1e-7)


def test_derivatives_against_centred_differences():
    rng, step = np.random.default_rng(2), 1e-7
    for energy, corners in _noisy_stars():
        direction = rng.normal(size=corners.shape)
        flat = direction.reshape(len(corners), -1)
        ahead, behind = (
            energy.derivatives(corners + s * step * direction, Curvature.TRUE) for s in (1, -1)
        )
        value, gradient, hessian = energy.derivatives(corners, Curvature.TRUE)
        assert value == pytest.approx(energy.energies(corners))
        slope = (ahead[0] - behind[0]) / (2 * step)
        assert np.sum(gradient * flat, axis=1) == pytest.approx(slope, rel=1e-5, abs=1e-5)
        bent = (ahead[1] - behind[1]) / (2 * step)
        scale = np.abs(bent).max()
        assert (hessian @ flat[:, :, None])[:, :, 0] == pytest.approx(bent, abs=1e-5 * scale)
        assert hessian == pytest.approx(np.swapaxes(hessian, 1, 2))


def test_convex_curvature_has_no_negative_eigenvalue():
    for energy, corners in _noisy_stars():
        true, convex = (energy.derivatives(corners, c) for c in (Curvature.TRUE, Curvature.CONVEX))
        lowest = np.linalg.eigvalsh(convex[2])
        assert lowest.min() > -1e-10 * lowest.max()
        assert np.linalg.eigvalsh(true[2]).min() < -1e-3
        assert convex[1] == pytest.approx(true[1])


def test_size_and_attitude_change_nothing():
    turn = np.linalg.qr(np.random.default_rng(4).normal(size=(3, 3)))[0]
    for energy, corners in _noisy_stars():
        moved = energy.energies(2.5 * corners @ turn + np.array([1.0, -2.0, 0.5]))
        assert moved == pytest.approx(energy.energies(corners))


def test_the_number_of_surface_evolver():
    """Its sq_mean_curvature, summed over the inner vertices of the same surface."""
    mesh = refinements(loop_fan(), 2)[-1]
    x, y = mesh.points.T
    surface = np.stack([x, y, 0.3 * (x * x - y * y)], axis=1)
    assert _energy(mesh, surface) == pytest.approx(0.00187079349351554, rel=1e-12)
    assert _energy(mesh, embedded(mesh.points)) == pytest.approx(0, abs=1e-25)


def test_a_sphere_but_for_the_strip_along_its_edge():
    errors, defects = [], []
    for mesh in refinements(loop_fan(), 4)[2:]:
        x, y = mesh.points.T
        cap = np.stack([x, y, np.sqrt(4 - x * x - y * y)], axis=1)
        exact = 2 * np.pi * (1 - np.sqrt(0.75))
        errors.append(exact - _energy(mesh, cap))
        defects.append(exact - star_gauss_integral(mesh, cap))
    for lack in (errors, defects):
        assert min(lack) > 0
        assert lack[1] / lack[2] == pytest.approx(2, rel=0.05)


@pytest.mark.parametrize("between", list(Between))
def test_only_inner_vertices_have_stars(between):
    mesh = array_fan(Grid(1, 2), between)
    assert sorted(len(rows) for rows in stars(mesh)) == [2]
    finer = refinements(mesh, 1)[-1]
    inner = np.concatenate([rows[:, 0] for rows in stars(finer)])
    on_wire = np.concatenate([wire.vertices for wire in finer.wires])
    assert len(set(inner.tolist())) == len(inner)
    assert not set(inner.tolist()) & set(on_wire.tolist())
    assert len(inner) + len(set(on_wire.tolist())) == len(finer.points)


def test_fabric_kept_on_both_sides_bends_across_the_wire():
    mesh = refinements(array_fan(Grid(2, 2), Between.KEPT), 1)[-1]
    on_wire = {int(v) for wire in mesh.wires for v in wire.vertices}
    inner = {int(v) for rows in stars(mesh) for v in rows[:, 0]}
    # the quarters of four wires about the one gap, less the shared contacts' outer stars
    assert len(inner & on_wire) == 4 * 9
    assert all(len(set(row.tolist())) == len(row) for rows in stars(mesh) for row in rows)


@pytest.mark.parametrize(
    ("alpha", "axis_ratio"), [(1e-3, 1.0), (0.1, 1.0), (1e-3, 1.5), (1.0, 1.0)]
)
def test_the_compact_solver_agrees(alpha, axis_ratio):
    scene = LoopScene(0.3, 0.0145, 0.3, axis_ratio=axis_ratio, alpha=alpha)
    exact = solve_loop(scene, tolerance=1e-5)
    found = [solve_loop_mesh(scene, refinement=k) for k in (1, 2, 3)]
    for quantity, limit in (
        ([f.energy for f in found], exact.energy),
        ([f.height_over_perimeter for f in found], exact.shape.height_over_perimeter),
    ):
        changes = np.diff(quantity)
        assert np.log2(changes[0] / changes[1]) == pytest.approx(2, abs=0.35)
        assert quantity[-1] + changes[-1] / 3 == pytest.approx(limit, rel=1e-3)
    assert found[-1].lowest_eigenvalue > -1e-4


def test_stiff_fabric_on_a_fine_mesh():
    """Straight from the coarser mesh, whose kinks it inherits, it would crush triangles."""
    found = solve_loop_mesh(LoopScene(0.3, 0.0145, 0.3, alpha=1.0), refinement=4)
    assert found.status == "converged"
    assert found.height_over_perimeter == pytest.approx(0.131305, rel=1e-3)


def test_an_array_with_stiff_fabric():
    scenes = [
        ArrayScene(LoopScene(0.3, 0.02, 0.3, alpha=alpha), 1, 2, Between.CUT) for alpha in (0, 1e-3)
    ]
    bare, stiff = (solve_array(scene, refinement=1) for scene in scenes)
    one = solve_loop_mesh(scenes[1].loop, refinement=1)
    assert stiff.energy == pytest.approx(2 * one.energy, rel=1e-4)
    assert 0 < stiff.energy_terms["fabric bending"] < 1e-3 * stiff.energy
    assert stiff.energy > bare.energy
