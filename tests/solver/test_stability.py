import numpy as np
import pytest

from solver.compact import solve_loop
from solver.flat import flat_shape
from solver.reading import Reading
from solver.scene import LoopScene
from solver.stability import CLASSES, class_hessian, free_motions, lowest_eigenvalue
from solver.symmetry import mirror_class
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
