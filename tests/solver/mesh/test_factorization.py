import numpy as np
import pytest

from solver.mesh.elements import Curvature
from solver.mesh.factorization import available, factoriser
from solver.mesh.problem import loop_problem
from solver.mesh.triangulation import embedded
from solver.scene import LoopScene

PROBLEM = loop_problem(LoopScene(0.3, 0.0145, 0.3), 1)
ENERGY = PROBLEM.energy(1)
PATTERN = ENERGY.pattern


def _entries(curvature, shift):
    rng = np.random.default_rng(1)
    positions = embedded(PROBLEM.meshes[1].points)
    positions += rng.normal(0, 0.05, positions.shape)
    entries = ENERGY.derivatives(positions, curvature)[2]
    entries[PATTERN.diagonal] += shift
    return entries


def _dense(entries):
    out = np.zeros((PATTERN.size, PATTERN.size))
    out[PATTERN.rows, PATTERN.columns] = entries
    return out + np.tril(out, -1).T


def test_scipys_own_backend_is_always_there():
    assert available()[-1] == "superlu"


@pytest.mark.parametrize("backend", available())
@pytest.mark.parametrize(
    ("curvature", "shift"),
    [(Curvature.TRUE, 1e-3), (Curvature.CONVEX, 1e-3), (Curvature.TRUE, -0.3)],
)
def test_solutions_and_inertia_against_dense(backend, curvature, shift):
    entries = _entries(curvature, shift)
    matrix = _dense(entries)
    factored = factoriser(PATTERN, backend).factorise(entries)
    assert factored.negative == int(np.sum(np.linalg.eigvalsh(matrix) < 0))
    right = np.random.default_rng(2).normal(size=(PATTERN.size, 3))
    exact = np.linalg.solve(matrix, right)
    scale = np.abs(exact).max()
    assert factored.solve(right) == pytest.approx(exact, abs=1e-7 * scale)
    assert factored.solve(right[:, 0].copy()) == pytest.approx(exact[:, 0], abs=1e-7 * scale)


@pytest.mark.parametrize("backend", available())
def test_one_factoriser_takes_many_matrices(backend):
    factors = factoriser(PATTERN, backend)
    right = np.random.default_rng(3).normal(size=PATTERN.size)
    for shift in (1e-3, 0.5, -0.3, 2.0):
        entries = _entries(Curvature.TRUE, shift)
        factored = factors.factorise(entries)
        matrix = _dense(entries)
        assert factored.negative == int(np.sum(np.linalg.eigvalsh(matrix) < 0))
        exact = np.linalg.solve(matrix, right)
        assert factored.solve(right) == pytest.approx(exact, abs=1e-7 * np.abs(exact).max())
