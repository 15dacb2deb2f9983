import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solver.many import solve_many
from solver.reading import Reading
from solver.scaling_law import LARGEST_ERROR, RMS_ERROR, scaling_height
from solver.threshold import critical_beta


@pytest.mark.parametrize("reading", list(Reading))
def test_stated_errors(reading):
    """On a coarser grid than that of ``benchmarks/scaling_law.py``."""
    strain, beta, poisson = (
        axis.ravel()
        for axis in np.meshgrid(
            np.linspace(0.05, 0.5, 5), np.geomspace(0.01, 0.25, 6), [0, 0.3, 0.45, 0.49]
        )
    )
    found = solve_many(strain, beta, poisson, reading, 1e6)
    good = (found.status == "converged") & found.buckled & ~found.slack
    law = [
        scaling_height(e, b, nu, reading)
        for e, b, nu in zip(strain[good], beta[good], poisson[good], strict=True)
    ]
    error = law - found.height_over_perimeter[good]
    assert good.sum() > 20
    assert np.abs(error).max() < LARGEST_ERROR
    assert np.sqrt(np.mean(error**2)) < 1.5 * RMS_ERROR
    ordinary = poisson[good] <= (0.49 if reading is Reading.PLANE_STRESS else 0.45)
    assert np.abs(error[ordinary]).max() < 0.004


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
@given(st.floats(0, 2), st.floats(-6, 6), st.floats(-0.9, 0.4999), st.sampled_from(list(Reading)))
def test_any_scene_gives_a_height(strain, log_beta, poisson, reading):
    assert 0 <= scaling_height(strain, 10**log_beta, poisson, reading) < 0.4


def test_it_needs_no_numerical_library():
    code = (
        "import sys, solver.scaling_law; print([m for m in ('numpy', 'scipy') if m in sys.modules])"
    )
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert out.stdout.strip() == "[]"
