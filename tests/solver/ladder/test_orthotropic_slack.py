"""Slack fabric with different moduli along x and y: the paper's own differs by a tenth."""

import pytest

from solver.ladder.choose import solve_scene
from solver.ladder.fidelity import Fidelity
from solver.mesh.solve import solve_loop_mesh
from solver.scene import LoopScene

TOLERANCE = 0.01


def _slack(modulus_ratio):
    return LoopScene(0.3, 0.002, 0.3, modulus_ratio=modulus_ratio)


@pytest.fixture(scope="module")
def isotropic():
    return solve_scene(_slack(1.0), tolerance=TOLERANCE)


@pytest.mark.parametrize("modulus_ratio", [1.0001, 1.1])
def test_it_gets_a_tension_field_as_isotropic_fabric_does(isotropic, modulus_ratio):
    scene = _slack(modulus_ratio)
    answer = solve_scene(scene, tolerance=TOLERANCE)
    mesh = solve_scene(scene, tolerance=TOLERANCE, fidelity=Fidelity.MESH)
    assert "tension field" in answer.reason
    assert "fabric stretch (tension field)" in answer.terms
    for other in (mesh, isotropic):
        assert answer.terms == other.terms
        assert answer.height_over_perimeter == pytest.approx(other.height_over_perimeter, rel=5e-4)
    assert answer.equilibrium.energy == pytest.approx(mesh.equilibrium.energy, rel=1e-9)
    # exchanging x and y leaves the isotropic loop as it is: no term of the first order
    change = 0.1 * (modulus_ratio - 1) ** 2
    assert answer.equilibrium.energy == pytest.approx(
        isotropic.equilibrium.energy, rel=change + 1e-6
    )


def test_a_quarter_turn_of_the_fabric_turns_the_loop():
    one, other = (
        solve_loop_mesh(_slack(r), refinement=2, tension_field=True) for r in (1.3, 1 / 1.3)
    )
    assert other.energy == pytest.approx(one.energy, rel=1e-6)
    assert other.height == pytest.approx(one.height, rel=1e-3)
    assert one.compressed_fraction > 0.1
