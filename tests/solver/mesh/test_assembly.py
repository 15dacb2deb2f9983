import numpy as np
import pytest

from solver.mesh.array_mesh import Between
from solver.mesh.assembly import block_pattern, family_assembly
from solver.mesh.elements import Curvature
from solver.mesh.mesh_energy import mesh_energy
from solver.mesh.problem import array_problem, loop_problem
from solver.mesh.rod_energy import AxialEnergy
from solver.mesh.scene import ArrayScene
from solver.mesh.triangulation import embedded
from solver.scene import LoopScene

LOOP = LoopScene(0.3, 0.0145, 0.3)


def _dense(pattern, entries):
    out = np.zeros((pattern.size, pattern.size))
    out[pattern.rows, pattern.columns] = entries
    return out + np.tril(out, -1).T


def _families():
    rng = np.random.default_rng(5)
    return [np.stack([rng.permutation(9)[:size] for _ in range(12)]) for size in (2, 3, 4)]


def test_assembly_against_dense_sums():
    rng = np.random.default_rng(6)
    families = _families()
    blocks = block_pattern(families, 9)
    pattern = blocks.lower()
    total, summed = np.zeros((27, 27)), np.zeros(len(pattern.rows))
    slopes, added = np.zeros(27), np.zeros(27)
    for family in families:
        assembly = family_assembly(family, blocks)
        size = 3 * family.shape[1]
        half = rng.normal(size=(len(family), size, size))
        hessians, gradients = half + np.swapaxes(half, 1, 2), rng.normal(size=(len(family), size))
        summed += assembly.hessian(hessians, len(pattern.rows))
        added += assembly.gradient(gradients, 27)
        for row, hessian, gradient in zip(assembly.unknowns, hessians, gradients, strict=True):
            total[np.ix_(row, row)] += hessian
            slopes[row] += gradient
    assert _dense(pattern, summed) == pytest.approx(total)
    assert added == pytest.approx(slopes)


def test_pattern_is_a_sorted_lower_triangle():
    pattern = block_pattern(_families(), 9).lower()
    assert np.all(pattern.rows >= pattern.columns)
    key = pattern.columns * pattern.size + pattern.rows
    assert np.all(np.diff(key) > 0)
    assert np.array_equal(pattern.rows[pattern.diagonal], np.arange(27))


PROBLEMS = [
    loop_problem(LOOP, 1),
    array_problem(ArrayScene(LOOP, 2, 2, Between.KEPT), 1),
]


@pytest.mark.parametrize("problem", PROBLEMS)
@pytest.mark.parametrize("curvature", [Curvature.TRUE, Curvature.CONVEX])
def test_whole_meshes_against_centred_differences(problem, curvature):
    rng = np.random.default_rng(0)
    energy = problem.energy(1)
    positions = embedded(problem.meshes[1].points)
    positions += rng.normal(0, 0.05, positions.shape)
    direction = rng.normal(size=positions.shape)
    step = 1e-6
    value, gradient, entries = energy.derivatives(positions, curvature)
    ahead, behind = (energy.derivatives(positions + s * direction) for s in (step, -step))
    assert value == pytest.approx(energy.value(positions))
    slope = float(np.sum(gradient * direction))
    assert (ahead[0] - behind[0]) / (2 * step) == pytest.approx(slope, rel=1e-6)
    if curvature is Curvature.TRUE:
        bent = _dense(energy.pattern, entries) @ direction.ravel()
        difference = (ahead[1] - behind[1]).ravel() / (2 * step)
        assert difference == pytest.approx(bent, rel=1e-5, abs=1e-6 * np.abs(bent).max())
    else:
        assert np.linalg.eigvalsh(_dense(energy.pattern, entries)).min() > -1e-9


def test_empty_families_are_left_out():
    nothing = AxialEnergy(np.zeros((0, 2), dtype=np.int64), np.zeros(0), np.zeros(0))
    something = AxialEnergy(np.array([[0, 1]]), np.ones(1), np.ones(1))
    energy = mesh_energy({"nothing": nothing, "springs": something}, 2)
    assert set(energy.terms(np.zeros((2, 3)))) == {"springs"}
