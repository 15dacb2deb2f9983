"""Large grids from small ones."""

import numpy as np
import pytest

from solver.mesh.array_mesh import Between, Grid
from solver.mesh.circle_sheet import sheet_of
from solver.mesh.face_mesh import smallest_angles
from solver.mesh.grown_start import best_motion, grown_start, smaller
from solver.mesh.problem import array_problem
from solver.mesh.scene import ArrayScene
from solver.mesh.solve import solve_array
from solver.mesh.solve_sheet import solve_sheet
from solver.mesh.triangulation import embedded
from solver.scene import LoopScene

LOOP = LoopScene(0.3, 0.0145, 0.3)


def _mesh(grid, refinement=1):
    scene = ArrayScene(LOOP, grid.rows, grid.columns, Between.KEPT)
    return array_problem(scene, refinement).meshes[-1]


def _rolled(points, curvature=0.3):
    """Points (n, 2) on a cylinder about an axis along y, with a ripple from loop to loop."""
    ripple = 0.05 * np.cos(np.pi * points[:, 0]) * np.cos(np.pi * points[:, 1])
    angle, radius = curvature * points[:, 0], 1 / curvature + ripple
    return np.stack([radius * np.sin(angle), 0.8 * points[:, 1], -radius * np.cos(angle)], axis=1)


@pytest.mark.parametrize(
    ("small", "large"), [((3, 3), (3, 5)), ((3, 3), (6, 4)), ((2, 3), (2, 6)), ((4, 5), (7, 10))]
)
def test_a_rolled_grid_grows_along_its_roll(small, large):
    """What repeats itself but for a rigid motion is continued exactly."""
    small, large = Grid(*small), Grid(*large)
    coarse, fine = _mesh(small), _mesh(large)
    found = grown_start(coarse, small, _rolled(coarse.points), fine, large)
    assert found == pytest.approx(_rolled(fine.points), abs=1e-9)


def test_a_flat_grid_stays_flat_and_a_shape_may_lie_anywhere():
    small, large = Grid(3, 3), Grid(5, 4)
    coarse, fine = _mesh(small), _mesh(large)
    assert grown_start(coarse, small, embedded(coarse.points), fine, large) == pytest.approx(
        embedded(fine.points), abs=1e-12
    )
    turn = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
    moved = _rolled(coarse.points) @ turn + [1.0, 2.0, 3.0]
    found = grown_start(coarse, small, moved, fine, large)
    assert found == pytest.approx(_rolled(fine.points) @ turn + [1.0, 2.0, 3.0], abs=1e-9)


def test_the_best_motion_is_a_turn():
    rng = np.random.default_rng(0)
    start = rng.normal(size=(9, 3))
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    turn *= np.linalg.det(turn)
    motion = best_motion(start, start @ turn + [1.0, 2.0, 3.0])
    assert motion.turn == pytest.approx(turn)
    assert motion.moved(start) == pytest.approx(start @ turn + [1.0, 2.0, 3.0])
    # never a reflection
    assert np.linalg.det(best_motion(start, -start).turn) == pytest.approx(1)
    twice = motion.repeated(2)[-1]
    assert twice.moved(start) == pytest.approx(motion.moved(motion.moved(start)))


def test_grids_shrink_to_three_by_three():
    assert smaller(Grid(10, 20)) == Grid(5, 10)
    assert smaller(Grid(5, 3)) == Grid(3, 3)
    assert smaller(Grid(2, 7)) == Grid(2, 4)
    assert smaller(Grid(3, 2)) == Grid(3, 2)


@pytest.mark.parametrize("segments", [20, 28])
def test_gaps_are_meshed_alike_and_mirror_symmetric(segments):
    scene = ArrayScene(LOOP, 3, 3, Between.KEPT)
    mesh = array_problem(scene, 1, segments=segments).meshes[-1]
    gaps = mesh.points[mesh.triangles[mesh.region == -1]].mean(axis=1)
    key = np.round(gaps % 2, 6)
    for image in (key, np.round((2 - gaps) % 2, 6)):
        assert len(np.unique(image, axis=0)) == len(gaps) / 4
    assert {tuple(p) for p in key} == {tuple(p) for p in np.round((2 - gaps) % 2, 6)}
    assert smallest_angles(mesh.points, mesh.triangles).min() > 6


def test_a_large_grid_settles_where_a_small_one_does():
    """Energies of loops, edges and corners add up: what the middle adds does not depend on size."""
    found = {
        n: solve_array(ArrayScene(LOOP, n, n, Between.KEPT), refinement=1, tension_field=True)
        for n in (3, 4, 5, 6)
    }
    assert all(one.status == "converged" for one in found.values())
    energies = np.array([found[n].energy for n in (3, 4, 5, 6)])
    # quadratic in n: the third differences vanish
    assert abs(np.diff(energies, 3)[0]) < 2e-3 * np.diff(energies)[0]
    assert found[6].lowest_eigenvalue > 0
    assert found[6].coarser_height > 0


def test_a_grid_is_a_minimum_among_all_shapes_too():
    """From its shape, a little out of symmetry, nothing lower is found."""
    scene = ArrayScene(LOOP, 2, 2, Between.KEPT)
    grown = solve_array(scene, refinement=1, tension_field=True)
    rng = np.random.default_rng(0)
    pushed = grown.positions + rng.normal(0, 3e-3, grown.positions.shape)
    again = solve_array(scene, refinement=1, tension_field=True, start=pushed)
    assert again.energy == pytest.approx(grown.energy, rel=1e-7)
    assert again.height == pytest.approx(grown.height, rel=2e-3)


def test_fabric_that_differs_by_direction_grows_as_well():
    """The scene that knows nothing of mirror planes has no lower energy."""
    loop = LoopScene(0.3, 0.0145, 0.3, modulus_ratio=1.1)
    grid = ArrayScene(loop, 2, 2, Between.KEPT)
    grown = solve_array(grid, refinement=1, tension_field=True)
    free = solve_sheet(sheet_of(grid), refinement=1, tension_field=True)
    assert grown.energy == pytest.approx(free.energy, rel=1e-7)
