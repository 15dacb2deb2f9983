import pytest

from solver.sleeve.couple import couple_on_curve, sleeve_couple
from solver.sleeve.pressed import press
from solver.sleeve.seat import Seat

SEAT = Seat(0.01, 0.38e-3, 0.27e-3)
PITCH = 0.0138


@pytest.fixture(scope="module", params=[28e9, 75e9], ids=["cold", "hot"])
def flat(request, cell):
    return sleeve_couple(cell.with_wire_modulus(request.param), SEAT, PITCH)


def _energy_per_length(flat, curvature):
    """U(p')/p with p' = p (1 + κ o(p'))."""
    pitch, pressed = PITCH, flat.pressed
    for _ in range(4):
        pitch = PITCH * (1 + curvature * SEAT.crest_m(pressed))
        pressed = press(flat.pressed.cell, pitch, start=flat.pressed)
    return pressed.energy_J / PITCH


def test_couple_is_force_times_arm(flat):
    assert flat.arm_m == SEAT.crest_m(flat.pressed)
    assert flat.couple_N_m == flat.force_N * flat.arm_m
    assert couple_on_curve(flat, SEAT, 0.0) == pytest.approx(flat.couple_N_m, rel=1e-12)


@pytest.mark.parametrize("curvature", [0.0, -8.0, 6.0])
def test_the_couple_is_what_the_energy_falls_by(flat, curvature):
    step = 1.0
    ends = [_energy_per_length(flat, curvature + side * step) for side in (-1, 1)]
    fall = (ends[0] - ends[1]) / (2 * step)
    assert couple_on_curve(flat, SEAT, curvature) == pytest.approx(fall, rel=5e-3)


def test_the_stiffness_is_what_the_couple_falls_by(flat):
    step = 2.0
    ends = [couple_on_curve(flat, SEAT, side * step) for side in (-1, 1)]
    fall = (ends[0] - ends[1]) / (2 * step)
    assert flat.bending_stiffness_N_m2 == pytest.approx(fall, rel=0.02)


def test_a_sleeve_lengthened_past_its_free_pitch_has_no_couple(cell):
    assert couple_on_curve(sleeve_couple(cell, SEAT, 0.0165), SEAT, 8.0) == 0
