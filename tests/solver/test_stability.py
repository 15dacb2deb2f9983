import numpy as np
import pytest

from solver.checks import smallest_principal_stress
from solver.circle import telling_degree
from solver.compact import solve_loop
from solver.disc_basis import disc_basis
from solver.flat import flat_shape
from solver.loop_energy import scene_membrane
from solver.reading import Reading
from solver.scene import LoopScene
from solver.shape import from_expansion
from solver.stability import (
    CLASSES,
    class_hessian,
    classes_of,
    free_motions,
    hessian_along,
    lowest_eigenvalue,
    motions,
    weakest_motion,
    wire_curvature,
)
from solver.symmetry import ALIGNED, DIAGONAL, FLAT, mirror_class
from solver.threshold import critical_beta


@pytest.fixture(scope="module")
def saddle():
    scene = LoopScene(0.3, 0.0145, 0.3)
    shape = solve_loop(scene, tolerance=1e-7).shape
    # on another basis than its own the shape is not stationary, and turning it costs a little
    degree = max(f.degree for component, f in shape.expansion if component == 0)
    return scene, shape, degree


@pytest.mark.parametrize("symmetry", [*CLASSES, (0, 1)])
def test_free_motions_cost_nothing(saddle, symmetry):
    scene, shape, degree = saddle
    hessian, free = class_hessian(scene, shape, degree, symmetry)
    assert np.abs(hessian @ free).max() < 1e-6
    eigenvalues = np.linalg.eigvalsh(hessian)
    assert np.sum(np.abs(eigenvalues) < 1e-6) == free.shape[1]


def test_a_saddle_has_seven_free_motions(saddle):
    scene, shape, degree = saddle
    classes = (*CLASSES, (0, 1))
    assert sum(class_hessian(scene, shape, degree, c)[1].shape[1] for c in classes) == 7
    assert sum(len(free_motions(shape, c)) for c in classes) == 7


def test_a_quarter_turn_swaps_two_classes(saddle):
    scene, shape, degree = saddle
    one, other = (class_hessian(scene, shape, degree, c)[0] for c in ((1, 0), (0, 1)))
    assert np.linalg.eigvalsh(one)[2:] == pytest.approx(np.linalg.eigvalsh(other)[2:], rel=1e-6)


def test_flat_beyond_the_threshold_is_seen_to_be_unstable():
    flat = solve_loop(LoopScene(0.3, 0.05, 0.3)).shape
    assert lowest_eigenvalue(LoopScene(0.3, 0.05, 0.3), flat, 5) > 0
    assert lowest_eigenvalue(LoopScene(0.3, 0.03, 0.3), flat, 5) < 0


def test_the_third_mode_follows_at_twice_the_beta():
    """n = 2 at T = 12 β, n = 3 at T = 24 β: the first mode of the classes that hold no cos 2θ."""
    rises = [unknown[0].component == 2 for unknown in mirror_class(5, 1, 0)]
    critical = critical_beta(0.3, 0.3, Reading.PLANE_STRESS, mode=3)
    for factor, sign in ((1.001, 1), (0.999, -1)):
        scene = LoopScene(0.3, factor * critical, 0.3, axial_stiffness=1e7)
        hessian, _ = class_hessian(scene, flat_shape(scene, 5), 5, (1, 0))
        eigenvalues = np.linalg.eigvalsh(hessian[np.ix_(rises, rises)])
        tilt = np.argmin(np.abs(eigenvalues))  # a rigid rotation, which costs nothing
        assert np.sign(np.delete(eigenvalues, tilt)[0]) == sign


@pytest.mark.parametrize(("beta", "strain"), [(0.0145, 0.3), (0.03, 0.5), (0.007, 0.2)])
def test_few_motions_tell_the_stability_of_taut_fabric(beta, strain):
    """Those up to the telling degree come near to those of all degrees."""
    scene = LoopScene(strain, beta, 0.3)
    basis = disc_basis(9, "saddle")
    q = from_expansion(basis.unknowns, solve_loop(scene).shape.expansion)
    stress = smallest_principal_stress(scene_membrane(scene), basis.gradient @ q)
    assert stress > 0
    few, all_ = (
        weakest_motion(scene, "saddle", basis, q, highest).eigenvalue
        for highest in (telling_degree(scene, stress, 9), 10)
    )
    assert telling_degree(scene, stress, 9) < 10
    assert all_ <= few < 1.05 * all_


def test_slack_fabric_and_thin_wire_need_motions_of_all_degrees():
    assert telling_degree(LoopScene(0.3, 0.0145, 0.3), -0.01, 9) == 10
    assert telling_degree(LoopScene(0.3, 1e-4, 0.3), 0.1, 17) == 18
    assert telling_degree(LoopScene(0.3, 1e-3, 0.3), 0.1, 17) == 16


@pytest.mark.parametrize("space", ["saddle", "oblique", ALIGNED, DIAGONAL, FLAT])
def test_all_classes_of_a_space_see_the_same_points_of_the_wire(space):
    basis = disc_basis(5, space)
    for symmetry in classes_of(space):
        moves = motions(basis, space, symmetry, 6)
        assert moves.basis.angle == pytest.approx(moves.home.angle)


@pytest.mark.parametrize("symmetry", classes_of("saddle"))
def test_the_tabulated_second_variation_is_the_integrated_one(symmetry):
    scene, basis = LoopScene(0.3, 0.0145, 0.3), disc_basis(7, "saddle")
    q = solve_loop(scene, tolerance=1e-2).shape.coefficients
    moves = motions(basis, "saddle", symmetry, 6)
    wire = wire_curvature(scene, moves, q)
    tabulated, integrated = (
        hessian_along(scene, moves, q, wire, tabulated=quick) for quick in (True, False)
    )
    assert moves.few
    assert tabulated == pytest.approx(integrated, abs=1e-9)
