from dataclasses import replace
from itertools import pairwise

import pytest

from solver.errors import SceneError
from solver.sleeve.cell import SleeveCell
from solver.sleeve.pressed import free_pitch_m, press, press_along

HOT = 75e9


@pytest.mark.parametrize("modulus", [28e9, HOT])
def test_at_its_free_pitch_a_sleeve_does_not_push(cell, modulus):
    cell = cell.with_wire_modulus(modulus)
    free = free_pitch_m(cell)
    pressed = press(cell, free)
    assert abs(pressed.force_N) < 1e-4 * cell.materials.force_unit_N
    # the free saddle is as wide as it is long
    assert pressed.valley_distance_m == pytest.approx(free, rel=1e-3)


@pytest.mark.parametrize("stripe_m", [0.025, 0.0165])
def test_the_force_is_what_the_energy_falls_by(cell, stripe_m):
    cell = replace(cell, stripe_m=stripe_m)
    step = 2e-4
    below, here, above = press_along(cell, [0.0138 - step, 0.0138, 0.0138 + step], tolerance=3e-4)
    fall = (below.energy_J - above.energy_J) / (2 * step)
    assert here.force_N == pytest.approx(fall, rel=2e-3)


def test_force_and_height_grow_as_the_sleeve_is_pressed(cell):
    curve = list(press_along(cell, [0.017, 0.015, 0.013, 0.011]))
    for one, next_ in pairwise(curve):
        assert next_.force_N > one.force_N
        assert next_.crest_height_m > one.crest_height_m


def test_a_hot_sleeve_pushes_harder(cell):
    cold = press(cell, 0.0138)
    hot = press(cell.with_wire_modulus(HOT), 0.0138)
    assert hot.force_N > 3 * cold.force_N


def test_sizes_scale(cell):
    """At equal β forces are as the square of the size, with fabric and wire as thick in scale."""
    m = cell.materials
    big = replace(
        m,
        fabric_thickness_m=3 * m.fabric_thickness_m,
        wire_diameter_m=3 * m.wire_diameter_m,
        loop_radius_m=3 * m.loop_radius_m,
    )
    one = press(cell, 0.0138)
    other = press(replace(cell, materials=big, stripe_m=0.075), 3 * 0.0138)
    assert other.force_N == pytest.approx(9 * one.force_N, rel=1e-9)
    assert other.energy_J == pytest.approx(27 * one.energy_J, rel=1e-9)
    assert other.crest_height_m == pytest.approx(3 * one.crest_height_m, rel=1e-9)


def test_a_tighter_tolerance_changes_no_more_than_was_allowed(cell):
    rough, fine = (press(cell, 0.0138, tolerance=t) for t in (1e-3, 2e-4))
    assert rough.force_N == pytest.approx(fine.force_N, rel=1e-3)


def test_a_long_stripe_hangs_slack(cell):
    loose = press(cell, 0.0138)
    without = press(replace(cell, stripe_m=None), 0.0138)
    assert not loose.stripe_taut
    assert loose.stripe_tension_N == 0
    assert loose.force_N == without.force_N


def test_a_short_stripe_is_taut_and_stiffens_the_sleeve(cell):
    loose = press(cell, 0.0138)
    taut = press(replace(cell, stripe_m=0.0165), 0.0138)
    assert taut.stripe_taut
    assert taut.valley_distance_m == pytest.approx(0.0165, rel=1e-9)
    assert taut.stripe_tension_N > 0
    assert taut.energy_J > loose.energy_J


def test_a_stripe_just_too_long_to_be_taut_pulls_next_to_nothing(cell):
    width = press(cell, 0.0138).valley_distance_m
    barely = press(replace(cell, stripe_m=0.9999 * width), 0.0138)
    assert barely.stripe_taut
    assert 0 < barely.stripe_tension_N < 1e-3 * barely.force_N


def test_the_fabrics_line_is_longer_than_its_chord(cell):
    pressed = press(cell, 0.0138)
    assert pressed.valley_distance_m < pressed.stripe_path_m < 0.025


@pytest.mark.parametrize("pitch_m", [0.001, 0.04, float("nan")])
def test_pitches_out_of_range_are_refused(cell, pitch_m):
    with pytest.raises(SceneError, match=r"pitch_m = .*must be at least 0.005 and less than"):
        press(cell, pitch_m)


@pytest.mark.parametrize("stripe_m", [0.0, 0.04, float("nan")])
def test_stripes_out_of_range_are_refused(cell, stripe_m):
    with pytest.raises(SceneError, match=r"stripe_m = .*must be greater than 0 and less than"):
        SleeveCell(cell.materials, 0.3, 0.45, stripe_m=stripe_m)
