from dataclasses import replace

import numpy as np
import pytest

from solver.strip.ends import Ends, buckling_loads
from solver.strip.landscape import energy_landscape
from solver.strip.scene import StripScene
from solver.strip.snap import solve_strip
from solver.strip.state import Side

SCENE = StripScene(0.12, 0.115, 0.02, 0.38e-3)


@pytest.mark.parametrize("ends", list(Ends))
def test_the_nearly_straight_strip_goes_round_a_circle(ends):
    scene = StripScene(1.0, 1 - 1e-6, 0.02, 1e-3, ends=ends)
    found = energy_landscape(scene, 17)
    first, second = buckling_loads(ends)
    phi = found.phase_rad
    law = scene.shortening * (first * np.cos(phi) ** 2 + second * np.sin(phi) ** 2)
    assert found.energy_J / scene.energy_unit_J == pytest.approx(law, rel=1e-5)


@pytest.mark.parametrize("couple", [0.0, 1.5e-3, 4e-3])
@pytest.mark.parametrize("ends", list(Ends))
def test_slopes_against_differences(couple, ends):
    scene = replace(SCENE, couple_bottom_N_m=couple, ends=ends)
    found = energy_landscape(scene, 91)
    step = found.phase_rad[1]
    numeric = np.gradient(found.energy_J, step)[2:-2]
    scale = np.abs(found.slope_J).max()
    assert found.slope_J[2:-2] == pytest.approx(numeric, abs=6e-3 * scale)


@pytest.mark.parametrize(("constraint", "samples"), [(0.002, 25), (0.0013, 73)])
def test_the_way_is_closed(constraint, samples):
    """Where the ends nearly touch, shapes whose ends have crossed are not far."""
    found = energy_landscape(replace(SCENE, constraint_m=constraint), samples)
    assert found.energy_J[-1] == pytest.approx(found.energy_J[0], rel=1e-9)
    assert found.height_m[-1] == pytest.approx(found.height_m[0], rel=1e-9)


def test_its_lowest_and_highest_places_are_states_and_saddles():
    scene = replace(SCENE, couple_bottom_N_m=1.5e-3)
    solved, found = solve_strip(scene), energy_landscape(scene, 181)
    inner = found.energy_J[1:-1]
    low = np.flatnonzero((inner < found.energy_J[:-2]) & (inner < found.energy_J[2:]))
    high = np.flatnonzero((inner > found.energy_J[:-2]) & (inner > found.energy_J[2:]))
    states = sorted(solved.loaded[side].energy_J for side in (Side.UP, Side.DOWN))
    assert sorted(inner[low]) == pytest.approx(states, rel=1e-3)
    assert inner[high].min() == pytest.approx(solved.saddle.energy_J, rel=1e-3)
    assert len(high) == 2


def test_beyond_the_critical_couple_one_valley_is_left():
    critical = solve_strip(SCENE).pushed[Side.UP].critical_couple_N_m
    for factor, valleys in ((0.95, 2), (1.05, 1)):
        found = energy_landscape(replace(SCENE, couple_bottom_N_m=factor * critical), 73)
        upward = (found.slope_J[:-1] < 0) & (found.slope_J[1:] > 0)
        assert np.count_nonzero(upward) == valleys
