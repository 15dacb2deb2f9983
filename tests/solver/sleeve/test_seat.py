from dataclasses import replace

import numpy as np
import pytest

from solver.errors import SceneError
from solver.sleeve.pressed import press
from solver.sleeve.seat import Seat

WIRE = 0.3e-3


@pytest.fixture(scope="module")
def pressed(cell):
    return press(cell, 0.0138)


def test_on_a_narrow_thin_beam_the_rows_lie_on_each_other(pressed):
    seat = Seat(0.004, 0.2e-3, 0.27e-3)
    assert seat.valley_m(pressed) == WIRE / 2
    assert seat.crest_m(pressed) == WIRE / 2 + pressed.crest_height_m


def test_a_thick_beam_lifts_the_row_until_it_clears(pressed):
    seat = Seat(0.016, 8e-3, 0.27e-3)
    lift = seat.valley_m(pressed)
    assert lift > WIRE / 2
    # what is lowest over the beam just rests on its face
    grid = np.meshgrid(np.linspace(0, 1, 101), np.linspace(0, np.pi / 2, 401))
    radius, angle = (values.ravel() for values in grid)
    point = pressed.points_m(radius, angle)
    half_thick = np.where(radius == 1, WIRE, seat.fabric_m) / 2
    valley = pressed.points_m(np.ones(1), np.array([np.pi / 2]))[0, 2]
    over = np.abs(point[:, 1]) <= seat.width_m / 2
    lowest = lift + (point[:, 2] - half_thick)[over].min() - valley
    assert lowest == pytest.approx(seat.thickness_m / 2, abs=0.15e-3)
    assert replace(seat, thickness_m=9e-3).valley_m(pressed) == pytest.approx(lift + 0.5e-3)


def test_the_tip_stands_over_the_face(pressed):
    seat = Seat(0.004, 0.2e-3, 0.27e-3)
    crest = seat.crest_m(pressed) + WIRE / 2 - 0.1e-3
    assert seat.tip_m(pressed) == pytest.approx(crest, abs=0.1e-3)
    assert seat.tip_m(pressed) >= crest - 1e-12


def test_a_beam_wider_than_the_loops_is_refused(pressed):
    with pytest.raises(SceneError, match=r"20 mm wide, and at a pitch of 13.8 mm .* 17.4 mm"):
        Seat(0.02, 0.38e-3, 0.27e-3).valley_m(pressed)


@pytest.mark.parametrize("key", ["width_m", "thickness_m", "fabric_m"])
def test_lengths_must_be_positive(key):
    with pytest.raises(SceneError, match=f"{key} = -1: must be greater than 0"):
        Seat(**{"width_m": 1.0, "thickness_m": 1.0, "fabric_m": 1.0, key: -1.0})
