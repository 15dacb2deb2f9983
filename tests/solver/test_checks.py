import numpy as np
import pytest

from solver.checks import (
    CONTACT,
    EDGE_POINTS,
    smallest_bend_radius,
    smallest_fabric_gap,
    smallest_stress,
    smallest_wire_gap,
    writhe,
)
from solver.compact import solve_loop
from solver.disc_functions import DiscFunction
from solver.flat import flat_shape
from solver.scene import LoopScene
from solver.shape import LoopShape, from_expansion
from solver.symmetry import HALF_TURN, displacements, saddle


def test_writhe_of_a_saddle_is_zero():
    edge = solve_loop(LoopScene(0.3, 0.0145, 0.3)).shape.edge(64)
    assert writhe(edge) == pytest.approx(0, abs=1e-6)


def test_writhe_of_a_trefoil():
    """The standard torus trefoil; its writhe is 3.4 or so, and changes sign in the mirror."""
    t = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    knot = np.stack(
        [np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)], axis=1
    )
    value = writhe(knot)
    assert 3.0 < abs(value) < 3.8
    assert writhe(knot * [1, 1, -1]) == pytest.approx(-value)
    assert writhe(0.1 * knot + 5) == pytest.approx(value)


def test_flat_stress_is_the_line_tension():
    scene = LoopScene(0.3, 0.05, 0.3, axial_stiffness=1e9)
    assert smallest_stress(scene, flat_shape(scene, 5), 5) == pytest.approx(
        ((1.3**2 - 1) / 2) / 0.7, rel=1e-6
    )


def test_bend_radius_of_the_flat_loop():
    scene = LoopScene(0.3, 0.05, 0.3, axial_stiffness=1e9)
    assert smallest_bend_radius(flat_shape(scene, 5), 5) == pytest.approx(1, rel=1e-6)


def test_wire_gap_of_the_flat_loop_is_its_diameter_seen_from_a_quarter_turn():
    scene = LoopScene(0.3, 0.05, 0.3, axial_stiffness=1e9)
    assert smallest_wire_gap(flat_shape(scene, 5)) == pytest.approx(2**0.5, rel=1e-6)


@pytest.mark.parametrize("waist", [0.0, -0.15])
def test_wire_gap_is_the_smallest_distance_of_points_across(waist):
    """The half-turn about z is the only symmetry of these shapes; a waist is narrowest across."""
    unknowns = displacements(5, HALF_TURN)
    disc = {(0, DiscFunction(1, 0, "cos")): 0.5, (1, DiscFunction(1, 0, "sin")): 0.4}
    disc[1, DiscFunction(3, 0, "sin")] = -waist
    noise = 0.02 * np.random.default_rng(3).normal(size=len(unknowns))
    shape = LoopShape(unknowns, from_expansion(unknowns, disc) + noise)
    edge, n = shape.edge(EDGE_POINTS), EDGE_POINTS
    apart = [
        np.linalg.norm(edge[i] - edge[(i + ahead) % n])
        for i in range(n)
        for ahead in range(n // 4, n // 2 + 1)
    ]
    assert smallest_wire_gap(shape) == pytest.approx(min(apart), rel=1e-12)


def test_crossed_crests_are_seen():
    unknowns = saddle(5)
    inside_out = {(0, DiscFunction(1, 0, "cos")): -0.1, (1, DiscFunction(1, 0, "sin")): -0.1}
    shape = LoopShape(unknowns, from_expansion(unknowns, inside_out))
    assert smallest_wire_gap(shape) < 0


def test_wire_and_fabric_of_a_flat_loop_are_as_far_apart_as_is_looked():
    scene = LoopScene(0.3, 0.05, 0.3, axial_stiffness=1e9)
    assert smallest_fabric_gap(scene, flat_shape(scene, 5)) == pytest.approx(0.3, abs=0.06)


def test_distances_are_compared_with_the_wires_diameter():
    """At ε = 1, where the crests are near, a wire of less axial stiffness is a thicker one."""
    thin, thick = (
        solve_loop(LoopScene(1.0, 0.0145, 0.3, axial_stiffness=k), allow_unreliable=True)
        for k in (1000.0, 20.0)
    )
    values = [
        next(left for left in found.omitted if left.term == CONTACT) for found in (thin, thick)
    ]
    assert not values[0].fatal
    assert values[1].value > 4 * values[0].value
