"""Shapes that are their own images in two planes, told by a quarter of their vertices."""

import numpy as np
import pytest

from solver.mesh.array_mesh import Between
from solver.mesh.descent import mass_of
from solver.mesh.elements import Curvature
from solver.mesh.krylov import symmetric_product
from solver.mesh.mirror import mirrors
from solver.mesh.orbits import one_of_each
from solver.mesh.problem import array_problem, loop_problem
from solver.mesh.scene import ArrayScene
from solver.mesh.start import array_start
from solver.scene import LoopScene

LOOP = LoopScene(0.3, 0.0145, 0.3, alpha=1e-3, twist_ratio=2 / 3)
GRIDS = [(2, 2), (2, 3), (3, 3)]


def _problem(rows, columns, *, tension_field=False):
    scene = ArrayScene(LOOP, rows, columns, Between.KEPT)
    return array_problem(scene, 1, tension_field=tension_field)


def _shape(mesh, planes, size=0.02):
    """A symmetric shape without a plane: everything in it is strained."""
    rng = np.random.default_rng(1)
    few = planes.few(array_start(mesh))
    return planes.few(planes.all(few + rng.normal(0, size, few.shape)))


@pytest.mark.parametrize(("rows", "columns"), GRIDS)
@pytest.mark.parametrize("tension_field", [False, True])
def test_a_quarter_has_the_energy_of_the_whole(rows, columns, tension_field):
    problem = _problem(rows, columns, tension_field=tension_field)
    planes = mirrors(problem.meshes[1])
    whole, quarter = problem.energy(1), problem.mirrored_energy(1, planes)
    few = _shape(problem.meshes[1], planes)
    expected, found = whole.terms(planes.all(few)), quarter.terms(few)
    assert found.keys() == expected.keys()
    assert all(found[name] == pytest.approx(expected[name], rel=1e-12) for name in found)
    assert {"bonds", "fabric bending", "wire twist"} <= found.keys()
    assert quarter.value(few) == pytest.approx(whole.value(planes.all(few)), rel=1e-12)


@pytest.mark.parametrize(("rows", "columns"), GRIDS)
def test_derivatives_are_those_of_the_energy(rows, columns):
    problem = _problem(rows, columns)
    planes = mirrors(problem.meshes[1])
    energy = problem.mirrored_energy(1, planes)
    few = _shape(problem.meshes[1], planes)
    value, gradient, entries = energy.derivatives(few)
    assert value == pytest.approx(energy.value(few))
    step = np.random.default_rng(2).normal(size=few.shape)
    # no step leads across a plane
    step = planes.few(planes.moves(step))
    size = 1e-5
    ahead, back = (energy.derivatives(few + sign * size * step) for sign in (1, -1))
    slope = (ahead[0] - back[0]) / (2 * size)
    assert slope == pytest.approx(float((gradient * step).sum()), rel=1e-6)
    bent = symmetric_product(energy.pattern, entries)(step.ravel())
    assert bent == pytest.approx(
        ((ahead[1] - back[1]) / (2 * size)).ravel(), abs=1e-4 * np.abs(bent).max()
    )


def test_it_is_the_whole_energy_among_symmetric_shapes():
    """Gradient and Hessian, pulled back by the linear map from the few to all."""
    problem = _problem(2, 3)
    planes = mirrors(problem.meshes[1])
    whole, quarter = problem.energy(1), problem.mirrored_energy(1, planes)
    few = _shape(problem.meshes[1], planes)
    step = np.random.default_rng(3).normal(size=few.shape)
    step = planes.few(planes.moves(step))
    for curvature in Curvature:
        _, gradient, entries = whole.derivatives(planes.all(few), curvature)
        _, pulled, own = quarter.derivatives(few, curvature)
        assert pulled == pytest.approx(planes.pulls(gradient), abs=1e-10)
        bent = symmetric_product(whole.pattern, entries)(planes.moves(step).ravel())
        expected = planes.pulls(bent.reshape(-1, 3)).ravel()
        assert symmetric_product(quarter.pattern, own)(step.ravel()) == pytest.approx(
            expected, abs=1e-9 * np.abs(expected).max()
        )
    reached = few + 1.1 * step
    expected = whole.excess(planes.all(few), planes.moves(step), planes.all(reached))
    assert quarter.excess(few, step, reached) == pytest.approx(
        planes.pulls(expected.reshape(-1, 3)).ravel(), abs=1e-9 * np.abs(expected).max()
    )


def test_components_across_a_plane_stay():
    problem = _problem(3, 3)
    planes = mirrors(problem.meshes[1])
    energy = problem.mirrored_energy(1, planes)
    few = _shape(problem.meshes[1], planes)
    _, gradient, entries = energy.derivatives(few)
    across = planes.signs[planes.chosen] == 0
    assert across.any()
    assert (gradient[across] == 0).all()
    assert (entries[energy.pattern.diagonal][across.ravel()] == 1).all()
    assert planes.all(few)[planes.chosen][across] == pytest.approx(
        np.broadcast_to(planes.middle, few.shape)[across]
    )


@pytest.mark.parametrize(("rows", "columns"), GRIDS)
def test_vertices_stand_for_their_images(rows, columns):
    mesh = _problem(rows, columns).meshes[1]
    planes = mirrors(mesh)
    first, second = planes.images
    assert (first[first] == np.arange(len(first))).all()
    assert (planes.of[first] == planes.of).all()
    assert (planes.of[second] == planes.of).all()
    assert planes.sums(mass_of(mesh)).sum() == pytest.approx(mass_of(mesh).sum())
    few = _shape(mesh, planes)
    every = planes.all(few)
    assert planes.few(every) == pytest.approx(few)
    assert every[first] == pytest.approx(2 * planes.middle * [1, 0, 0] + every * [-1, 1, 1])
    assert every[second] == pytest.approx(2 * planes.middle * [0, 1, 0] + every * [1, -1, 1])


def test_a_symmetric_shape_is_brought_into_the_planes():
    mesh = _problem(2, 3).meshes[1]
    planes = mirrors(mesh)
    shape = planes.all(_shape(mesh, planes))
    turn = np.linalg.qr(np.random.default_rng(4).normal(size=(3, 3)))[0]
    turn *= np.linalg.det(turn)
    found = planes.settled(shape @ turn + [3.0, -2.0, 1.0])
    # all that is left open is the height, and which side is up
    apart = found - shape
    assert apart[:, :2] == pytest.approx(np.zeros((len(mesh.points), 2)), abs=1e-9)
    assert np.ptp(apart[:, 2]) == pytest.approx(0, abs=1e-9)
    # what is not symmetric is taken out
    crooked = planes.settled(shape + np.random.default_rng(5).normal(0, 1e-3, shape.shape))
    assert planes.all(planes.few(crooked)) == pytest.approx(crooked, abs=1e-12)


def test_meshes_without_mirror_planes_have_none():
    mesh = loop_problem(LOOP, 1).meshes[1]
    assert mirrors(mesh) is not None
    points = mesh.points.copy()
    points[0] += 1e-3
    crooked = type(mesh)(points, mesh.triangles, mesh.region, mesh.rounds, mesh.wires, mesh.parents)
    assert mirrors(crooked) is None


def test_elements_without_images_are_refused():
    problem = _problem(2, 2)
    planes = mirrors(problem.meshes[1])
    fabric = problem.fabric_on(1)
    counted = one_of_each(fabric, planes)
    assert counted.counts.sum() == len(fabric.vertices)
    assert len(counted.vertices) < 0.3 * len(fabric.vertices)
    with pytest.raises(ValueError, match="no element"):
        one_of_each(fabric.part(np.arange(1, len(fabric.vertices))), planes)
