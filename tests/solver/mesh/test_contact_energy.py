"""The mesh's energy with barriers, as a minimisation sees it."""

import numpy as np
import pytest

from solver.mesh.contact_energy import ContactEnergy, ContactFactoriser
from solver.mesh.elements import Curvature
from solver.mesh.krylov import symmetric_product
from solver.mesh.problem import loop_problem
from solver.mesh.thickness import thickness_barriers
from solver.scene import LoopScene

SCENE = LoopScene(0.3, 0.0145, 0.3)
TOUCHING = 0.021


def _energy(rolled_disc, gap):
    mesh, positions = rolled_disc(gap)
    free = loop_problem(SCENE, 2).energy(2)
    return ContactEnergy(free, thickness_barriers(mesh, 0.02, SCENE.strain)), positions


@pytest.mark.parametrize("curvature", [Curvature.TRUE, Curvature.STEADY])
def test_derivatives_where_rims_touch(curvature, rolled_disc):
    energy, positions = _energy(rolled_disc, TOUCHING)
    value, gradient, entries = energy.derivatives(positions, curvature)
    assert energy.touching(positions) > 0
    assert value == pytest.approx(sum(energy.terms(positions).values()), rel=1e-12)
    way = np.random.default_rng(0).normal(size=positions.shape)
    step = 1e-7
    one, other = (energy.value(positions + s * step * way) for s in (1, -1))
    assert np.sum(gradient * way) == pytest.approx((one - other) / (2 * step), rel=1e-5)
    product = symmetric_product(energy.pattern, entries)(way.ravel())
    ahead, behind = (_energy_gradient(energy, positions + s * step * way) for s in (1, -1))
    bend = ((ahead - behind) / (2 * step)).ravel()
    assert product == pytest.approx(bend, abs=1e-5 * np.abs(bend).max())


def _energy_gradient(energy, positions):
    return energy.derivatives(positions)[1]


def test_the_pattern_widens_only_where_something_touches(rolled_disc):
    apart, positions = _energy(rolled_disc, 0.05)
    apart.derivatives(positions)
    assert apart.pattern is apart.free.pattern
    touching, positions = _energy(rolled_disc, TOUCHING)
    touching.derivatives(positions)
    wide = touching.pattern
    assert len(wide.rows) > len(touching.free.pattern.rows)
    touching.derivatives(positions)
    assert touching.pattern is wide


def test_factors_follow_the_pattern(rolled_disc):
    energy, positions = _energy(rolled_disc, TOUCHING)
    factoriser = ContactFactoriser(energy)
    entries = energy.derivatives(positions, Curvature.CONVEX)[2]
    entries[energy.pattern.diagonal] += 1.0
    right = np.random.default_rng(0).normal(size=energy.pattern.size)
    solved = factoriser.factorise(entries).solve(right)
    assert symmetric_product(energy.pattern, entries)(solved) == pytest.approx(right, abs=1e-6)


def test_a_shape_beyond_a_crossing_is_at_infinity(rolled_disc):
    energy, positions = _energy(rolled_disc, 0.05)
    energy.derivatives(positions)
    assert np.isfinite(energy.value(1.01 * positions))
    mirrored = positions * [-1.0, 1.0, 1.0]
    assert energy.value(mirrored) == np.inf
    assert energy.free_way(positions, mirrored) < 1
