"""Heat of a wire: balance, closed forms in their limits, order of the quadrature."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from solver.actuation.calibration import Measured, calibrated
from solver.actuation.duty import Duty, Interval, follow
from solver.actuation.heating import Heating
from solver.actuation.transformation import Transformation
from solver.actuation.wire import MELTING_C, HeatedWire, Surroundings, WireState, at_rest
from solver.errors import SceneError

LAW = Transformation(60.0, 70.0, 40.0, 30.0)
WIRE = HeatedWire(3e-4, 6450.0, 80e-8, 100e-8, 28e9, 75e9, LAW)
AIR = Surroundings(25.0, 60.0)
COLD = at_rest(WIRE, 25.0)


def stored(course):
    return WIRE.stored_J_m(course.temperature_C, course.fraction)


@pytest.mark.parametrize("ambient", [-50.0, 25.0, 55.0, 300.0])
@pytest.mark.parametrize("current", [0.0, 0.3, 0.6, 0.9])
def test_heat_balance(ambient, current):
    around = Surroundings(ambient, 60.0)
    start = at_rest(WIRE, ambient)
    course = follow(WIRE, around, start, Duty(current, 20.0, 30.0, 3).intervals).course
    gained = stored(course) - WIRE.stored_J_m(start.temperature_C, start.fraction)
    scale = max(1.0, float(course.joule_J_m[-1]))
    assert course.joule_J_m - course.loss_J_m == pytest.approx(gained, abs=1e-6 * scale)


def test_without_transformation_it_is_the_exponential_of_newtons_cooling():
    far = Transformation(900.0, 950.0, 800.0, 750.0)
    wire = replace(WIRE, transformation=far)
    loss = AIR.loss_W_mK(wire)
    tau = wire.mass_kg_m * wire.heat_capacity_J_kgK / loss
    rise = 0.5**2 * float(wire.resistance_ohm_m(0.0)) / loss
    times = np.linspace(0.0, 10 * tau, 50)
    course = Heating(wire, AIR, COLD, 0.5).at(times)
    exact = 25.0 + rise * (1 - np.exp(-times / tau))
    assert course.temperature_C == pytest.approx(exact, abs=1e-7)
    assert course.joule_J_m == pytest.approx(loss * rise * times, rel=1e-9, abs=1e-9)


def test_it_comes_to_rest_where_current_and_loss_are_equal():
    heating = Heating(WIRE, AIR, COLD, 0.9)
    hot = 25.0 + 0.9**2 * float(WIRE.resistance_ohm_m(1.0)) / AIR.loss_W_mK(WIRE)
    assert heating.final_C == pytest.approx(hot, rel=1e-12)
    course = heating.at(np.array([1e6]))
    assert course.temperature_C[0] == pytest.approx(hot, rel=1e-8)
    gained = stored(course)[0] - WIRE.stored_J_m(25.0, 0.0)
    balance = course.joule_J_m[0] - course.loss_J_m[0] - gained
    assert abs(balance) < 1e-8 * course.joule_J_m[0]


def test_it_can_come_to_rest_half_transformed():
    """Where loss and heat are equal between As and Af, the wire stays partly martensite."""
    wire = replace(WIRE, resistivity_hot_ohm_m=WIRE.resistivity_cold_ohm_m)
    current = float(np.sqrt(AIR.loss_W_mK(wire) * 40.0 / wire.resistance_ohm_m(0.0)))
    course = Heating(wire, AIR, COLD, current).at(np.array([1e5]))
    assert course.temperature_C[0] == pytest.approx(65.0, abs=1e-6)
    assert course.fraction[0] == pytest.approx(0.5, abs=1e-6)


def test_of_two_places_to_rest_it_stays_at_the_first():
    """Austenite resists more, so that at one current the wire can rest cold, and hot too."""
    loss = AIR.loss_W_mK(WIRE)
    current = float(np.sqrt(loss * 35.5 / WIRE.resistance_ohm_m(0.0)))
    cold = Heating(WIRE, AIR, COLD, current).final_C
    hot = Heating(WIRE, AIR, WireState(90.0, 1.0), current).final_C
    assert 60.0 < cold < 61.0
    assert hot == pytest.approx(25.0 + 35.5 * 100 / 80)


def test_a_wire_that_keeps_its_heat_has_the_temperature_of_its_energy():
    kept = Surroundings(25.0, 0.0)
    course = Heating(WIRE, kept, COLD, 0.9).at(np.linspace(0.0, 6.0, 30))
    assert course.loss_J_m == pytest.approx(0.0)
    assert stored(course) - WIRE.stored_J_m(25.0, 0.0) == pytest.approx(course.joule_J_m, abs=1e-8)
    assert course.fraction[-1] == 1
    same = replace(WIRE, resistivity_hot_ohm_m=WIRE.resistivity_cold_ohm_m)
    power = 0.9**2 * float(same.resistance_ohm_m(0.0))
    end = Heating(same, kept, COLD, 0.9).at(np.array([6.0])).last.temperature_C
    latent = same.latent_heat_J_kg / same.heat_capacity_J_kgK
    exact = 25.0 + 6 * power / (same.mass_kg_m * same.heat_capacity_J_kgK) - latent
    assert end == pytest.approx(exact, rel=1e-9)


def test_no_current_and_no_difference_changes_nothing():
    for around in (AIR, Surroundings(25.0, 0.0)):
        course = Heating(WIRE, around, COLD, 0.0).at(np.array([0.0, 1.0, 1e6]))
        assert np.all(course.temperature_C == 25.0)
        assert np.all(course.joule_J_m == 0)


@pytest.mark.parametrize(("begin", "current"), [(25.0, 0.8), (150.0, 0.0), (150.0, 0.45)])
def test_against_an_integrator_in_time(begin, current):
    start = WireState(begin, float(LAW.heated(begin)))
    heating = Heating(WIRE, AIR, start, current)

    def rate(_, state):
        there = np.array([state[0]])
        return heating.net_W_m(there) / heating._capacity_J_mK(there)

    times = np.linspace(0.0, 40.0, 9)
    found = solve_ivp(rate, (0, 40.0), [begin], rtol=1e-9, atol=1e-9, max_step=0.05, t_eval=times)
    assert heating.at(times).temperature_C == pytest.approx(found.y[0], abs=2e-5)


def test_three_gauss_points_converge_with_order_six():
    times = np.array([2.5, 2.8, 4.0])
    exact = Heating(WIRE, AIR, COLD, 0.8, panel=0.01).at(times).temperature_C
    errors = [
        np.abs(Heating(WIRE, AIR, COLD, 0.8, panel=panel).at(times).temperature_C - exact).max()
        for panel in (0.15, 0.075, 0.0375)
    ]
    orders = [np.log2(coarse / fine) for coarse, fine in pairwise(errors)]
    assert orders[-1] == pytest.approx(6.0, abs=0.4)


def test_times_in_any_order_and_at_the_switches():
    heating = Heating(WIRE, AIR, COLD, 0.9)
    times = np.array([3.0, 0.0, 1.0])
    assert heating.at(times).temperature_C[[1, 2, 0]] == pytest.approx(
        heating.at(np.sort(times)).temperature_C
    )
    history = follow(WIRE, AIR, COLD, (Interval(0.9, 3.0), Interval(0.0, 2.0)), samples=11)
    course = history.course
    assert (
        course.temperature_C[10] == course.temperature_C[11] == heating.at(times).temperature_C[0]
    )
    assert course.fraction[10] == pytest.approx(course.fraction[11])
    assert np.all(np.diff(course.time_s) >= 0)
    assert (history.current_A[10], history.current_A[11]) == (0.9, 0.0)


def test_cycles_settle_into_one_that_repeats():
    course = follow(WIRE, AIR, COLD, Duty(0.9, 8.0, 25.0, 12).intervals, samples=5).course
    once, again = course.temperature_C[-20:-10], course.temperature_C[-10:]
    assert again == pytest.approx(once, abs=1e-6)


def test_too_much_current_is_refused_with_the_time():
    with pytest.raises(SceneError, match=r"current_A = 100: the wire would melt.* after 0\.00"):
        follow(WIRE, AIR, COLD, Duty(100.0, 1.0, 1.0).intervals)
    short = Heating(WIRE, AIR, COLD, 100.0).at(np.array([1e-3]))
    assert 25 < short.last.temperature_C < MELTING_C


def test_calibration_finds_the_convection_that_made_the_measurement():
    reached = Heating(WIRE, AIR, COLD, 0.6).at(np.array([12.0])).last.temperature_C
    found = calibrated(WIRE, 25.0, Measured(0.6, 12.0, reached))
    assert found.convection_W_m2K == pytest.approx(60.0, rel=1e-6)


def test_measurements_that_no_convection_explains_are_refused():
    with pytest.raises(SceneError, match="even if it keeps all its heat"):
        calibrated(WIRE, 25.0, Measured(0.6, 1.0, 200.0))
    with pytest.raises(SceneError, match="ambient_C"):
        calibrated(WIRE, 25.0, Measured(0.6, 1.0, 20.0))


@pytest.mark.parametrize(
    ("make", "key"),
    [
        (lambda: Duty(-1.0, 1.0, 1.0), "current_A"),
        (lambda: Duty(float("nan"), 1.0, 1.0), "current_A"),
        (lambda: Duty(1.0, 0.0, 1.0), "heating_s"),
        (lambda: Duty(1.0, 1.0, -1.0), "cooling_s"),
        (lambda: Duty(1.0, 1.0, 1.0, 0), "cycles"),
        (lambda: Surroundings(25.0, -1.0), "convection_W_m2K"),
        (lambda: Surroundings(2000.0, 1.0), "ambient_C"),
        (lambda: replace(WIRE, diameter_m=0.0), "diameter_m"),
        (lambda: replace(WIRE, latent_heat_J_kg=-1.0), "latent_heat_J_kg"),
        (lambda: Heating(WIRE, AIR, COLD, float("inf")), "current_A"),
        (lambda: Measured(0.0, 1.0, 50.0), "current_A"),
        (lambda: Measured(1.0, 1.0, 1e4), "temperature_C"),
    ],
)
def test_numbers_out_of_range_are_refused(make, key):
    with pytest.raises(SceneError, match=key):
        make()
