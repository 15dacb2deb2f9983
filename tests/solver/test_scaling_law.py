import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from solver.circle import stays_flat
from solver.flat import flat_radius
from solver.ladder.law import by_law, law_error
from solver.many import solve_many
from solver.reading import Reading
from solver.scaling_law import RMS_ERROR, scaling_height, scaling_loop
from solver.scene import LoopScene
from solver.threshold import critical_beta


def _answers(strain, beta, poisson, reading, stiffness):
    """Answers of the law, and the same loops in the smooth basis."""
    strain, beta, poisson, stiffness = np.broadcast_arrays(strain, beta, poisson, stiffness)
    found = solve_many(strain, beta, poisson, reading, stiffness, highest_degree=13)
    numbers = (axis.tolist() for axis in (strain, beta, poisson, stiffness))
    law = [
        by_law(LoopScene(e, b, nu, reading, k), "asked for")
        for e, b, nu, k in zip(*numbers, strict=True)
    ]
    return law, found


def _check_stated_errors(law, found):
    """Where the law states an error it holds, and no fabric is slack; return how many it knows."""
    sound = (found.status == "converged") & ~found.slack & ~found.meets
    known = np.isfinite([answer.height_error for answer in law])
    buckled = np.array([answer.buckled for answer in law])
    height = np.array([answer.height_over_perimeter for answer in law])
    stated = np.array([answer.height_error for answer in law])[known] * height[known]
    assert sound[known].all()
    assert (buckled == found.buckled)[known].all()
    assert (np.abs(height - found.height_over_perimeter)[known] <= stated).all()
    return (known & buckled).sum() / (found.buckled & sound).sum()


@pytest.mark.parametrize("stiffness", [1e3, 1e6])
@pytest.mark.parametrize("reading", list(Reading))
def test_stated_errors_hold_over_figure_2(reading, stiffness):
    """Slack loops among them: on a coarser grid than that of ``benchmarks/scaling_law.py``."""
    axes = np.meshgrid(
        [0, 0.002, 0.01, 0.05, *np.linspace(0.14, 0.5, 5)],
        np.geomspace(0.01, 0.25, 7),
        [0, 0.3, 0.45, 0.48, 0.49],
    )
    law, found = _answers(*(axis.ravel() for axis in axes), reading, stiffness)
    assert found.slack.any() == (reading is Reading.PUBLISHED)
    assert _check_stated_errors(law, found) > 0.8
    off = np.array([answer.height_over_perimeter for answer in law]) - found.height_over_perimeter
    good = np.isfinite([answer.height_error for answer in law]) & found.buckled
    assert np.sqrt(np.mean(off[good] ** 2)) < 1.5 * RMS_ERROR


@pytest.mark.parametrize("reading", list(Reading))
def test_stated_errors_hold_for_soft_wire(reading):
    uniform = np.random.default_rng(2).uniform(size=(4, 500))
    strain, beta, poisson = 0.5 * uniform[0] ** 1.5, 0.01 * 25 ** uniform[1], 0.49 * uniform[2]
    law, found = _answers(strain, beta, poisson, reading, 10 ** (4 * uniform[3]))
    assert _check_stated_errors(law, found) > 0.5


@pytest.mark.parametrize(
    ("strain", "beta", "poisson", "reading", "stiffness"),
    [
        (0.3, 0.0145, 0.3, Reading.PLANE_STRESS, 8.0),
        (0.3, 0.0145, 0.3, Reading.PLANE_STRESS, 0.01),
        (0.46, 0.05, 0.49, Reading.PUBLISHED, 1000.0),
        (0.5, 0.01, 0.4, Reading.PUBLISHED, 1e6),
    ],
)
def test_soft_wire_and_slack_fabric_are_not_known(strain, beta, poisson, reading, stiffness):
    assert law_error(LoopScene(strain, beta, poisson, reading, stiffness)) == float("inf")


@pytest.mark.parametrize("reading", list(Reading))
def test_exact_threshold_and_onset(reading):
    critical = critical_beta(0.3, 0.3, reading)
    assert scaling_height(0.3, 1.000001 * critical, 0.3, reading) == 0
    one, four = (scaling_height(0.3, critical * (1 - d), 0.3, reading) for d in (1e-4, 4e-4))
    assert one > 0
    assert four / one == pytest.approx(2, rel=1e-3)
    exact = solve_many(0.3, critical * 0.999, 0.3, reading, 1e7).height_over_perimeter
    assert scaling_height(0.3, critical * 0.999, 0.3, reading) == pytest.approx(exact, rel=0.1)


@settings(deadline=None, max_examples=300)
@given(
    st.floats(0, 0.5),
    st.floats(-2, -0.6),
    st.floats(0, 0.49),
    st.sampled_from(list(Reading)),
    st.floats(0, 6),
)
def test_the_threshold_is_exact_for_any_wire(strain, log_beta, poisson, reading, log_stiffness):
    scene = LoopScene(strain, 10**log_beta, poisson, reading, 10**log_stiffness)
    flat = stays_flat(scene)
    # on the threshold itself rounding decides
    assume(
        all(stays_flat(replace(scene, beta=scene.beta * c)) == flat for c in (1 - 1e-6, 1 + 1e-6))
    )
    found = scaling_loop(strain, scene.beta, poisson, reading, scene.axial_stiffness)
    assert (found.height == 0) == flat
    if flat:
        assert found.radius == pytest.approx(flat_radius(scene), rel=1e-8)


@settings(deadline=None, max_examples=300)
@given(
    st.floats(0, 2),
    st.floats(-6, 6),
    st.floats(-0.9, 0.4999),
    st.sampled_from(list(Reading)),
    st.floats(-6, 9),
)
def test_any_scene_gives_a_height(strain, log_beta, poisson, reading, log_stiffness):
    assert 0 <= scaling_height(strain, 10**log_beta, poisson, reading) < 0.4
    assert 0 <= scaling_height(strain, 10**log_beta, poisson, reading, 10**log_stiffness) < 0.8


def test_it_needs_no_numerical_library():
    code = (
        "import sys, solver.scaling_law; print([m for m in ('numpy', 'scipy') if m in sys.modules])"
    )
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert out.stdout.strip() == "[]"
