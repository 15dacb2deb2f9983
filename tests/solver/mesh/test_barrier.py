"""The barrier alone: where it sets in, its derivatives, and what it bars."""

import numpy as np
import pytest

from solver.errors import SceneError
from solver.mesh import barrier as module
from solver.mesh.barrier import Barrier
from solver.mesh.elements import Curvature
from solver.mesh.triangulation import embedded

NONE = np.empty((0, 3), dtype=np.int64)
GAP, REACH = 0.02, 0.002


def _wires(mesh):
    return Barrier(mesh.points, mesh.wires[0].edges, NONE, GAP, REACH, force=0.1, near=0.2)


def _energy(rolled_disc, gap):
    mesh, positions = rolled_disc(gap)
    barrier = _wires(mesh)
    return barrier.energy(barrier.collisions(positions))


def test_it_sets_in_at_its_reach_and_has_no_bound_at_its_gap(rolled_disc):
    assert _energy(rolled_disc, GAP + REACH + 1e-9) == 0
    assert 0 < _energy(rolled_disc, GAP + 0.9 * REACH) < _energy(rolled_disc, GAP + 0.1 * REACH)
    assert _energy(rolled_disc, GAP - 1e-9) == np.inf


def test_flat_neighbours_do_not_feel_each_other(rolled_disc):
    mesh, _ = rolled_disc(0.1, refinement=4)  # edges as long as the wire is thick
    barrier = _wires(mesh)
    assert barrier.energy(barrier.collisions(embedded(mesh.points))) == 0


def test_force_in_the_middle_of_the_reach_is_of_the_order_that_was_asked(rolled_disc):
    slope = (
        _energy(rolled_disc, GAP + 0.51 * REACH) - _energy(rolled_disc, GAP + 0.49 * REACH)
    ) / (0.02 * REACH)
    assert 0.03 < -slope < 1


def test_derivatives(rolled_disc):
    mesh, positions = rolled_disc(GAP + 0.5 * REACH)
    barrier = _wires(mesh)
    way = np.random.default_rng(0).normal(size=positions.shape)
    step = 1e-7
    found = barrier.collisions(positions)
    further, nearer = (barrier.collisions(positions + s * step * way) for s in (1, -1))
    slope = (barrier.energy(further) - barrier.energy(nearer)) / (2 * step)
    assert barrier.gradient(found) @ way.ravel() == pytest.approx(slope, rel=1e-5)
    bend = (barrier.gradient(further) - barrier.gradient(nearer)) / (2 * step)
    hessian = barrier.hessian(found, Curvature.TRUE)
    assert hessian @ way.ravel() == pytest.approx(bend, abs=1e-5 * np.abs(bend).max())
    convex = barrier.hessian(found, Curvature.CONVEX).toarray()
    assert np.linalg.eigvalsh(hessian.toarray())[0] < -1
    assert np.linalg.eigvalsh(convex)[0] > -1e-9


def test_a_step_ends_before_rims_cross(rolled_disc):
    mesh, positions = rolled_disc(0.1)
    barrier = _wires(mesh)
    crossed = positions.copy()
    crossed[:, 0] -= np.where(np.abs(mesh.points[:, 0]) > 0.7, 0.4 * np.sign(mesh.points[:, 0]), 0)
    part = barrier.largest_step(positions, crossed)
    assert 0.05 < part <= 0.1 / 0.8  # 0.1 of the way that both rims go, 0.4 each
    assert barrier.largest_step(positions, 1.01 * positions) == 1


def test_a_missing_library_is_told_in_one_line(monkeypatch):
    monkeypatch.setattr(module, "find_spec", lambda name: None)
    with pytest.raises(SceneError, match=r"pip install 'sesame-cad\[contact\]'"):
        module.collision_library()
