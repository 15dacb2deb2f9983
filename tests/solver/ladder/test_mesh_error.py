"""The error that a mesh states covers the true one, which the smooth basis tells."""

from dataclasses import replace

import numpy as np
import pytest

from solver.compact import solve_loop
from solver.ladder.choose import solve_scene
from solver.ladder.contact import ContactChoice
from solver.ladder.fidelity import Fidelity
from solver.ladder.mesh_error import _rest
from solver.mesh.array_mesh import Between
from solver.mesh.omissions import WHOLE
from solver.mesh.scene import ArrayScene
from solver.scene import LoopScene

LOOP = LoopScene(0.3, 0.0145, 0.3)


def _left(*heights):
    first, second, third = (np.array([height]) for height in heights)
    return float(_rest(third - second, second - first)[0])


@pytest.mark.parametrize("ratio", [1.5, 2.0, 3.0, 4.0])
def test_a_geometric_series_is_summed(ratio):
    heights = [1 - 0.1 / ratio**k for k in range(3)]
    assert _left(*heights) == pytest.approx(1 - heights[2])


def test_meshes_that_agree_by_chance_are_not_trusted():
    assert _left(0.9, 1.0, 1.0) == pytest.approx(0.1 / 16)
    # heights that overshoot, or do not come nearer to each other
    assert _left(0.9, 1.0, 0.98) == pytest.approx(2 * 0.02)
    assert _left(0.9, 0.92, 0.96) == pytest.approx(2 * 0.04)


def test_one_change_alone_counts_twice():
    last = np.array([0.01])
    assert _rest(last, np.array([np.nan])) == pytest.approx(0.02)
    assert _rest(0 * last, 0 * last) == 0


CURVED = LoopScene(0.3, 0.0145, 0.3, natural_curvature=1.0)
ORTHOTROPIC = LoopScene(
    1.08126,
    0.0210054,
    -0.37451,
    axial_stiffness=713.94,
    modulus_ratio=1.5318,
    natural_curvature=1.0113,
)
NEAR_THRESHOLD = LoopScene(0.01191, 0.00077, -0.195, axial_stiffness=22352.0, modulus_ratio=1.18)


@pytest.mark.parametrize(
    ("scene", "tolerance"),
    [
        (LOOP, 1e-2),
        (LOOP, 1e-3),
        (CURVED, 1e-3),
        (ORTHOTROPIC, 1e-2),
        (NEAR_THRESHOLD, 1e-2),
        (LoopScene(0.3, 0.0225, 0.3, axis_ratio=1.5, twist_ratio=0.75), 5e-3),
    ],
)
def test_the_stated_error_covers_the_true_one(scene, tolerance):
    exact = solve_loop(scene, tolerance=1e-6).shape.height_over_perimeter
    answer = solve_scene(scene, fidelity=Fidelity.MESH, tolerance=tolerance)
    assert answer.height_error <= tolerance
    assert abs(answer.height_over_perimeter / exact - 1) <= answer.height_error


def test_no_mesh_is_finer_than_needed():
    triangles = [
        len(solve_scene(LOOP, fidelity=Fidelity.MESH, tolerance=t).equilibrium.mesh.triangles)
        for t in (1e-2, 1e-3)
    ]
    assert triangles == [1280, 5120]


def test_arrays_that_hinge_on_wrinkled_fabric_are_told_by_their_loops():
    """The whole's height settles later, which is told by itself."""
    scene = ArrayScene(LOOP, 2, 2, Between.KEPT)
    answer = solve_scene(scene, contact=ContactChoice.OFF, tolerance=0.02)
    found = answer.equilibrium
    loops = np.abs(found.loop_heights - found.coarser_loop_heights).max() / 3
    assert answer.height_error == pytest.approx(loops / found.loop_heights.max())
    assert "the loops' own heights" in answer.reason
    (whole,) = (left for left in answer.omitted if left.term == WHOLE)
    change = abs(found.height - found.coarser_height) / found.height
    assert whole.value == pytest.approx(change)
    assert whole.matters
    assert change > 3 * answer.height_error
    cut = solve_scene(replace(scene, between=Between.CUT), fidelity=Fidelity.MESH, tolerance=0.02)
    assert all(left.term != WHOLE for left in cut.omitted)
