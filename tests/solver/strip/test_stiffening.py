"""A strip half of which the sleeves stiffen."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from solver.errors import SceneError
from solver.strip.basis import strip_basis
from solver.strip.ends import Ends
from solver.strip.phase import at_rest, first_state
from solver.strip.scene import StripScene
from solver.strip.snap import solve_strip
from solver.strip.state import Side

SCENE = StripScene(0.12, 0.115, 0.02, 0.38e-3)


def _stepped(stiffening, **keys):
    added = stiffening * SCENE.stiffness_N_m2
    return replace(SCENE, sleeve_stiffness_N_m2=added, **keys)


def _load_of_a_stepped_column(ratio):
    """P of a pinned column with EI·ratio on one half: k1 cot(k1/2) + k2 cot(k2/2) = 0, k² = P/EI.

    From sines on both halves that meet with equal height and slope.
    """

    def mismatch(force):
        k1, k2 = np.sqrt(force / ratio), np.sqrt(force)
        return k1 / np.tan(k1 / 2) + k2 / np.tan(k2 / 2)

    return brentq(mismatch, np.pi**2, min(np.pi**2 * ratio, (2 * np.pi) ** 2 * 0.999))


@pytest.mark.parametrize("stiffening", [0.3, 1.5, 20.0])
def test_the_nearly_straight_strip_buckles_as_a_stepped_column(stiffening):
    basis = strip_basis((0.0, 0.5), Ends.PINNED, 24).stiffened(stiffening)
    state = first_state(at_rest(basis, 1e-8), Ends.PINNED)
    assert state.force[0] == pytest.approx(_load_of_a_stepped_column(1 + stiffening), rel=1e-7)


def test_only_the_covered_part_is_stiffer():
    plain = strip_basis((0.1, 0.4), Ends.PINNED, 8)
    x = np.random.default_rng(1).normal(size=plain.size)
    arc = np.linspace(0.1, 0.4, 20001)[:-1]
    within = 0.3 * np.mean((plain.curvature_at(arc + 0.3 / 40000) @ x) ** 2)
    more = x @ (plain.stiffened(0.7).stiffness - plain.stiffness) @ x
    assert more == pytest.approx(0.7 * within, rel=1e-6)
    back = plain.stiffened(0.7).stiffened(0.0).stiffness
    assert back == pytest.approx(plain.stiffness, abs=1e-14)


def test_the_other_half_does_the_same():
    one = solve_strip(_stepped(1.4))
    other = solve_strip(_stepped(1.4, covered=(0.5, 1.0)))
    up = Side.UP
    assert other.barrier_J(up) == pytest.approx(one.barrier_J(up), rel=1e-9)
    couples = [found.pushed[up].critical_couple_N_m for found in (one, other)]
    assert couples[0] == pytest.approx(couples[1], rel=1e-9)


def test_sleeves_make_it_harder_to_snap():
    couples = [solve_strip(_stepped(s)).pushed[Side.UP].critical_couple_N_m for s in (0, 0.5, 2)]
    assert couples[0] < couples[1] < couples[2]


@pytest.mark.parametrize("stiffening", [-0.1, 200.0, float("nan")])
def test_stiffness_out_of_range_is_refused(stiffening):
    with pytest.raises(SceneError, match=r"sleeve_stiffness_N_m2 = .*must be from 0 to 100 times"):
        _stepped(stiffening)
