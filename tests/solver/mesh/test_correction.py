"""Steps that are bent along the valley of a stiff wire."""

import numpy as np
import pytest

from solver.errors import SceneError
from solver.mesh.array_mesh import Between
from solver.mesh.correction import Move, corrected
from solver.mesh.descent import mass_of
from solver.mesh.elements import Curvature
from solver.mesh.factorization import factoriser
from solver.mesh.krylov import QuadraticModel, symmetric_product
from solver.mesh.problem import array_problem, loop_problem
from solver.mesh.scene import ArrayScene
from solver.mesh.solve import solve_array, solve_loop_mesh
from solver.mesh.triangulation import GAP, embedded
from solver.scene import LoopScene

LOOP = LoopScene(0.3, 0.0145, 0.3)
PROBLEM = loop_problem(LOOP, 2)
MESH, ENERGY = PROBLEM.meshes[-1], PROBLEM.energy(2)


def _model(positions, stiffening=1.0):
    """Model of the energy about a shape, every motion held by a part of the mass."""
    _, gradient, entries = ENERGY.derivatives(positions)
    entries[ENERGY.pattern.diagonal] += stiffening * np.repeat(mass_of(MESH), 3)
    product = symmetric_product(ENERGY.pattern, entries)
    inverse = factoriser(ENERGY.pattern).factorise(entries).solve
    return QuadraticModel(gradient.ravel(), product, product, inverse, convex=True)


def _turned(positions, angle):
    """Displacement of a turn about the x axis, taken to first order: it stretches everything."""
    return angle * np.cross([1.0, 0.0, 0.0], positions)


def _moved_by(angle):
    flat = embedded(MESH.points)
    move = _turned(flat, angle)
    return flat, Move(move, ENERGY.value(flat + move))


@pytest.mark.parametrize("name", ["wire stretch", "fabric stretch"])
def test_the_excess_is_what_is_not_linear_in_the_move(name):
    """It grows with the square of the move."""
    (elements,) = ENERGY.families[name]
    rng = np.random.default_rng(0)
    positions = embedded(MESH.points) + rng.normal(0, 0.01, (len(MESH.points), 3))
    direction = rng.normal(size=positions.shape)
    where = elements.vertices

    def excess(size, reached_size):
        move, reached = size * direction, positions + reached_size * direction
        return elements.excess(positions[where], move[where], reached[where])

    large, small = excess(1e-3, 1e-3), excess(1e-4, 1e-4)
    assert np.abs(large).max() > 0
    assert np.linalg.norm(small) == pytest.approx(1e-2 * np.linalg.norm(large), rel=0.05)
    # of no move, it is the pull of the stretch that is there: linear, by the material stiffness
    linear, half = excess(0.0, 1e-6), excess(0.0, 5e-7)
    assert half == pytest.approx(linear / 2, abs=1e-3 * np.abs(linear).max())
    assert np.abs(linear).max() > 1e-6


def test_excess_of_no_move_is_the_change_of_the_force():
    """Of a wire that grows without turning."""
    (wire,) = ENERGY.families["wire stretch"]
    flat = embedded(MESH.points)
    grown = 1e-3 * flat
    nothing = np.zeros_like(flat)
    where = wire.vertices
    found = wire.excess(flat[where], nothing[where], (flat + grown)[where])
    before, after = (
        wire.derivatives(positions[where], Curvature.TRUE)[1] for positions in (flat, flat + grown)
    )
    assert found == pytest.approx(after - before, rel=1e-9)


def test_a_turn_taken_to_first_order_is_bent_back():
    flat, straight = _moved_by(0.2)
    model = _model(flat)
    now = ENERGY.value(flat)
    assert straight.value > now + 0.1
    bent = corrected(ENERGY, model, flat, straight, now)
    assert bent.value < now + 0.1 * (straight.value - now)
    assert bent.value == pytest.approx(ENERGY.value(flat + bent.displacement))
    # it still turns
    assert np.corrcoef(bent.displacement.ravel(), straight.displacement.ravel())[0, 1] > 0.95


@pytest.mark.parametrize("wrong", [-1e3, -1e-6])
def test_what_no_correction_helps_is_left_alone(wrong):
    """Neither one that is far too long nor a short one that leads uphill is taken."""
    flat, straight = _moved_by(0.2)
    model = QuadraticModel(
        np.zeros(flat.size), lambda v: v, lambda v: v, lambda v: wrong * v, convex=True
    )
    bent = corrected(ENERGY, model, flat, straight, ENERGY.value(flat))
    assert bent is straight


def test_arrays_with_their_fabric_kept_take_few_steps():
    """Without corrections it takes twice as many."""
    found = solve_array(ArrayScene(LOOP, 3, 3, Between.KEPT), refinement=1)
    assert found.status == "converged"
    assert found.steps < 70
    assert found.energy == pytest.approx(2.9777034, rel=1e-7)


@pytest.mark.parametrize("segments", [4, 18, 0])
def test_fans_whose_contacts_would_lie_between_vertices_are_refused(segments):
    with pytest.raises(SceneError, match=f"segments = {segments}: must be a multiple of 4"):
        solve_loop_mesh(LOOP, segments=segments)


@pytest.mark.parametrize("segments", [8, 36])
def test_fans_of_any_number_of_segments(segments):
    scene = ArrayScene(LOOP, 3, 2, Between.KEPT)
    problem = array_problem(scene, 1, segments=segments)
    coarse, fine = problem.meshes
    assert [int(np.sum(coarse.region == k)) for k in range(6)] == [segments] * 6
    assert np.sum(coarse.region == GAP) >= 2 * segments
    assert len(fine.wires[0].vertices) == 2 * segments
    # the rectangle about the loops less its four corners' and six half gaps outside
    whole = np.pi * 6 + 2 * (4 - np.pi)
    assert fine.areas.sum() == pytest.approx(whole, rel=0.5 / segments)
