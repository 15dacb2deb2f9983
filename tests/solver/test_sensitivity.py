from dataclasses import replace

import numpy as np
import pytest

from solver.compact import solve_loop
from solver.errors import SceneError
from solver.held import Pitch, solve_at_pitch
from solver.reading import Reading, density_coefficients, density_slopes
from solver.scene import LoopScene
from solver.sensitivity import PARAMETERS, sensitivities
from solver.sensitivity_held import PITCH, force_sensitivities

SCENES = [
    LoopScene(0.3, 0.0145, 0.45),
    LoopScene(0.1, 0.005, 0.3, axial_stiffness=300),
    LoopScene(0.3, 0.06, 0.446, Reading.PUBLISHED),
    LoopScene(0.2, 0.2, 0.3, axial_stiffness=50),
]


def _height_and_width(scene, degree):
    found = solve_loop(scene, tolerance=1e-9, highest_degree=degree, allow_unreliable=True)
    assert found.degree == degree
    return np.array([found.shape.height if found.buckled else 0.0, found.shape.width])


@pytest.mark.parametrize("scene", SCENES, ids=str)
@pytest.mark.parametrize("key", PARAMETERS)
def test_as_differences(scene, key):
    degree = 5 if scene.beta == 0.2 else 9
    found = solve_loop(scene, tolerance=1e-9, highest_degree=degree, allow_unreliable=True)
    told = sensitivities(found)
    step = 1e-4 * abs(getattr(scene, key))
    ends = [
        _height_and_width(replace(scene, **{key: getattr(scene, key) + s * step}), degree)
        for s in (1, -1)
    ]
    rise, wide = (ends[0] - ends[1]) / (2 * step)
    assert told.height[key] == pytest.approx(rise, rel=1e-4, abs=1e-9)
    assert told.width[key] == pytest.approx(wide, rel=1e-4, abs=1e-9)


def test_a_loop_rises_with_prestrain_and_sinks_with_stiffer_wire():
    told = sensitivities(solve_loop(LoopScene(0.3, 0.0145, 0.45)))
    assert told.height["strain"] > 0 > told.height["beta"]
    assert told.width["strain"] < 0 < told.width["beta"]


def test_near_the_threshold_the_height_sets_in_as_a_square_root():
    """With H ∝ √(T − 12 β), dH/dβ (β_c − β) = −H/2."""
    critical = 0.5 * 0.69 / (6 * 0.7)  # e/(1 − ν)/12 of ε = 0.3, ν = 0.3
    scene = LoopScene(0.3, critical * 0.999, 0.3, axial_stiffness=1e7)
    found = solve_loop(scene, tolerance=1e-6)
    told = sensitivities(found)
    expected = -found.shape.height / 2
    assert told.height["beta"] * critical * 1e-3 == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize("reading", list(Reading))
def test_slopes_of_the_density(reading):
    ends = [np.array(density_coefficients(0.3 + s, reading)) for s in (1e-6, -1e-6)]
    assert density_slopes(0.3, reading) == pytest.approx((ends[0] - ends[1]) / 2e-6, rel=1e-8)


def test_other_loops_are_refused():
    found = solve_loop(LoopScene(0.3, 0.02, 0.3, axis_ratio=1.3), allow_unreliable=True)
    with pytest.raises(SceneError, match="axis_ratio"):
        sensitivities(found)


HELD = LoopScene(0.3, 0.03896, 0.45, axial_stiffness=3116)


@pytest.mark.parametrize("key", [*PARAMETERS, PITCH])
def test_force_as_differences(key):
    found = solve_at_pitch(HELD, Pitch(1.357))
    told = force_sensitivities(found)
    forces = []
    for s in (1, -1):
        if key == PITCH:
            other = solve_at_pitch(HELD, Pitch(1.357 + s * 1e-4))
            step = 1e-4
        else:
            step = 1e-4 * getattr(HELD, key)
            scene = replace(HELD, **{key: getattr(HELD, key) + s * step})
            other = solve_at_pitch(scene, Pitch(1.357))
        assert other.degree == found.degree
        forces.append(other.force)
    assert told[key] == pytest.approx((forces[0] - forces[1]) / (2 * step), rel=1e-4)
    if key == PITCH:
        assert told[key] < 0


def test_only_loops_at_a_pitch_have_such_a_force():
    found = solve_at_pitch(HELD, Pitch(1.5, width=1.4), allow_unreliable=True)
    with pytest.raises(SceneError, match="held at a pitch alone"):
        force_sensitivities(found)
