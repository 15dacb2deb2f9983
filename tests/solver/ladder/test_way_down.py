"""Minima of wrinkled fabric, whose stiffness has kinks."""

import pytest

from solver.ladder.choose import solve_scene
from solver.ladder.fidelity import Fidelity
from solver.scene import LoopScene


def test_negative_eigenvalues_are_told_with_what_they_gain():
    answer = solve_scene(LoopScene(0.3, 0.002, 0.3), tolerance=0.01)
    found = answer.equilibrium
    assert found.status == "converged"
    assert found.lowest_eigenvalue < 0 < found.negative_eigenvalues
    assert 0 <= found.way_down <= 1e-6
    assert f"{found.negative_eigenvalues} negative eigenvalues" in answer.reason


@pytest.mark.parametrize("beta", [0.01, 0.02])
def test_taut_fabric_has_none(beta):
    answer = solve_scene(LoopScene(0.3, beta, 0.3), fidelity=Fidelity.MESH, refinement=2)
    assert answer.equilibrium.negative_eigenvalues == 0
    assert "negative" not in answer.reason
