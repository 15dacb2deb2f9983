"""Ellipses and orthotropic fabric, against Surface Evolver and against their own limits."""

import csv
from pathlib import Path

import numpy as np
import pytest

from solver.branches import flat_state, leave, solve_branch, weakest_of
from solver.compact import solve_loop
from solver.disc_basis import disc_basis, transfer
from solver.equilibrium import Kind
from solver.errors import NotConvergedError
from solver.loop_energy import loop_energy
from solver.reading import Reading
from solver.scene import LoopScene
from solver.symmetry import ALIGNED, DIAGONAL, Mirrors, Symmetry
from solver.threshold import critical_beta

_ALL: tuple[Mirrors, ...] = ((0, 0), (1, 1), (1, 0), (0, 1))
ANYTHING = Symmetry(_ALL, _ALL)
REFERENCE = Path(__file__).parent / "data" / "evolver-ellipses.csv"
ROWS = list(csv.DictReader(REFERENCE.read_text().splitlines()))
# how far Evolver's mesh, k times refined, stays from its own limit: a quarter less each time
EVOLVER_TOLERANCE = {"2": 0.016, "3": 0.0045, "4": 0.001}


def _scene(row):
    return LoopScene(
        float(row["strain"]),
        float(row["beta"]),
        float(row["poisson"]),
        axis_ratio=float(row["axis_ratio"]),
    )


@pytest.mark.parametrize("row", ROWS)
def test_surface_evolver(row):
    scene, minimum = _scene(row), row["branch"] == "minimum"
    height = float(row["height_over_perimeter"])
    if minimum:
        found = solve_loop(scene)
        assert found.kind is Kind.DIAGONAL
        solved, energy = found.shape.height, found.energy
    else:
        branch = solve_branch(scene, ALIGNED, 1e-4)
        assert weakest_of(scene, branch).eigenvalue < -0.01
        solved, energy = branch.height, branch.minimum.value
    assert solved / (2 * np.pi) == pytest.approx(height, rel=EVOLVER_TOLERANCE[row["k"]])
    assert energy == pytest.approx(float(row["energy"]), rel=EVOLVER_TOLERANCE[row["k"]])


def test_limit_of_evolvers_meshes():
    """Richardson's extrapolation of its meshes k = 3 and k = 4."""
    found = solve_loop(LoopScene(0.3, 0.0145, 0.3, axis_ratio=1.5))
    limit = (4 * 0.12265702 - 0.12233944) / 3
    assert found.shape.height_over_perimeter == pytest.approx(limit, rel=2.5e-4)


def test_the_diagonal_saddle_is_lower():
    scene = LoopScene(0.3, 0.0145, 0.3, axis_ratio=1.5)
    diagonal, aligned = (solve_branch(scene, space, 1e-4) for space in (DIAGONAL, ALIGNED))
    assert diagonal.minimum.value < aligned.minimum.value - 1e-3
    assert weakest_of(scene, diagonal).eigenvalue > 0.1


def test_the_least_ellipse_is_the_circle():
    circle = solve_loop(LoopScene(0.3, 0.0145, 0.3), tolerance=1e-6)
    ellipse = solve_loop(LoopScene(0.3, 0.0145, 0.3, axis_ratio=1 + 1e-7), tolerance=1e-6)
    assert ellipse.shape.height == pytest.approx(circle.shape.height, rel=1e-6)
    assert ellipse.energy == pytest.approx(circle.energy, rel=1e-6)


def test_orthotropic_saddles_lie_along_the_moduli():
    found = solve_loop(LoopScene(0.3, 0.0145, 0.3, modulus_ratio=1.1))
    assert found.kind is Kind.ALIGNED
    assert found.lowest_eigenvalue > 0


def test_turning_the_fabric_by_a_quarter_changes_nothing():
    one, other = (
        solve_loop(LoopScene(0.3, 0.0145, 0.3, modulus_ratio=r), tolerance=1e-6)
        for r in (1.25, 1 / 1.25)
    )
    assert one.shape.height == pytest.approx(other.shape.height, rel=1e-7)
    assert one.energy == pytest.approx(other.energy, rel=1e-9)


def test_an_ellipse_on_orthotropic_fabric():
    """The ellipse asks for a saddle at 45°, the fabric for one along its axes."""
    found = solve_loop(LoopScene(0.3, 0.02, 0.3, axis_ratio=1.05, modulus_ratio=1.3))
    assert found.status == "converged"
    assert found.lowest_eigenvalue > 0


def test_the_fabric_decides_for_little_ellipses_and_the_ellipse_for_others():
    kinds = [
        solve_loop(LoopScene(0.3, 0.02, 0.3, axis_ratio=r, modulus_ratio=1.3)).kind
        for r in (1.05, 1.3)
    ]
    assert kinds == [Kind.ALIGNED, Kind.DIAGONAL]


def test_an_unstable_saddle_is_left_for_the_minimum():
    """From the saddle along an ellipse's axes downhill to the one at 45°."""
    scene = LoopScene(0.3, 0.0145, 0.3, axis_ratio=1.5)
    aligned = solve_branch(scene, ALIGNED, 1e-4)
    left = leave(scene, aligned, weakest_of(scene, aligned), 1e-4)
    assert left.minimum.converged
    assert left.minimum.value == pytest.approx(solve_loop(scene).energy, rel=1e-5)
    assert weakest_of(scene, left).eigenvalue > 0.1


def test_the_diagonal_saddle_writhes():
    """It has no mirror plane, so that the wire's twist, which is left out, would cost something."""
    found = solve_loop(LoopScene(0.3, 0.0145, 0.3, axis_ratio=1.5))
    twist = next(left for left in found.omitted if left.term == "twist of the wire")
    assert twist.matters
    assert 0.01 < twist.value < 0.03


@pytest.mark.parametrize("axis_ratio", [1.06, 1.08])
def test_one_of_the_two_saddles_is_a_minimum(axis_ratio):
    """Where the ellipse and the fabric nearly balance, too."""
    scene = LoopScene(0.3, 0.02, 0.3, axis_ratio=axis_ratio, modulus_ratio=1.3)
    solved = [solve_branch(scene, space, 1e-5) for space in (DIAGONAL, ALIGNED)]
    stiffness = [weakest_of(scene, branch).eigenvalue for branch in solved]
    lower = int(solved[1].minimum.value < solved[0].minimum.value)
    assert stiffness[lower] > 0 > stiffness[1 - lower]


@pytest.mark.parametrize("space", [DIAGONAL, ALIGNED])
def test_classes_of_motions_hold_all_motions(space):
    """The second variation among all shapes at once has the same lowest eigenvalue."""
    scene = LoopScene(0.3, 0.0145, 0.3, axis_ratio=1.5)
    branch = solve_branch(scene, space, 3e-3)
    weakest = weakest_of(scene, branch)
    basis = disc_basis(branch.basis.degree, ANYTHING)
    q = transfer(branch.basis, basis) @ branch.unknowns
    eigenvalues = np.linalg.eigvalsh(loop_energy(scene, basis).derivatives(q)[2])
    free = np.argsort(np.abs(eigenvalues))[:6]
    rest = np.delete(eigenvalues, free)
    assert np.abs(eigenvalues[free]).max() < 1e-5
    assert rest[0] == pytest.approx(weakest.eigenvalue, rel=1e-5)


def test_flat_ellipse_and_its_threshold():
    """A thin wire lets the flat ellipse's sides come in; a thick one keeps it flat."""
    critical = critical_beta(0.3, 0.3, Reading.PLANE_STRESS)
    flat = solve_loop(LoopScene(0.3, 1.3 * critical, 0.3, axis_ratio=1.5))
    assert flat.kind is Kind.FLAT
    assert flat.shape.height == 0
    assert flat.lowest_eigenvalue > 0
    assert solve_loop(LoopScene(0.3, 0.7 * critical, 0.3, axis_ratio=1.5)).buckled


def test_flat_state_of_a_nearly_round_loop_buckles_like_the_circle():
    critical = critical_beta(0.3, 0.3, Reading.PLANE_STRESS)
    for factor, sign in ((1.001, 1), (0.999, -1)):
        scene = LoopScene(0.3, factor * critical, 0.3, axial_stiffness=1e6, axis_ratio=1.00001)
        assert np.sign(flat_state(scene)[1].eigenvalue) == sign


def test_slack_fabric_in_a_long_ellipse_is_refused():
    with pytest.raises(NotConvergedError, match="not a minimum"):
        solve_loop(LoopScene(0.3, 0.0145, 0.3, axis_ratio=3.0))


def test_a_long_ellipse_of_stiffer_wire():
    found = solve_loop(LoopScene(0.3, 0.025, 0.3, axis_ratio=3.0))
    assert found.kind is Kind.DIAGONAL
    assert found.lowest_eigenvalue > 0
