"""Natural convection about thin wires."""

import numpy as np
import pytest

from patterns.electrics import ONE_SECOND_A
from solver.actuation.convection import _sutherland, natural_convection_W_m2K
from solver.actuation.heating import Heating
from solver.actuation.transformation import Transformation
from solver.actuation.wire import HeatedWire, Surroundings, at_rest
from solver.errors import SceneError


def test_air_at_300_k_is_that_of_tables():
    """Kinematic viscosity 15.89e-6 m²/s and 0.0263 W/mK: Incropera and DeWitt, table A.4."""
    density = 101325 / (287.05 * 300)
    assert _sutherland(1.716e-5, 110.6, 300.0) / density == pytest.approx(15.89e-6, rel=0.02)
    assert _sutherland(0.0241, 194.0, 300.0) == pytest.approx(0.0263, rel=0.01)


def test_without_buoyancy_only_the_correlations_constant_is_left():
    thin = 1e-7
    conductivity = _sutherland(0.0241, 194.0, 313.15)
    found = natural_convection_W_m2K(thin, 50.0, 30.0)
    assert found == pytest.approx(0.36 * conductivity / thin, rel=0.02)


def test_thinner_and_hotter_wires_are_cooled_better():
    by_diameter = [natural_convection_W_m2K(d * 1e-3, 80.0, 25.0) for d in (0.5, 0.3, 0.1)]
    by_heat = [natural_convection_W_m2K(5e-4, t, 25.0) for t in (30.0, 60.0, 120.0)]
    assert np.all(np.diff(by_diameter) > 0)
    assert np.all(np.diff(by_heat) > 0)


@pytest.mark.parametrize(("diameter_mm", "current"), ONE_SECOND_A)
def test_one_second_currents_of_makers_tables_reach_the_transformation(diameter_mm, current):
    """Actuator wire of 70 °C, from 20 °C: nothing here is fitted to these currents."""
    law = Transformation(70.0, 80.0, 50.0, 40.0)
    diameter = diameter_mm * 1e-3
    wire = HeatedWire(diameter, 6450.0, 80e-8, 100e-8, 28e9, 75e9, law)
    around = Surroundings(20.0, natural_convection_W_m2K(diameter, 75.0, 20.0))
    reached = Heating(wire, around, at_rest(wire, 20.0), current).at(np.array([1.0])).last
    assert 70.0 < reached.temperature_C < 76.0


@pytest.mark.parametrize(("diameter", "temperature"), [(0.0, 50.0), (1e-3, -300.0)])
def test_impossible_input_is_refused(diameter, temperature):
    with pytest.raises(SceneError):
        natural_convection_W_m2K(diameter, temperature, 25.0)


@pytest.mark.parametrize(("diameter", "by_hand"), [(5e-4, 47.7), (1e-2, 10.87)])
def test_worked_by_hand_with_tabulated_air(diameter, by_hand):
    """127 °C in 27 °C; air at 350 K of Incropera and DeWitt's table A.4: 20.92e-6 m²/s,
    29.9e-6 m²/s, 0.0300 W/mK. Ra = 0.560 and 4480, Nu = 0.7945 and 3.622."""
    found = natural_convection_W_m2K(diameter, 127.0, 27.0)
    assert found == pytest.approx(by_hand, rel=0.02)


def test_loss_of_a_metre():
    law = Transformation(70.0, 80.0, 50.0, 40.0)
    wire = HeatedWire(3e-4, 6450.0, 80e-8, 100e-8, 28e9, 75e9, law)
    assert Surroundings(25.0, 60.0).loss_W_mK(wire) == pytest.approx(0.0565487, rel=1e-5)
