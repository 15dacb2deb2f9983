from dataclasses import replace

import numpy as np
import pytest

from solver.errors import SceneError
from solver.sleeve.omissions import tie_rise_share
from solver.sleeve.scene import BeamSegment
from solver.sleeve.segment import predict_segment
from solver.strip.scene import StripScene
from solver.strip.snap import solve_strip
from solver.strip.state import Side

STRIP = StripScene(0.12, 0.115, 0.01, 0.38e-3, covered=(0.025, 0.48))


@pytest.fixture(scope="module")
def segment(cell):
    return BeamSegment(STRIP, cell, 4, 75e9, 0.27e-3, 0.01, 0.38e-3, 1e-3)


@pytest.fixture(scope="module")
def prediction(segment):
    return predict_segment(segment)


def _size(prediction, beginning):
    found = [term for term in prediction.omitted if term.term.startswith(beginning)]
    assert len(found) == 1
    return found[0].value


def test_sleeves_share_the_covered_length(segment):
    assert segment.pitch_m == pytest.approx(0.12 * 0.455 / 4)


def test_cold_sleeves_cancel(prediction):
    rest = prediction.rest
    assert rest.scene.couple_N_m == 0
    heights = [rest.unloaded[side].height_m for side in (Side.UP, Side.DOWN)]
    assert heights[0] == pytest.approx(-heights[1], rel=1e-9)
    assert rest.barrier_J(Side.UP) == pytest.approx(rest.barrier_J(Side.DOWN), rel=1e-9)
    assert prediction.barrier_J == rest.barrier_J(Side.UP) > 0


def test_the_couple_is_the_difference_of_both_sleeves(prediction):
    hot, cold = prediction.hot, prediction.cold
    assert prediction.couple_N_m == hot.couple_N_m - cold.couple_N_m > 0
    added = hot.bending_stiffness_N_m2 + cold.bending_stiffness_N_m2
    assert prediction.heated.scene.sleeve_stiffness_N_m2 == added


def test_a_margin_above_one_snaps(prediction):
    assert prediction.snaps
    assert prediction.margin == pytest.approx(
        prediction.couple_N_m / prediction.critical_couple_N_m, rel=1e-12
    )
    assert prediction.margin > 1
    assert prediction.released_J == prediction.heated.pushed[Side.UP].released_J > 0


def test_half_of_the_couple_would_not_do(prediction):
    """Just below and above the critical couple, solved anew."""
    scene = prediction.heated.scene
    for factor, snaps in ((0.999, False), (1.001, True)):
        couple = factor * prediction.critical_couple_N_m
        found = solve_strip(replace(scene, couple_bottom_N_m=couple, couple_top_N_m=0.0))
        assert found.snaps(Side.UP) is snaps


def test_ends_of_the_sleeves_count_less_with_more_loops(segment, prediction, cell):
    """A quarter of a pitch less at both ends, seen by the critical couple itself."""
    begin, end = STRIP.covered
    less = (end - begin) / 16
    scene = replace(
        prediction.heated.scene,
        couple_bottom_N_m=0.0,
        couple_top_N_m=0.0,
        covered=(begin + less, end - less),
    )
    shorter = solve_strip(scene).pushed[Side.UP].critical_couple_N_m
    change = abs(shorter / prediction.critical_couple_N_m - 1)
    assert _size(prediction, "the couple builds up") == pytest.approx(change, rel=1e-9)


def test_the_constraints_own_bending(prediction, segment):
    """Small slopes: a tie bar with the beam's slopes at its ends, by finite elements."""
    state = prediction.rest.unloaded[Side.UP]
    stiffness, count = STRIP.stiffness_N_m2, 400
    step = STRIP.constraint_m / count
    # Hermite cubics; bending and pull of one element
    bend = np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]]) / step**3
    pull = np.array([[36, 3, -36, 3], [3, 4, -3, -1], [-36, -3, 36, -3], [3, -1, -3, 4]])
    scale = np.array([1, step, 1, step])
    element = (stiffness * bend + state.force_N / (30 * step) * pull) * np.outer(scale, scale)
    whole = np.zeros((2 * count + 2, 2 * count + 2))
    for k in range(count):
        whole[2 * k : 2 * k + 4, 2 * k : 2 * k + 4] += element
    held = [0, 1, 2 * count, 2 * count + 1]
    free = [k for k in range(2 * count + 2) if k not in held]
    ends = np.array([0, state.headings_rad[0], 0, state.headings_rad[-1]])
    inner = np.linalg.solve(whole[np.ix_(free, free)], -whole[np.ix_(free, held)] @ ends)
    energy = ends @ (whole[np.ix_(held, held)] @ ends + whole[np.ix_(held, free)] @ inner) / 2
    value = _size(prediction, "bending of the constraint")
    assert value == pytest.approx(energy / state.bending_J, rel=1e-5)


def test_couples_fall_evenly_with_the_curvature(prediction):
    assert 0 < _size(prediction, "couples that do not fall evenly") < 0.02


def test_the_beams_own_omissions_are_told_too(prediction):
    terms = [term.term for term in prediction.omitted]
    assert "twist and bending sideways" in terms
    assert "bending across the width" in terms
    assert len(set(terms)) == len(terms)
    rest = prediction.rest.unloaded[Side.UP]
    work = 1e-3 * 9.80665 * np.abs(rest.points_m[:, 1]).max()
    assert _size(prediction, "weight of the sleeves") == pytest.approx(work / rest.bending_J)


def test_ties_beside_the_valleys(prediction, segment, cell):
    """Ties in the valleys themselves hold nothing else down."""
    assert _size(prediction, "ties beside the valleys") == 0
    slanted = replace(segment, tie_angle_rad=np.deg2rad(20))
    cold, hot = prediction.cold, prediction.hot
    share = tie_rise_share(slanted, cold, hot)
    # of a pure saddle the wire rises by h sin² of the angle
    assert share == pytest.approx(np.sin(np.deg2rad(20)) ** 2, rel=0.25)


def test_a_sleeve_that_is_not_compressed_is_refused(segment):
    with pytest.raises(SceneError, match=r"not compressed: 3 loops on 54.6 mm .* take more loops"):
        predict_segment(replace(segment, loops=3))


def test_a_sleeve_without_loops_is_refused(segment):
    with pytest.raises(SceneError, match="loops = 0: must be 1 or more"):
        replace(segment, loops=0)
