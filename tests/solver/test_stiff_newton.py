"""First guesses, and the steps from them that do not mind how stiff the wire is."""

import numpy as np
import pytest

from solver.disc_basis import disc_basis
from solver.first_guess import GUESS_DEGREE, saddle_family, scene_weights
from solver.loop_energy import loop_energy
from solver.newton import minimise
from solver.reading import Reading
from solver.saddle_rows import crest_distance, crest_less_valley
from solver.scene import LoopScene
from solver.shape import LoopShape
from solver.stiff_newton import stiff_minimum, tension_of

BASIS = disc_basis(GUESS_DEGREE, "saddle")
NONE = np.zeros(len(BASIS.arc))


def test_the_family_rises_from_the_flat_disc():
    family = saddle_family()
    assert family.heights[0] == 0
    assert np.all(np.diff(family.heights) > 0)


@pytest.mark.parametrize(
    ("strain", "beta", "poisson", "reading"),
    [
        (0.3, 0.0145, 0.3, Reading.PLANE_STRESS),
        (0.1, 0.005, 0.0, Reading.PLANE_STRESS),
        (0.3, 0.04, 0.3, Reading.PLANE_STRESS),
        (0.3, 0.0409, 0.3, Reading.PLANE_STRESS),
        (0.5, 0.06, 0.45, Reading.PUBLISHED),
    ],
)
def test_the_first_guess_is_near(strain, beta, poisson, reading):
    scene = LoopScene(strain, beta, poisson, reading, axial_stiffness=1e6)
    guess = saddle_family().nearest(scene_weights(scene))
    found = stiff_minimum(loop_energy(scene, BASIS), guess, NONE)
    assert found is not None
    heights = [q @ crest_less_valley(BASIS) for q in (guess, found.unknowns)]
    assert heights[0] == pytest.approx(heights[1], rel=0.02)


def test_many_first_guesses_are_those_of_each():
    scenes = [LoopScene(0.3, beta, 0.3) for beta in (0.04, 0.02, 0.01)]
    weights = np.stack([scene_weights(scene) for scene in scenes])
    together = saddle_family().nearest(weights)
    for i in range(3):
        assert together[i] == pytest.approx(saddle_family().nearest(weights[i]))


def test_steps_do_not_depend_on_the_wires_stiffness():
    steps = []
    for stiffness in (1e3, 1e5, 1e7):
        scene = LoopScene(0.3, 0.0145, 0.3, axial_stiffness=stiffness)
        guess = saddle_family().nearest(scene_weights(scene))
        found = stiff_minimum(loop_energy(scene, BASIS), guess, NONE)
        assert found is not None
        steps.append(found.steps)
    assert max(steps) <= 8


def test_the_same_minimum_as_with_steps_of_the_energy():
    energy = loop_energy(LoopScene(0.3, 0.0145, 0.3), BASIS)
    guess = saddle_family().coefficients[12]
    one = stiff_minimum(energy, guess, NONE)
    other = minimise(energy.derivatives, guess, tolerance=1e-9, radius=0.1)
    assert one is not None
    assert one.gradient_norm < 1e-8
    assert one.unknowns == pytest.approx(other.unknowns, abs=1e-9)
    assert np.abs(tension_of(energy, one.unknowns)).max() < 1


def test_a_stationary_point_that_is_no_minimum_is_not_given():
    scene = LoopScene(0.3, 0.0145, 0.3)
    assert stiff_minimum(loop_energy(scene, BASIS), saddle_family().coefficients[0], NONE) is None


def test_rows_of_the_saddle():
    q = saddle_family().coefficients[12]
    shape = LoopShape(BASIS.unknowns, q)
    assert q @ crest_less_valley(BASIS) == pytest.approx(shape.height)
    assert 2 * q @ crest_distance(BASIS) == pytest.approx(shape.width)
