"""The fabric's bending on smooth shapes: derivatives, known surfaces, limits, stability."""

from dataclasses import replace

import numpy as np
import pytest

from solver.branches import solve_branch, weakest_of
from solver.checks import GAUSS, SLACK
from solver.compact import solve_loop
from solver.disc_basis import disc_basis, jet_map, transfer
from solver.disc_functions import DiscFunction
from solver.fabric_bending import FabricBending, finest_wrinkle, gauss_integral
from solver.first_guess import saddle_family
from solver.loop_energy import loop_energy
from solver.mesh.loop_mesh import loop_fan
from solver.mesh.star_bending import star_gauss_integral
from solver.mesh.triangulation import refinements
from solver.reading import Reading
from solver.scene import LoopScene
from solver.symmetry import ALIGNED, DIAGONAL, Symmetry
from solver.threshold import critical_beta

SCENE = LoopScene(0.3, 0.0145, 0.3)
ANYTHING = Symmetry(((0, 0), (1, 1), (1, 0), (0, 1)), ((0, 0), (1, 1), (1, 0), (0, 1)))
SPACES = ["saddle", "oblique", ANYTHING]


def _shape(space, noise):
    basis = disc_basis(5, space)
    q = transfer(disc_basis(5, "saddle"), basis) @ saddle_family().coefficients[12]
    return basis, q + np.random.default_rng(0).normal(0, noise, basis.size)


@pytest.mark.parametrize("space", SPACES)
def test_derivatives_against_centred_differences(space):
    basis, q = _shape(space, 3e-3)
    bending, jets, step = FabricBending(0.7), jet_map(basis), 1e-6
    direction = np.random.default_rng(1).normal(size=basis.size)

    def at(amount):
        return bending.derivatives(jets @ (q + amount * direction), basis.area, jets)

    (value, slope, hessian), ahead, behind = at(0.0), at(step), at(-step)
    assert value == pytest.approx(bending.energy(jets @ q, basis.area))
    assert (ahead[0] - behind[0]) / (2 * step) == pytest.approx(slope @ direction, rel=1e-6)
    bent = hessian @ direction
    assert (ahead[1] - behind[1]) / (2 * step) == pytest.approx(bent, abs=1e-6 * np.abs(bent).max())
    assert np.array_equal(hessian, hessian.T)


@pytest.mark.parametrize(("m", "k"), [(0, 0), (0, 2), (1, 1), (2, 0), (3, 4), (7, 1)])
@pytest.mark.parametrize("trig", ["cos", "sin"])
def test_second_derivatives_of_disc_functions(m, k, trig):
    f, step = DiscFunction(m, k, trig), 1e-5
    x, y = np.array([0.05, 0.3, -0.5, 0.9]), np.array([0.02, -0.4, 0.6, 0.4])

    def gradient(dx, dy):
        return np.array(f.gradient(np.hypot(x + dx, y + dy), np.arctan2(y + dy, x + dx)))

    along, across = ((gradient(*h) - gradient(*-h)) / (2 * step) for h in step * np.eye(2))
    exact = np.array(f.second(np.hypot(x, y), np.arctan2(y, x)))
    expected = np.array([along[0], along[1], across[1]])
    assert exact == pytest.approx(expected, abs=1e-7 * max(1, np.abs(expected).max()))


def _cap(radius):
    """Derivatives of a spherical cap over the unit disc, and weights there."""
    nodes, weights = np.polynomial.legendre.leggauss(12)
    theta = (np.arange(24) + 0.5) * (2 * np.pi / 24)
    r, angle = np.repeat(np.sqrt((nodes + 1) / 2), 24), np.tile(theta, 12)
    x, y, one, none = r * np.cos(angle), r * np.sin(angle), np.ones_like(r), np.zeros_like(r)
    z = np.sqrt(radius**2 - r**2)
    seconds = [-1 / z - x * x / z**3, -x * y / z**3, -1 / z - y * y / z**3]
    jet = [(one, none, -x / z), (none, one, -y / z), *((none, none, s) for s in seconds)]
    area = np.repeat(weights / 2 * np.pi / 24, 24)
    return np.moveaxis(np.array(jet), 2, 0), area


def test_a_spherical_cap():
    """H = 1/ρ and K = 1/ρ² all over: both integrals are the area over ρ²."""
    jet, area = _cap(2.0)
    expected = 2 * np.pi * (1 - np.sqrt(1 - 0.25))
    assert FabricBending(0.5).energy(jet, area) == pytest.approx(0.5 * expected, rel=1e-10)
    assert gauss_integral(jet, area) == pytest.approx(expected, rel=1e-10)


def test_size_attitude_and_parameters_change_nothing():
    basis, q = _shape("oblique", 3e-3)
    jet, bending = jet_map(basis) @ q, FabricBending(1.0)
    turn = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0]
    known = bending.energy(jet, basis.area)
    assert bending.energy(3.0 * jet @ turn, basis.area) == pytest.approx(known, rel=1e-12)
    # x = u/2, y = 3v: dx dy = 3/2 du dv
    factors = np.array([0.5, 3, 0.25, 1.5, 9])[:, None]
    assert bending.energy(factors * jet, basis.area / 1.5) == pytest.approx(known, rel=1e-12)


def test_a_harmonic_rise_has_next_to_no_mean_curvature():
    """H is of third order in the rise, so that the flat loop buckles as without α."""
    basis = disc_basis(5, "saddle")
    flat = saddle_family().coefficients[0]
    rise = np.array([u[0].function == DiscFunction(2, 0, "cos") for u in basis.unknowns])
    low, high = (
        FabricBending(1.0).energy(jet_map(basis) @ (flat + h * rise), basis.area)
        for h in (1e-3, 2e-3)
    )
    assert high / low == pytest.approx(64, rel=0.01)


@pytest.mark.parametrize("alpha", [1e-3, 1.0])
def test_the_threshold_is_that_without_bending(alpha):
    beta = critical_beta(0.3, 0.3, Reading.PLANE_STRESS)
    thicker, thinner = (
        solve_loop(LoopScene(0.3, f * beta, 0.3, axial_stiffness=1e7, alpha=alpha))
        for f in (1.001, 0.999)
    )
    assert not thicker.buckled
    assert thinner.buckled
    assert thinner.lowest_eigenvalue > 0


def test_a_little_bending_costs_what_the_bare_shape_tells():
    bare = solve_loop(SCENE, tolerance=1e-7)
    basis = disc_basis(bare.degree, "saddle")
    squared = FabricBending(1.0).energy(jet_map(basis) @ bare.shape.coefficients, basis.area)
    little = solve_loop(replace(SCENE, alpha=1e-7), tolerance=1e-7)
    assert little.degree == bare.degree
    assert (little.energy - bare.energy) / 1e-7 == pytest.approx(squared, rel=2e-3)


def test_stiff_fabric_becomes_a_minimal_surface():
    """Not flat: a saddle can do without mean curvature. Its height hardly changes."""
    found = [solve_loop(replace(SCENE, alpha=alpha), tolerance=1e-6) for alpha in (0, 1e-3, 0.1, 1)]
    squared = [f.energy_terms["fabric bending"] / f.scene.alpha for f in found[1:]]
    assert squared == pytest.approx([1.091e-2, 2.136e-4, 2.873e-6], rel=1e-3)
    heights = [f.shape.height_over_perimeter for f in found]
    assert heights == pytest.approx([0.131251, 0.131252, 0.131294, 0.131305], abs=1e-6)
    assert np.all(np.diff([f.energy for f in found]) > 0)


@pytest.mark.parametrize("space", [ALIGNED, DIAGONAL])
def test_classes_of_motions_hold_all_motions(space):
    scene = LoopScene(0.3, 0.0145, 0.3, axis_ratio=1.5, alpha=0.01)
    branch = solve_branch(scene, space, 3e-3)
    basis = disc_basis(branch.basis.degree, ANYTHING)
    q = transfer(branch.basis, basis) @ branch.unknowns
    eigenvalues = np.linalg.eigvalsh(loop_energy(scene, basis).derivatives(q)[2])
    free = np.argsort(np.abs(eigenvalues))[:6]
    assert np.abs(eigenvalues[free]).max() < 1e-5
    rest = np.delete(eigenvalues, free)
    assert rest[0] == pytest.approx(weakest_of(scene, branch).eigenvalue, rel=1e-4)


def test_what_a_plate_would_have_besides_is_told():
    scene = replace(SCENE, alpha=0.01)
    found = solve_loop(scene)
    told = next(left for left in found.omitted if left.term == GAUSS)
    assert told.matters
    # the angles that a fine mesh of the same shape lacks, extrapolated
    defects = []
    for mesh in refinements(loop_fan(), 4)[-2:]:
        x, y = mesh.points.T
        positions = found.shape.position(np.hypot(x, y), np.arctan2(y, x))
        defects.append(star_gauss_integral(mesh, positions))
    curved = 2 * defects[1] - defects[0]  # what is missing is a strip along the edge
    expected = -0.7 * 0.01 / 2 * curved / found.energy
    assert told.value == pytest.approx(expected, rel=5e-3)
    assert GAUSS not in {left.term for left in solve_loop(SCENE).omitted}


def test_stiff_fabric_bears_compression():
    """Slack fabric of that stiffness has no wrinkles that the basis could not show."""
    found = solve_loop(LoopScene(0.3, 0.002, 0.3, alpha=0.01))
    slack = next(left for left in found.omitted if left.term == SLACK)
    assert slack.value > 0
    assert not slack.matters
    assert found.lowest_eigenvalue > 0


def test_the_finest_wrinkle():
    assert finest_wrinkle(-0.02, 1e-4) == pytest.approx(20)
    assert finest_wrinkle(0.02, 0.0) == 0
    assert finest_wrinkle(-0.02, 0.0) == np.inf
