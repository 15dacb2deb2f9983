"""Wrinkling fabric of any stiffness: against what defines it, and against its own limits."""

import numpy as np
import pytest
from scipy.optimize import minimize

from solver.loop_energy import scene_membrane
from solver.mesh.fabric_law import StVenantKirchhoff
from solver.mesh.stress_cone import stress_cone
from solver.mesh.tension_field import TensionField
from solver.scene import LoopScene, Reading

HALF_SHEAR = np.array([1.0, 1.0, 0.5])


def _woven(ratio, poisson=0.3):
    return scene_membrane(LoopScene(0.3, 0.01, poisson, modulus_ratio=ratio)).stiffness


def _any(seed, decades):
    """Positive definite with eigenvalues up to so many decades apart."""
    rng = np.random.default_rng(seed)
    axes, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return (axes * 10 ** rng.uniform(-decades / 2, decades / 2, 3)) @ axes.T


STIFFNESSES = {
    "woven 1.1": _woven(1.1),
    "woven 3": _woven(3.0),
    "woven, auxetic": _woven(1.5, -0.5),
    # over directions of a uniaxial stress its energy has two local maxima, of which one is wrong
    "soft in shear": np.array([[1.0, -0.5, 0], [-0.5, 1.0, 0], [0, 0, 0.02]]),
    "any": _any(1, 2),
    "any, far from isotropic": _any(2, 5),
}
each_stiffness = pytest.mark.parametrize("stiffness", STIFFNESSES.values(), ids=STIFFNESSES)


def _strains(count, seed=3):
    return np.random.default_rng(seed).normal(0, 0.2, (count, 3))


def _matrices(listed):
    return listed[:, [[0, 2], [2, 1]]]


def _turned(angle):
    """Matrix from strains (E11, E22, 2E12) to the same seen along turned axes."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array(
        [[c**2, s**2, c * s], [s**2, c**2, -c * s], [-2 * c * s, 2 * c * s, c**2 - s**2]]
    )


def _tangent(law, strain):
    root = law.derivatives(strain, steady=False)[2]
    return np.swapaxes(root, 1, 2) @ root


def _region(law, strain):
    """0 taut, 1 wrinkled, 2 slack."""
    slack = np.linalg.eigvalsh(_matrices(strain * HALF_SHEAR)).max(axis=1) <= 0
    return np.where(law.compressed(strain), 1, 0) + slack


@each_stiffness
def test_the_density_is_the_least_over_wrinkles(stiffness):
    """By brute force over what wrinkles may add to the strain: F Fᵀ with any F."""
    law, plain = TensionField(stiffness), StVenantKirchhoff(stiffness)
    rng = np.random.default_rng(4)
    strains = _strains(40)
    assert {1, 2} <= set(_region(law, strains))

    def wrinkled(factor, strain):
        f = factor.reshape(2, 2)
        p = f @ f.T
        added = np.array([[p[0, 0], p[1, 1], 2 * p[0, 1]]])
        return plain.density(strain + added)[0]

    for strain, density in zip(strains, law.density(strains), strict=True):
        found = [
            minimize(
                wrinkled, rng.normal(0, 0.5, 4), (strain,), "BFGS", options={"gtol": 1e-10}
            ).fun
            for _ in range(4)
        ]
        assert density == pytest.approx(min(found), rel=1e-5, abs=1e-9 * stiffness.max())


@pytest.mark.parametrize("decades", [0.1, 1, 3, 6])
def test_the_stress_is_the_one_that_defines_it(decades):
    """S and P = C⁻¹S − E are positive semidefinite and S·P = 0: which proves both extremes."""
    for seed in range(20):
        stiffness = _any(seed, decades)
        strain = _strains(500, seed)
        stress = TensionField(stiffness).stress(strain)
        wrinkles = np.linalg.solve(stiffness, stress.T).T - strain
        lowest = np.linalg.eigvalsh(_matrices(stress))[:, 0] / (1e-300 + np.abs(stress).max(axis=1))
        assert lowest.min() > -1e-11
        assert np.linalg.eigvalsh(_matrices(wrinkles * HALF_SHEAR)).min() > -1e-9
        lost = np.abs(np.sum(stress * wrinkles, axis=1))
        assert np.all(lost <= 1e-9 * np.sum(stress * strain, axis=1) + 1e-300)


@each_stiffness
def test_derivatives_against_centred_differences(stiffness):
    law, strain = TensionField(stiffness), _strains(400)
    direction = np.random.default_rng(5).normal(size=strain.shape)
    step = 1e-6
    ahead, behind = strain + step * direction, strain - step * direction
    same = _region(law, ahead) == _region(law, behind)
    assert np.mean(same) > 0.99
    size = np.abs(stiffness).max()
    slope = np.sum(law.stress(strain) * direction, axis=1)
    difference = (law.density(ahead) - law.density(behind)) / (2 * step)
    assert difference == pytest.approx(slope, abs=1e-7 * size)
    bent = (_tangent(law, strain) @ direction[:, :, None])[:, :, 0]
    difference = (law.stress(ahead) - law.stress(behind)) / (2 * step)
    assert difference[same] == pytest.approx(bent[same], abs=1e-6 * size)


@each_stiffness
def test_derivatives_belong_together(stiffness):
    law, strain = TensionField(stiffness), _strains(100)
    density, stress, root = law.derivatives(strain, steady=False)
    assert np.array_equal(density, law.density(strain))
    assert np.array_equal(stress, law.stress(strain))
    steady = law.derivatives(strain, steady=True)[2]
    lent = np.swapaxes(steady, 1, 2) @ steady - np.swapaxes(root, 1, 2) @ root
    expected = np.where(law.compressed(strain), 0.03, 0)[:, None, None] * stiffness
    assert lent == pytest.approx(expected, abs=1e-12 * np.abs(stiffness).max())


@each_stiffness
def test_it_is_convex_and_bears_no_compression(stiffness):
    law, plain = TensionField(stiffness), StVenantKirchhoff(stiffness)
    one, other = _strains(2000, 6), _strains(2000, 7)
    middle = law.density((one + other) / 2)
    size = np.abs(stiffness).max()
    assert np.all(middle <= (law.density(one) + law.density(other)) / 2 + 1e-14 * size)
    rises = np.sum((law.stress(one) - law.stress(other)) * (one - other), axis=1)
    assert rises.min() >= -1e-14 * size
    assert np.all(law.density(one) <= plain.density(one) + 1e-14 * size)
    taut = ~law.compressed(one)
    assert np.array_equal(law.stress(one[taut]), plain.stress(one[taut]))
    assert law.smallest_stress(one).min() == 0
    assert np.linalg.eigvalsh(_matrices(law.stress(one))).min() > -1e-12 * size


@each_stiffness
def test_stress_is_continuous_at_the_borders(stiffness):
    """Borders are looked for on lines from one strain to another, by bisection."""
    law = TensionField(stiffness)
    one, other = _strains(300, 8), _strains(300, 9)
    met = _region(law, one), _region(law, other)
    assert {(0, 1), (1, 2)} <= set(zip(*met, strict=True))
    low, high = np.zeros(300), np.ones(300)
    for _ in range(60):
        half = (low + high) / 2
        still = _region(law, one + half[:, None] * (other - one)) == met[0]
        low, high = np.where(still, half, low), np.where(still, high, half)
    before, after = (one + part[:, None] * (other - one) for part in (low - 1e-9, high + 1e-9))
    crossed = met[0] != met[1]
    size = np.abs(stiffness).max()
    assert np.all(_region(law, before)[crossed] != _region(law, after)[crossed])
    assert law.density(before) == pytest.approx(law.density(after), abs=1e-8 * size)
    assert law.stress(before) == pytest.approx(law.stress(after), abs=2e-8 * size)


@pytest.mark.parametrize("poisson", [-0.5, 0.0, 0.3, 0.49])
@pytest.mark.parametrize("reading", list(Reading))
def test_isotropic_fabric_has_its_closed_form(poisson, reading):
    stiffness = scene_membrane(LoopScene(0.3, 0.01, poisson, reading)).stiffness
    cone = stress_cone(stiffness)
    assert cone.compliance[1] == pytest.approx(cone.compliance[2], rel=1e-14)
    law, strain = TensionField(stiffness), _strains(1000)
    strain = strain[_region(law, strain) == 1]
    values, axes = np.linalg.eigh(_matrices(strain * HALF_SHEAR))
    modulus = stiffness[0, 0] - stiffness[0, 1] ** 2 / stiffness[0, 0]
    t, n = axes[:, :, 1], axes[:, :, 0]
    along = np.stack([t[:, 0] ** 2, t[:, 1] ** 2, t[:, 0] * t[:, 1]], axis=1)
    tension = modulus * values[:, 1]
    assert law.density(strain) == pytest.approx(tension * values[:, 1] / 2, abs=1e-12)
    assert law.stress(strain) == pytest.approx(tension[:, None] * along, abs=1e-12)
    sheared = np.stack(
        [t[:, 0] * n[:, 0], t[:, 1] * n[:, 1], (t[:, 0] * n[:, 1] + t[:, 1] * n[:, 0]) / 2], axis=1
    )
    turning = tension * 2 / (values[:, 1] - values[:, 0])
    tangent = modulus * along[:, :, None] * along[:, None, :]
    tangent += turning[:, None, None] * sheared[:, :, None] * sheared[:, None, :]
    assert _tangent(law, strain) == pytest.approx(tangent, abs=1e-12)


def test_nearly_isotropic_fabric_is_nearly_the_same():
    strain = _strains(1000)
    even, uneven = TensionField(_woven(1.0)), TensionField(_woven(1 + 1e-6))
    assert uneven.density(strain) == pytest.approx(even.density(strain), abs=1e-6)
    assert uneven.stress(strain) == pytest.approx(even.stress(strain), abs=2e-6)


def test_fabric_turned_by_a_quarter_has_its_moduli_swapped():
    strain = _strains(500)
    one, other = TensionField(_woven(1.7)), TensionField(_woven(1 / 1.7))
    swapped = [1, 0, 2]
    assert other.density(strain[:, swapped]) == pytest.approx(one.density(strain), abs=1e-14)
    assert other.stress(strain[:, swapped])[:, swapped] == pytest.approx(
        one.stress(strain), abs=1e-14
    )


@each_stiffness
def test_turned_fabric_under_turned_strain(stiffness):
    strain, turn = _strains(500), _turned(0.7)
    back = np.linalg.inv(turn)
    one, other = TensionField(stiffness), TensionField(back.T @ stiffness @ back)
    size = np.abs(stiffness).max()
    assert other.density(strain @ turn.T) == pytest.approx(one.density(strain), abs=1e-13 * size)
    assert other.stress(strain @ turn.T) @ turn == pytest.approx(
        one.stress(strain), abs=1e-12 * size
    )


@each_stiffness
def test_the_cones_coordinates(stiffness):
    """Both forms are diagonal in them: the energy by stress, and the stress's determinant."""
    cone = stress_cone(stiffness)
    stress = np.random.default_rng(10).normal(size=(50, 3))
    s = np.linalg.solve(cone.frame.T, stress.T).T
    energy = np.sum(stress * np.linalg.solve(stiffness, stress.T).T, axis=1)
    assert np.sum(cone.compliance * s**2, axis=1) == pytest.approx(energy, rel=1e-9)
    assert cone.compliance[1] <= cone.compliance[2]
    determinant = stress[:, 0] * stress[:, 1] - stress[:, 2] ** 2
    assert s**2 @ [1, -1, -1] == pytest.approx(determinant, abs=1e-9 * np.abs(s**2).max())
    # tension, not compression, has a positive first coordinate
    assert np.linalg.solve(cone.frame.T, [1.0, 1.0, 0.0])[0] > 0
