from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solver.strip.basis import strip_basis
from solver.strip.elastica import Elastica
from solver.strip.ends import Ends
from solver.strip.path import stable_branch
from solver.strip.phase import at_rest, first_state
from solver.strip.scene import StripScene
from solver.strip.snap import solve_strip
from solver.strip.state import Side

SCENE = StripScene(0.12, 0.115, 0.02, 0.38e-3)
UP, DOWN, BETWEEN = Side.UP, Side.DOWN, Side.BETWEEN


@pytest.fixture(scope="module")
def rest():
    return solve_strip(SCENE)


def _pushed(factor, rest, **keys):
    couple = factor * rest.pushed[UP].critical_couple_N_m
    return solve_strip(replace(SCENE, couple_bottom_N_m=couple, **keys))


def test_both_states_and_the_barrier_in_closed_form(rest):
    unit = SCENE.energy_unit_J
    first, second = (Elastica(SCENE.shortening, n).energy * unit for n in (1, 2))
    for side, sign in ((UP, 1), (DOWN, -1)):
        state = rest.unloaded[side]
        assert state.energy_J == pytest.approx(first, rel=1e-9)
        assert np.sign(state.height_m) == sign
        assert state.eigenvalue_J > 0
        assert rest.barrier_J(side) == pytest.approx(second - first, rel=1e-9)
        assert not rest.snaps(side)
    assert rest.saddle.eigenvalue_J < 0


def test_mirrored_states_snap_alike(rest):
    up, down = rest.pushed[UP], rest.pushed[DOWN]
    assert down.critical_couple_N_m == -up.critical_couple_N_m
    assert down.released_J == pytest.approx(up.released_J, rel=1e-12)
    mirrored = up.before.points_m * [1, -1]
    assert down.before.points_m == pytest.approx(mirrored, abs=1e-12)


def test_a_sleeve_on_the_other_half_does_the_same(rest):
    other = solve_strip(replace(SCENE, covered=(0.5, 1.0))).pushed[UP]
    one = rest.pushed[UP]
    assert other.critical_couple_N_m == pytest.approx(one.critical_couple_N_m, rel=1e-9)
    turned = [SCENE.constraint_m, 0] + one.before.points_m[::-1] * [-1, 1]
    # a shape at a fold moves with the root of rounding
    assert other.before.points_m == pytest.approx(turned, abs=1e-7)


def test_only_the_difference_of_the_couples_counts(rest):
    both = solve_strip(replace(SCENE, couple_top_N_m=2e-3, couple_bottom_N_m=3e-3))
    alone = solve_strip(replace(SCENE, couple_bottom_N_m=1e-3))
    for side in (UP, DOWN):
        assert both.barrier_J(side) == pytest.approx(alone.barrier_J(side), rel=1e-9)
    residual = solve_strip(replace(SCENE, couple_top_N_m=2e-3, couple_bottom_N_m=2e-3))
    assert residual.barrier_J(UP) == pytest.approx(rest.barrier_J(UP), rel=1e-12)


@pytest.mark.parametrize("factor", [0.5, 0.999, 1.001, 2.0])
def test_a_couple_snaps_the_state_on_whose_concave_side_it_acts(factor, rest):
    found = _pushed(factor, rest)
    assert found.snaps(UP) == (factor > 1)
    assert not found.snaps(DOWN)
    snap = found.snap(UP)
    assert snap.margin(found.scene.couple_N_m) == pytest.approx(factor - 1, rel=1e-9)
    assert snap.after.side is DOWN
    assert snap.released_J > 0
    assert (found.barrier_J(UP) > 0) == (factor < 1)


def test_the_barrier_vanishes_with_the_power_three_halves_at_the_fold(rest):
    barriers = [_pushed(1 - d, rest).barrier_J(UP) for d in (4e-3, 1e-3)]
    assert barriers[0] / barriers[1] == pytest.approx(8, rel=0.02)


def test_the_sleeves_half_turns_over_before_the_snap(rest):
    """Its curvature changes sign; the inflection lies where the sleeve ends or within its half."""
    before = rest.pushed[UP].before
    (place,) = before.inflections_m
    assert 0.3 * SCENE.length_m < place <= 0.5 * SCENE.length_m
    assert before.curvatures_per_m[20] > 0 > before.curvatures_per_m[-20]


def test_from_the_fold_downhill_lies_the_other_state(rest):
    """By steepest descent that keeps the chord, from a little beyond the fold."""
    balance = at_rest(strip_basis(SCENE.covered, SCENE.ends, 12), SCENE.shortening)
    end = stable_branch(balance, first_state(balance, SCENE.ends), 1, 20.0).end
    motion = balance.weakest(end)[1]
    sign = np.sign(balance.basis.turn @ motion)
    x, couple = end.x + 1e-2 * sign * motion / np.linalg.norm(motion), 1.001 * end.couple
    for _ in range(4000):
        values, slopes = balance.conditions(x)
        slope = balance.basis.stiffness @ x - couple * balance.basis.turn
        slope -= slopes.T @ np.linalg.lstsq(slopes.T, slope, rcond=None)[0]
        x = x - 0.1 * slope - np.linalg.lstsq(slopes, values, rcond=None)[0]
    energy = balance.energy(x, couple) * SCENE.energy_unit_J
    other = _pushed(1.001, rest).loaded[DOWN]
    assert energy == pytest.approx(other.energy_J, rel=1e-6)


def test_sizes_scale(rest):
    """Energies and couples with EI/L, forces with EI/L², lengths with L."""
    big = solve_strip(StripScene(1.2, 1.15, 0.1, 2e-3, modulus_Pa=7e10))
    ratio = big.scene.energy_unit_J / SCENE.energy_unit_J
    one, other = rest.pushed[UP], big.pushed[UP]
    assert other.critical_couple_N_m == pytest.approx(ratio * one.critical_couple_N_m, rel=1e-9)
    assert other.released_J == pytest.approx(ratio * one.released_J, rel=1e-9)
    assert big.unloaded[UP].force_N == pytest.approx(ratio / 10 * rest.unloaded[UP].force_N)
    assert big.unloaded[UP].points_m == pytest.approx(10 * rest.unloaded[UP].points_m, abs=1e-12)


def test_clamped_states_merge_gently_into_one():
    """A sleeve on half of a little bent clamped strip does not snap it."""
    scene = StripScene(0.12, 0.115, 0.02, 0.38e-3, ends=Ends.CLAMPED)
    snap = solve_strip(scene).pushed[UP]
    assert snap.merges
    assert snap.released_J is None
    beyond = solve_strip(replace(scene, couple_bottom_N_m=1.05 * snap.critical_couple_N_m))
    assert list(beyond.loaded) == [BETWEEN]
    assert beyond.loaded[BETWEEN].eigenvalue_J > 0
    assert beyond.barrier_J(UP) == 0


def test_a_clamped_strip_that_is_bent_far_snaps():
    snap = solve_strip(StripScene(0.12, 0.06, 0.02, 0.38e-3, ends=Ends.CLAMPED)).pushed[UP]
    assert not snap.merges
    # both states end at the same couple, since it drives what lies between them only
    assert snap.after.side is BETWEEN
    assert snap.after.eigenvalue_J > 0
    assert snap.released_J > 0


@settings(deadline=None, max_examples=12)
@given(st.floats(-8, -0.005), st.floats(-1, 1), st.floats(0, 0.3), st.floats(0.2, 0.5))
def test_any_pinned_strip_ends_well(exponent, part, begin, share):
    """From all but straight to ends that all but touch, under any couple that is allowed."""
    covered = (begin, min(0.5, begin + share))
    scene = StripScene(1.0, 1 - 10**exponent * 0.99, 0.02, 1e-3, covered=covered)
    found = solve_strip(replace(scene, couple_bottom_N_m=part * scene.largest_couple_N_m))
    assert found.loaded
    shapes = [*found.loaded.values(), *(s.before for s in found.pushed.values())]
    for state in shapes:
        assert np.isfinite(state.points_m).all()
        assert state.points_m[-1] == pytest.approx([scene.constraint_m, 0], abs=1e-9)
        assert state.gradient_norm < 1e-7
    for side, state in found.loaded.items():
        assert state.eigenvalue_J > 0
        assert (found.barrier_J(side) or 0) >= 0
