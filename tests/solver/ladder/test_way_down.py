"""Minima but for a way down that gains next to nothing."""

import pytest

from solver.ladder.choose import solve_scene
from solver.ladder.fidelity import Fidelity
from solver.mesh.array_mesh import Between
from solver.mesh.scene import ArrayScene
from solver.scene import LoopScene

SLACK = LoopScene(0.3, 0.002, 0.3)
TURNED = ArrayScene(LoopScene(0.3, 0.0145, 0.3, modulus_ratio=0.8), 1, 2, Between.CUT)


@pytest.mark.parametrize(("scene", "most"), [(SLACK, 1e-6), (TURNED, 1e-7)])
def test_negative_eigenvalues_are_told_with_what_they_gain(scene, most):
    answer = solve_scene(scene, fidelity=Fidelity.MESH, refinement=1)
    found = answer.equilibrium
    assert found.status == "converged"
    assert found.lowest_eigenvalue < 0 < found.negative_eigenvalues
    assert 0 < found.way_down <= most
    assert f"{found.negative_eigenvalues} negative eigenvalues" in answer.reason


@pytest.mark.parametrize("beta", [0.01, 0.02])
def test_taut_fabric_has_none(beta):
    answer = solve_scene(LoopScene(0.3, beta, 0.3), fidelity=Fidelity.MESH, refinement=2)
    assert answer.equilibrium.negative_eigenvalues == 0
    assert "negative" not in answer.reason
