"""Twist of the wire: its derivatives, its writhe by the double sum, and which saddle it favours."""

from dataclasses import replace

import numpy as np
import pytest

from solver.branches import flat_state, solve_branch, weakest_of
from solver.checks import twist_share, writhe, writhe_strays
from solver.compact import solve_loop
from solver.disc_basis import disc_basis, transfer
from solver.equilibrium import Kind
from solver.errors import SceneError
from solver.loop_energy import loop_energy
from solver.scene import LARGEST_TWIST_RATIO, ROUND_WIRE_TWIST_RATIO, LoopScene
from solver.shape import LoopShape
from solver.symmetry import ALIGNED, DIAGONAL, HALF_TURN, Mirrors, Symmetry
from solver.twist import flat_wire_twist, writhe_curvature, writhe_slope

_ALL: tuple[Mirrors, ...] = ((0, 0), (1, 1), (1, 0), (0, 1))
ANYTHING = Symmetry(_ALL, _ALL)
SCENE = LoopScene(0.3, 0.0145, 0.3, axis_ratio=1.5)
TWISTED = replace(SCENE, twist_ratio=ROUND_WIRE_TWIST_RATIO)


@pytest.fixture(scope="module")
def diagonal():
    return solve_branch(TWISTED, DIAGONAL, 1e-5)


def _some_shape(space):
    """Give a smooth shape without any symmetry but the space's, near the diagonal saddle."""
    branch = solve_branch(SCENE, DIAGONAL, 1e-2)
    basis = disc_basis(11, space)
    scale = 0.1 * 0.3 ** np.array([unknown[0].function.degree for unknown in basis.unknowns])
    disturbed = scale * np.random.default_rng(0).normal(size=basis.size)
    return basis, transfer(branch.basis, basis) @ branch.unknowns + disturbed


def _twist(basis, scene=TWISTED):
    return flat_wire_twist(scene.beta, scene.twist_ratio, scene.semi_axes, basis.angle)


def _polygons_writhe(basis, q):
    """Writhe by the double sum, extrapolated from polygons of two sizes."""
    coarse, fine = (writhe(LoopShape(basis.unknowns, q).edge(n)) for n in (100, 200))
    return (4 * fine - coarse) / 3


@pytest.mark.parametrize("space", [DIAGONAL, "oblique", HALF_TURN, ANYTHING])
def test_writhe_by_the_double_sum(space):
    basis, q = _some_shape(space)
    turns = _twist(basis).writhe(basis.along_edge(q), basis.arc)
    assert abs(turns) > 0.1
    assert turns == pytest.approx(_polygons_writhe(basis, q), rel=1e-5)


@pytest.mark.parametrize("space", [DIAGONAL, "oblique", ANYTHING])
def test_derivatives_of_the_writhe(space):
    basis, q = _some_shape(space)
    twist, step = _twist(basis), 1e-5
    units = step * np.eye(basis.size)

    def turns(at):
        return twist.writhe(basis.along_edge(at), basis.arc)

    def slope(at):
        return writhe_slope(basis.along_edge(at), basis.arc, basis.edge)

    by_differences = np.array([turns(q + u) - turns(q - u) for u in units]) / (2 * step)
    assert slope(q) == pytest.approx(by_differences, abs=1e-6 * np.abs(by_differences).max())
    second = np.array([slope(q + u) - slope(q - u) for u in units]) / (2 * step)
    exact = writhe_curvature(basis.along_edge(q), basis.arc, basis.edge)
    assert np.abs(exact - second).max() < 1e-5 * np.abs(exact).max()
    assert np.array_equal(exact, exact.T)


def test_derivatives_of_the_energy():
    basis, q = _some_shape("oblique")
    twist, step = _twist(basis), 1e-5
    units = step * np.eye(basis.size)

    def derivatives(at):
        return twist.derivatives(basis.along_edge(at), basis.arc, basis.edge)

    value, slope, hessian = derivatives(q)
    assert value == twist.energy(basis.along_edge(q), basis.arc)
    ahead, behind = ([derivatives(q + sign * u) for u in units] for sign in (1, -1))
    first = np.array([a[0] - b[0] for a, b in zip(ahead, behind, strict=True)]) / (2 * step)
    second = np.array([a[1] - b[1] for a, b in zip(ahead, behind, strict=True)]) / (2 * step)
    assert slope == pytest.approx(first, abs=1e-6 * np.abs(first).max())
    assert np.abs(hessian - second).max() < 1e-5 * np.abs(hessian).max()


def test_energy_of_a_turn():
    """GJ/2 τ² along 2π, with τ = Wr, GJ = ρ EI and EI = 2β."""
    basis, q = _some_shape(DIAGONAL)
    twist, edge = _twist(basis), basis.along_edge(q)
    rate = twist.writhe(edge, basis.arc)
    expected = 0.75 * (2 * TWISTED.beta) / 2 * rate**2 * 2 * np.pi
    assert twist.energy(edge, basis.arc) == pytest.approx(expected)


def test_mirror_image():
    """Its writhe is the opposite, and its energy the same."""
    energy = loop_energy(TWISTED, disc_basis(_some_shape(DIAGONAL)[0].degree, DIAGONAL))
    basis, q = energy.basis, _some_shape(DIAGONAL)[1]
    mirror = np.array([-1.0 if unknown[0].component == 2 else 1.0 for unknown in basis.unknowns])
    assert energy.twist is not None
    turns = [energy.twist.writhe(basis.along_edge(s * q), basis.arc) for s in (1.0, mirror)]
    assert turns[0] == pytest.approx(-turns[1])
    assert energy.value(q) == pytest.approx(energy.value(mirror * q), rel=1e-12)


def test_turning_and_moving_change_no_writhe():
    basis, q = _some_shape(ANYTHING)
    edge = basis.along_edge(q)
    slope = writhe_slope(edge, basis.arc, basis.edge)
    for i, j in ((0, 1), (1, 2), (0, 2)):
        generator = np.zeros((3, 3))
        generator[i, j], generator[j, i] = -1, 1
        # the motion's own unknowns, found from what it does to the edge
        turned = np.concatenate([edge[:, :3] @ generator.T, edge[:, 3:] @ generator.T], axis=1)
        flat_map = basis.edge.reshape(-1, basis.size)
        motion = np.linalg.lstsq(flat_map, turned.ravel(), rcond=None)[0]
        assert flat_map @ motion == pytest.approx(turned.ravel(), abs=1e-9)
        assert abs(slope @ motion) < 1e-9


@pytest.mark.parametrize("space", ["saddle", ALIGNED])
def test_mirrors_need_no_twist(space):
    assert loop_energy(TWISTED, disc_basis(5, space)).twist is None
    assert loop_energy(SCENE, disc_basis(5, DIAGONAL)).twist is None
    assert loop_energy(TWISTED, disc_basis(5, DIAGONAL)).twist is not None


def test_a_circle_is_as_without_twist():
    scene = LoopScene(0.3, 0.0145, 0.3)
    without, twisted = solve_loop(scene), solve_loop(replace(scene, twist_ratio=0.75))
    assert np.array_equal(without.shape.coefficients, twisted.shape.coefficients)
    assert twisted.kind is Kind.SADDLE
    assert twisted.energy == without.energy
    assert twisted.lowest_eigenvalue >= without.lowest_eigenvalue


def test_the_flat_circles_stiffness_is_as_without_twist():
    """Its curvature is the same all round, so that no rise makes it writhe to first order."""
    for beta in (0.03, 0.05):
        scene = LoopScene(0.3, beta, 0.3, modulus_ratio=1.1)
        twisted = replace(scene, twist_ratio=0.75)
        without, with_twist = (flat_state(s)[1].eigenvalue for s in (scene, twisted))
        circle = replace(scene, modulus_ratio=1 + 1e-9), replace(twisted, modulus_ratio=1 + 1e-9)
        assert with_twist >= without - 1e-9
        assert len({round(flat_state(s)[1].eigenvalue, 6) for s in circle}) == 1


@pytest.mark.parametrize("space", [DIAGONAL, ALIGNED])
def test_classes_of_motions_hold_all_motions(space):
    """The second variation among all shapes at once, with twist, has the same lowest eigenvalue."""
    branch = solve_branch(TWISTED, space, 3e-3)
    basis = disc_basis(branch.basis.degree, ANYTHING)
    q = transfer(branch.basis, basis) @ branch.unknowns
    eigenvalues = np.linalg.eigvalsh(loop_energy(TWISTED, basis).derivatives(q)[2])
    free = np.argsort(np.abs(eigenvalues))[:6]
    rest = np.delete(eigenvalues, free)
    assert np.abs(eigenvalues[free]).max() < 1e-5
    assert rest[0] == pytest.approx(weakest_of(TWISTED, branch).eigenvalue, rel=1e-4)


def test_a_little_twist_costs_what_the_untwisted_shape_tells():
    """To first order in ρ the energy rises by that of the twist at the shape without."""
    without = solve_branch(SCENE, DIAGONAL, 1e-5)
    turns = _twist(without.basis).writhe(
        without.basis.along_edge(without.unknowns), without.basis.arc
    )
    little = solve_branch(replace(SCENE, twist_ratio=1e-4), DIAGONAL, 1e-5)
    rise = (little.minimum.value - without.minimum.value) / 1e-4
    assert rise == pytest.approx(2 * np.pi * SCENE.beta * turns**2, rel=1e-3)


def test_twist_turns_the_lowest_saddle_into_line_with_the_ellipse(diagonal):
    found = solve_loop(TWISTED)
    assert found.kind is Kind.ALIGNED
    assert found.lowest_eigenvalue > 0.05
    assert found.energy < diagonal.minimum.value - 1e-3
    assert weakest_of(TWISTED, diagonal).eigenvalue < -0.05
    assert solve_loop(SCENE).kind is Kind.DIAGONAL


def test_of_a_thicker_wire_the_diagonal_saddle_stays():
    """Its writhe is less, as it rises less."""
    found = solve_loop(LoopScene(0.3, 0.0225, 0.3, axis_ratio=1.5, twist_ratio=0.75))
    assert found.kind is Kind.DIAGONAL
    assert found.energy_terms["wire twist"] > 1e-3
    assert found.lowest_eigenvalue > 0.01


@pytest.mark.parametrize(("axis_ratio", "beta"), [(1.5, 0.0205), (2.0, 0.0222)])
def test_between_the_two_the_minimum_is_oblique(axis_ratio, beta):
    scene = LoopScene(0.3, beta, 0.3, axis_ratio=axis_ratio, twist_ratio=0.75)
    saddles = [solve_branch(scene, space, 1e-4) for space in (DIAGONAL, ALIGNED)]
    assert all(weakest_of(scene, saddle).eigenvalue < -1e-3 for saddle in saddles)
    found = solve_loop(scene)
    assert found.kind is Kind.OBLIQUE
    assert found.lowest_eigenvalue > 1e-3
    assert found.energy < min(saddle.minimum.value for saddle in saddles)


def test_at_the_edge_of_the_window_the_oblique_minimum_is_found():
    """The shift along z is among its unknowns; it must not stand in the way of Newton's steps."""
    found = solve_loop(LoopScene(0.3, 0.02071, 0.3, axis_ratio=1.5, twist_ratio=0.75))
    assert found.kind is Kind.OBLIQUE
    assert 0 < found.lowest_eigenvalue < 2e-3


def test_twist_keeps_a_long_ellipse_flat():
    scene = LoopScene(0.3, 0.025, 0.3, axis_ratio=3.0)
    assert solve_loop(scene).buckled
    assert not solve_loop(replace(scene, twist_ratio=0.75)).buckled


def test_what_is_left_out_is_told_as_a_share_of_the_energy():
    found = solve_loop(SCENE)
    branch = solve_branch(SCENE, DIAGONAL, 1e-4)
    told = next(left for left in found.omitted if left.term == "twist of the wire")
    turns = _polygons_writhe(branch.basis, branch.unknowns)
    assert told.matters
    assert told.value == pytest.approx(
        2 * np.pi * SCENE.beta * 0.75 * turns**2 / found.energy, rel=1e-3
    )
    assert twist_share(SCENE, disc_basis(5, ALIGNED), np.zeros(1), 0.0) == 0
    assert "twist of the wire" not in {left.term for left in solve_loop(TWISTED).omitted}


def test_a_writhe_that_strays_is_seen(diagonal):
    """As it would by the way from a flat loop run round the other way."""
    energy, q = diagonal.energy, diagonal.unknowns
    assert energy.twist is not None
    assert not writhe_strays(energy, q)
    laid = energy.twist.laid
    inside_out = replace(energy.twist, laid=laid * [1, -1, 1, 1, -1, 1])
    assert writhe_strays(replace(energy, twist=inside_out), q)


@pytest.mark.parametrize("ratio", [-0.1, 1.01 * LARGEST_TWIST_RATIO, float("nan")])
def test_ratio_out_of_range(ratio):
    with pytest.raises(SceneError, match="twist_ratio"):
        LoopScene(0.3, 0.0145, 0.3, twist_ratio=ratio)


def test_a_curved_wire_is_not_twisted():
    with pytest.raises(SceneError, match="straight wire"):
        LoopScene(0.3, 0.0145, 0.3, twist_ratio=0.75, natural_curvature=0.5)
