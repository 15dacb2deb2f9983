import numpy as np
import pytest

from solver.checks import CONTACT
from solver.compact import solve_loop
from solver.errors import SceneError
from solver.many import solve_many
from solver.reading import Reading
from solver.scene import LoopScene


@pytest.mark.parametrize("reading", list(Reading))
def test_as_one_by_one(reading):
    rng = np.random.default_rng(0)
    strain, beta, poisson = (rng.uniform(*ends, 40) for ends in ((0, 0.5), (0.01, 0.25), (0, 0.49)))
    found = solve_many(strain, beta, poisson, reading, tolerance=1e-3)
    for i in range(40):
        scene = LoopScene(strain[i], beta[i], poisson[i], reading)
        alone = solve_loop(scene, tolerance=1e-3, allow_unreliable=True)
        assert found.status[i] == alone.status
        assert found.buckled[i] == alone.buckled
        height = alone.shape.height_over_perimeter
        assert found.height_over_perimeter[i] == pytest.approx(height, rel=1e-6)
        assert found.energy[i] == pytest.approx(alone.energy, rel=1e-9)
        assert found.width[i] == pytest.approx(alone.shape.width, rel=1e-6)
        assert found.lowest_eigenvalue[i] == pytest.approx(alone.lowest_eigenvalue, rel=1e-3)
        slack = next(left for left in alone.omitted if left.term.startswith("slack"))
        assert found.slack[i] == slack.matters


def test_the_grid_of_fig_2():
    beta, strain = np.linspace(0.01, 0.25, 25)[:, None], np.linspace(0, 0.5, 26)
    found = solve_many(strain, beta, 0.3)
    assert found.height_over_perimeter.shape == (25, 26)
    assert (found.status == "converged").all()
    height = found.height_over_perimeter
    assert (np.diff(height, axis=0) <= 0).all()
    assert (height[found.buckled] > 0).all()
    assert (height[~found.buckled] == 0).all()


def test_what_does_not_settle_is_told():
    found = solve_many(0.3, [0.002, 0.0145], 0.3)
    assert "not a minimum" in found.status[0]
    assert found.status[1] == "converged"


def test_out_of_range():
    with pytest.raises(SceneError, match="beta"):
        solve_many(0.3, [0.01, -1.0], 0.3)


def test_nothing_to_solve():
    assert solve_many([], [], []).energy.shape == (0,)


def test_meeting_is_judged_as_alone():
    strain = [0.7, 0.85]
    found = solve_many(strain, [0.007, 0.008], 0.45, Reading.PLANE_STRESS, 50.0)
    for k, e in enumerate(strain):
        scene = LoopScene(e, (0.007, 0.008)[k], 0.45, axial_stiffness=50.0)
        alone = solve_loop(scene, tolerance=1e-3, allow_unreliable=True)
        assert found.meets[k] == any(left.term == CONTACT and left.fatal for left in alone.omitted)
    assert found.meets.tolist() == [False, True]
