"""Fabric that wrinkles instead of bearing compression."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from solver.loop_energy import scene_membrane
from solver.mesh.array_mesh import Between
from solver.mesh.elements import Curvature
from solver.mesh.fabric_law import StVenantKirchhoff
from solver.mesh.loop_mesh import loop_fan
from solver.mesh.scene import ArrayScene
from solver.mesh.solve import solve_array, solve_loop_mesh
from solver.mesh.tension_field import TensionField
from solver.mesh.triangle_energy import triangle_energy
from solver.mesh.triangulation import embedded, refinements
from solver.scene import LoopScene

LOOP = LoopScene(0.3, 0.0145, 0.3)


def _stiffness(poisson, modulus_ratio=1.0):
    return scene_membrane(LoopScene(0.3, 0.01, poisson, modulus_ratio=modulus_ratio)).stiffness


def _strains(high, low):
    """Strains (30, 3) with these principal values, turned at random."""
    angle = np.random.default_rng(1).uniform(0, np.pi, 30)
    mean, radius = (high + low) / 2, (high - low) / 2
    c, s = np.cos(2 * angle), np.sin(2 * angle)
    return np.stack([mean + radius * c, mean - radius * c, 2 * radius * s], axis=1)


REGIONS = {
    "taut": _strains(0.3, 0.1),
    "taut but narrower": _strains(0.3, -0.05),
    "wrinkled": _strains(0.3, -0.2),
    "nearly slack": _strains(0.01, -0.4),
    "slack": _strains(-0.1, -0.3),
}
COMPRESSED = {"wrinkled", "nearly slack", "slack"}


@pytest.mark.parametrize("region", REGIONS)
def test_derivatives_of_the_density_in_every_region(region):
    law, strain = TensionField(_stiffness(0.3)), REGIONS[region]
    assert np.all(law.compressed(strain) == (region in COMPRESSED))
    direction = np.random.default_rng(2).normal(size=strain.shape)
    step = 1e-6
    ahead, behind = strain + step * direction, strain - step * direction
    slope = np.sum(law.stress(strain) * direction, axis=1)
    difference = (law.density(ahead) - law.density(behind)) / (2 * step)
    assert difference == pytest.approx(slope, abs=1e-8)
    root = law.derivatives(strain, steady=False)[2]
    stiffness = np.swapaxes(root, 1, 2) @ root
    bent = (stiffness @ direction[:, :, None])[:, :, 0]
    difference = (law.stress(ahead) - law.stress(behind)) / (2 * step)
    assert difference == pytest.approx(bent, abs=1e-7)


@pytest.mark.parametrize("poisson", [-0.3, 0.0, 0.3, 0.49])
def test_the_density_is_the_least_over_wrinkles(poisson):
    """By brute force over what wrinkles may add to the strain: positive semidefinite matrices."""
    stiffness = _stiffness(poisson)
    law, plain = TensionField(stiffness), StVenantKirchhoff(stiffness)
    rng = np.random.default_rng(3)
    for strain in rng.normal(0, 0.2, (20, 3)):
        least, width = strain[None], 0.5
        added = np.zeros((2, 2))
        for _ in range(40):
            factors = added + width * rng.normal(size=(2000, 2, 2))
            factors[0] = added
            wrinkles = factors @ np.swapaxes(factors, 1, 2)
            listed = np.stack([wrinkles[:, 0, 0], wrinkles[:, 1, 1], 2 * wrinkles[:, 0, 1]], axis=1)
            values = plain.density(strain + listed)
            best = int(np.argmin(values))
            added, width = factors[best], 0.75 * width
            least = (strain + listed[best])[None]
        assert law.density(strain[None])[0] == pytest.approx(plain.density(least)[0], abs=1e-7)


def test_energy_and_stress_are_continuous_at_the_borders():
    law = TensionField(_stiffness(0.3))
    # the smaller stress vanishes at E₂ = −ν E₁, the larger one at E₁ = 0
    for high, low in ((0.2, -0.06), (0.0, -0.2)):
        one, other = _strains(high + 1e-9, low + 1e-9), _strains(high - 1e-9, low - 1e-9)
        assert np.any(law.compressed(one) != law.compressed(other)) or high == 0
        assert law.density(one) == pytest.approx(law.density(other), abs=1e-8)
        assert law.stress(one) == pytest.approx(law.stress(other), abs=1e-8)


def test_it_never_costs_more_than_plain_fabric_and_bears_no_compression():
    strain = np.random.default_rng(4).normal(0, 0.3, (500, 3))
    law, plain = TensionField(_stiffness(0.3)), StVenantKirchhoff(_stiffness(0.3))
    assert np.all(law.density(strain) <= plain.density(strain) + 1e-15)
    taut = ~law.compressed(strain)
    assert 20 < taut.sum() < 480
    assert law.density(strain[taut]) == pytest.approx(plain.density(strain[taut]))
    assert law.smallest_stress(strain).min() == 0
    values = np.linalg.eigvalsh(law.stress(strain)[:, [[0, 2], [2, 1]]])
    assert values.min() > -1e-12


def _crumpled(modulus_ratio):
    mesh = refinements(loop_fan(), 1)[-1]
    noise = np.random.default_rng(5).normal(0, 0.1, (len(mesh.points), 3))
    stiffness = _stiffness(0.3, modulus_ratio)
    energy = triangle_energy(mesh, 0.3, stiffness, tension_field=True)
    return energy, (0.75 * embedded(mesh.points) + noise)[mesh.triangles]


@pytest.mark.parametrize("modulus_ratio", [1.0, 1.5])
def test_triangles_against_centred_differences(modulus_ratio):
    energy, corners = _crumpled(modulus_ratio)
    direction = np.random.default_rng(6).normal(size=corners.shape)
    step = 1e-7
    flat = direction.reshape(len(corners), -1)
    _, gradient, hessian = energy.derivatives(corners, Curvature.TRUE)
    ahead, behind = (
        energy.derivatives(corners + s * direction, Curvature.TRUE) for s in (step, -step)
    )
    slope = np.sum(gradient * flat, axis=1)
    assert (ahead[0] - behind[0]) / (2 * step) == pytest.approx(slope, abs=1e-7)
    bent = (hessian @ flat[:, :, None])[:, :, 0]
    assert (ahead[1] - behind[1]) / (2 * step) == pytest.approx(bent, abs=1e-6)


@pytest.mark.parametrize("modulus_ratio", [1.0, 1.5])
def test_it_is_convex_in_the_positions(modulus_ratio):
    """So no mesh can wrinkle at its own scale."""
    energy, corners = _crumpled(modulus_ratio)
    assert 0.2 < np.mean(energy.compressed(corners)) < 1
    true, steady = (energy.derivatives(corners, c)[2] for c in (Curvature.TRUE, Curvature.STEADY))
    assert np.linalg.eigvalsh(true).min() > -1e-12
    assert np.linalg.eigvalsh(steady - true).min() > -1e-12
    assert np.abs(steady - true).max() > 1e-3


# a solve ends where it would gain less than a millionth of the energy
@pytest.mark.parametrize(("modulus_ratio", "near"), [(1.0, 1e-8), (1.2, 1e-6)])
def test_taut_loops_are_as_without_it(modulus_ratio, near):
    scene = replace(LOOP, modulus_ratio=modulus_ratio)
    plain, relaxed = (
        solve_loop_mesh(scene, refinement=2, tension_field=field) for field in (False, True)
    )
    assert relaxed.energy == pytest.approx(plain.energy, rel=near)
    # the fabric turns under its saddle at next to no cost, which moves the height a little
    assert relaxed.height == pytest.approx(plain.height, rel=1e-4)
    stays = solve_loop_mesh(scene, refinement=2, tension_field=True, start=plain.positions)
    assert stays.height == pytest.approx(plain.height, rel=1e-9)
    assert relaxed.compressed_fraction == 0
    assert "fabric stretch (tension field)" in relaxed.energy_terms


@pytest.mark.parametrize(
    ("strain", "beta", "limit"), [(0.3, 0.002, 0.15436), (0.5, 0.005, 0.15772)]
)
def test_heights_of_slack_loops_settle(strain, beta, limit):
    scene = LoopScene(strain, beta, 0.3)
    found = [solve_loop_mesh(scene, refinement=k, tension_field=True) for k in (1, 2, 3)]
    heights = [f.height_over_perimeter for f in found]
    changes = [abs(after - before) for before, after in pairwise(heights)]
    assert changes[1] < 0.4 * changes[0]
    assert heights[-1] == pytest.approx(limit, rel=4e-3)
    assert all(f.steps < 80 for f in found)
    assert found[-1].smallest_stress == 0
    assert found[-1].compressed_fraction > 0.1


@pytest.mark.parametrize("size", [2, 3])
def test_kept_arrays(size):
    scene = ArrayScene(LOOP, size, size, Between.KEPT)
    plain, relaxed = (
        solve_array(scene, refinement=2, tension_field=field) for field in (False, True)
    )
    assert relaxed.status == "converged"
    assert 0.99 * plain.energy < relaxed.energy < plain.energy
    assert relaxed.height == pytest.approx(plain.height, rel=0.08)
    assert relaxed.lowest_eigenvalue > 0
