from dataclasses import replace

import numpy as np
import pytest

from solver.errors import SceneError
from solver.strip.ends import Ends, buckling_loads
from solver.strip.landscape import energy_landscape, energy_to_minus
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


@pytest.mark.parametrize("stiffening", [0.0, 2.0])
def test_the_way_to_minus_is_half_of_the_way_round(stiffening):
    scene = replace(
        SCENE,
        couple_bottom_N_m=5e-4,
        sleeve_stiffness_N_m2=stiffening * SCENE.stiffness_N_m2,
    )
    whole, half = energy_landscape(scene, samples=25), energy_to_minus(scene, samples=13)
    assert half.phase_rad == pytest.approx(np.linspace(0, np.pi, 13))
    assert half.energy_J == pytest.approx(whole.energy_J[:11:-1], rel=1e-7)
    assert half.slope_J == pytest.approx(-whole.slope_J[:11:-1], abs=1e-9)
    assert half.height_m == pytest.approx(whole.height_m[:11:-1], abs=1e-7)


def test_the_way_to_minus_is_downhill_beyond_the_critical_couple():
    stiff = replace(SCENE, sleeve_stiffness_N_m2=2 * SCENE.stiffness_N_m2)
    critical = solve_strip(stiff).pushed[Side.UP].critical_couple_N_m
    found = energy_to_minus(replace(stiff, couple_bottom_N_m=1.2 * critical), samples=25)
    down = np.flatnonzero(found.slope_J < 0)
    assert down[0] == 0
    assert np.all(np.diff(down) == 1)
    assert found.height_m[down[-1]] < 0


def test_states_of_a_stiffened_strip_lie_at_their_phases():
    nearly = replace(SCENE, constraint_m=SCENE.length_m * (1 - 1e-6))
    found = energy_to_minus(replace(nearly, sleeve_stiffness_N_m2=3 * SCENE.stiffness_N_m2), 5)
    assert found.slope_J[[0, 2, 4]] == pytest.approx(0, abs=1e-4 * np.ptp(found.energy_J))


def test_a_couple_the_other_way_is_refused():
    with pytest.raises(SceneError, match="must be at least 0 for the way from state"):
        energy_to_minus(replace(SCENE, couple_top_N_m=1e-4))
