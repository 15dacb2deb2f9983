from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from solver.mesh import newton_sparse
from solver.mesh.descent import mass_of
from solver.mesh.factorization import available, factoriser
from solver.mesh.krylov import (
    QuadraticModel,
    lowest_direction,
    steihaug_step,
    symmetric_product,
    trust_region_step,
)
from solver.mesh.newton_sparse import _Account, _Search, _stalled, minimise_sparse
from solver.mesh.problem import loop_problem
from solver.mesh.rigid import lowest_eigenvalue, rigid_motions
from solver.mesh.search import SearchLimits
from solver.mesh.triangulation import Wire, embedded
from solver.scene import LoopScene

PROBLEM = loop_problem(LoopScene(0.3, 0.0145, 0.3), 1)
MESH = PROBLEM.meshes[1]
ENERGY = PROBLEM.energy(1)


def _dense(entries):
    pattern = ENERGY.pattern
    out = np.zeros((pattern.size, pattern.size))
    out[pattern.rows, pattern.columns] = entries
    return out + np.tril(out, -1).T


def _solved(limits=None, backend=None, start=None):
    flat = embedded(MESH.points) if start is None else start
    return minimise_sparse(ENERGY, flat, mass_of(MESH), factoriser(ENERGY.pattern, backend), limits)


def _model(eigenvalues, gradient):
    hessian = np.diag(eigenvalues)
    metric = np.diag(np.abs(eigenvalues) + 0.1)
    return QuadraticModel(
        np.array(gradient, float),
        lambda v: hessian @ v,
        lambda v: metric @ v,
        lambda v: np.linalg.solve(metric, v),
        convex=False,
    )


@pytest.mark.parametrize("backend", available())
def test_the_flat_saddle_point_is_left(backend):
    """From exactly flat, where symmetry hides the way down from the gradient."""
    found = _solved(backend=backend)
    assert found.converged
    assert found.negative == 0
    assert found.value == pytest.approx(0.323058, abs=1e-5)
    assert np.ptp(found.positions[:, 2]) > 0.5


def _flat_equilibrium():
    """The flat state, by Newton's method on x and y alone."""
    positions = embedded(MESH.points)
    level = np.flatnonzero(np.arange(ENERGY.pattern.size) % 3 != 2)
    for _ in range(12):
        _, gradient, entries = ENERGY.derivatives(positions)
        plane = _dense(entries)[np.ix_(level, level)] + 1e-9 * np.eye(len(level))
        move = np.zeros(positions.size)
        move[level] = -np.linalg.solve(plane, gradient.ravel()[level])
        positions = positions + move.reshape(-1, 3)
    return positions


def test_a_stationary_point_that_is_no_minimum_is_left():
    flat = _flat_equilibrium()
    assert np.abs(ENERGY.derivatives(flat)[1]).max() < 1e-10
    found = _solved(start=flat)
    assert found.steps > 3
    assert found.value == pytest.approx(0.323058, abs=1e-5)


def test_too_few_steps_are_told():
    found = _solved(SearchLimits(steps=3))
    assert not found.converged
    assert found.steps == 3


def test_a_rough_solve_ends_early():
    rough = _solved(SearchLimits(decrease=1e-2))
    assert not rough.converged
    assert rough.steps < _solved().steps


def test_relabelling_changes_nothing():
    lifted = embedded(MESH.points)
    lifted[:, 2] = 0.1 * (MESH.points[:, 0] ** 2 - MESH.points[:, 1] ** 2)
    number = np.random.default_rng(3).permutation(len(MESH.points))
    name = np.argsort(number)
    wire = Wire(np.roll(name[MESH.wires[0].vertices], 7)[::-1])
    relabelled = replace(
        MESH,
        points=MESH.points[number],
        triangles=np.roll(name[MESH.triangles], 1, axis=1)[::-1],
        wires=(wire,),
    )
    other = replace(PROBLEM, meshes=(relabelled,)).energy(0)
    found = minimise_sparse(other, lifted[number], mass_of(relabelled), factoriser(other.pattern))
    assert other.value(lifted[number]) == pytest.approx(ENERGY.value(lifted), rel=1e-13)
    assert found.value == pytest.approx(_solved(start=lifted).value, rel=1e-9)


def test_step_down_a_negative_eigenvalue_alone():
    step = steihaug_step(_model([-0.5, 1.0, 2.0], [0.3, 0.0, 0.0]), 0.7)
    assert step.bounded
    assert step.displacement == pytest.approx([-0.7 / 0.6**0.5, 0.0, 0.0])


def test_steps_end_in_the_trust_region_or_on_its_boundary():
    rng = np.random.default_rng(4)
    bounded = 0
    for _ in range(50):
        model = _model(rng.uniform(0.01, 5, 8), rng.normal(size=8))
        model = replace(model, metric=lambda v: v, inverse=lambda v: v)
        step = steihaug_step(model, 2.0)
        length = model.length(step.displacement)
        assert length == pytest.approx(2.0, rel=1e-9) if step.bounded else length < 2.0
        bounded += step.bounded
    assert 5 < bounded < 45


def test_step_of_a_convex_model_is_newtons():
    model = replace(_model([0.5, 1.0, 2.0], [0.3, 0.1, -0.2]), convex=True)
    assert trust_region_step(model, 10.0).displacement == pytest.approx([-0.6, -0.1, 0.1], abs=0.06)


def test_step_of_an_indefinite_model_reaches_the_boundary_downhill():
    model = _model([-0.5, 1.0, 2.0], [0.0, 0.3, -0.1])
    step = trust_region_step(model, 0.7)
    assert step.bounded
    assert model.length(step.displacement) == pytest.approx(0.7)
    assert model.change(step.displacement) < 0
    assert abs(step.displacement[0]) > 0.1


def test_lowest_direction():
    rng = np.random.default_rng(0)
    eigenvalues = np.concatenate([[-0.2], rng.uniform(0.5, 1.0, 40)])
    value, mode = lowest_direction(_model(eigenvalues, np.ones(41)))
    assert value == pytest.approx(-0.2 / 0.3, rel=1e-3)
    assert mode[0] ** 2 * 0.3 == pytest.approx(1, rel=1e-2)
    assert mode.sum() < 0


def test_rigid_motions_cost_nothing_at_a_minimum():
    found = _solved()
    hessian = symmetric_product(ENERGY.pattern, found.entries)
    mass = mass_of(MESH)
    motions = rigid_motions(found.positions, mass)
    gram = motions.T @ (np.repeat(mass, 3)[:, None] * motions)
    assert gram == pytest.approx(np.eye(6), abs=1e-12)
    for motion in motions.T:
        assert np.abs(hessian(motion)).max() < 1e-5


def test_lowest_eigenvalue_against_dense():
    """Of an ellipse, which has no free motions but the rigid ones."""
    problem = loop_problem(LoopScene(0.3, 0.0145, 0.3, axis_ratio=1.5), 1)
    energy, mesh = problem.energy(1), problem.meshes[1]
    factors = factoriser(energy.pattern)
    found = minimise_sparse(energy, embedded(mesh.points), mass_of(mesh), factors)
    mass = np.repeat(mass_of(mesh), 3)
    rigid = rigid_motions(found.positions, mass_of(mesh))
    scaled = _dense(found.entries) / np.sqrt(np.outer(mass, mass))
    lifted = np.sqrt(mass)[:, None] * rigid
    exact = np.linalg.eigvalsh(scaled + 10 * lifted @ lifted.T)[0]
    hessian = symmetric_product(energy.pattern, found.entries)
    value = lowest_eigenvalue(hessian, found.factored, found.positions, mass_of(mesh))
    assert exact > 0.1
    assert value == pytest.approx(exact, rel=1e-2)


def test_a_small_gradient_is_no_minimum_while_the_energy_would_still_fall():
    """The Newton decrement: soft motions have small gradients and much to gain."""
    tight = _solved()
    loose = _solved(SearchLimits(gradient=1.0))
    assert loose.converged
    assert loose.value - tight.value <= 2e-10 * tight.value


def _search(values, **limits):
    return SimpleNamespace(
        limits=SearchLimits(**limits), account=SimpleNamespace(values=list(values))
    )


@pytest.mark.parametrize(
    ("gain", "steps", "gradient", "steady", "stalled"),
    [
        (0.0, 11, 1e-9, False, True),  # ten steps gain nothing
        (0.0, 10, 1e-9, False, False),  # too few of them
        (1e-9, 11, 1e-9, False, False),  # they gain more than rounding
        (0.0, 11, 1e-6, False, False),  # something still pulls
        (1e-8, 11, 1e-6, True, True),  # wrinkled fabric may leave a millionth
        (1e-6, 11, 1e-6, True, False),
        (1e-8, 11, 1e-3, True, False),
    ],
)
def test_a_search_stalls_when_many_steps_in_a_row_gain_next_to_nothing(
    gain, steps, gradient, steady, stalled
):
    values = 1.0 - gain * np.arange(steps)
    state = SimpleNamespace(value=float(values[-1]), gradient_norm=gradient)
    assert bool(_stalled(_search(values, gradient=1e-8, steady=steady), state)) is stalled


def _metric(positions, monkeypatch, lent):
    monkeypatch.setattr(newton_sparse, "_LENT", lent)
    limits, mass = SearchLimits(steady=True), np.repeat(mass_of(MESH), 3)
    search = _Search(ENERGY, mass, factoriser(ENERGY.pattern), limits, _Account())
    state = search.state(positions)
    true = search.held(state.entries, 0.0)
    entries, inverse = search.metric(state, true)
    return _dense(true), _dense(entries), inverse, np.diag(mass)


@pytest.mark.parametrize(
    ("lent", "enough"), [((20.0,), 20.0), ((5.0, 20.0), 20.0), ((5.0,), None), ((), None)]
)
def test_metric_at_a_saddle_point_is_positive_definite(lent, enough, monkeypatch):
    """The flat loop's lowest eigenvalue is -9.0 E_f t; beyond the ladder only elements are left."""
    true, metric, inverse, mass = _metric(_flat_equilibrium(), monkeypatch, lent)
    assert np.linalg.eigvalsh(true)[0] < 0 < np.linalg.eigvalsh(metric)[0]
    right = np.arange(len(metric)) % 7 - 3.0
    assert metric @ inverse(right) == pytest.approx(right, abs=1e-6)
    for stiffness in (5.0, 20.0):
        lends = abs(metric - true - stiffness * mass).max() < 1e-9
        assert lends == (stiffness == enough)
