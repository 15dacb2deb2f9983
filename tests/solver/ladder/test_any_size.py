"""Loops in SI units: of any size, of any materials; only their ratios count."""

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solver.errors import NotConvergedError
from solver.ladder.choose import solve_scene
from solver.ladder.fidelity import Fidelity
from solver.materials import LoopMaterials
from solver.reading import Reading
from solver.scene import LoopScene
from solver.threshold import line_tension

LARGE = LoopMaterials(700e3, 0.27e-3, 28e9, 0.5e-3, 25e-3)
STRAIN, POISSON = 0.3, 0.3
TENSION = line_tension(STRAIN, POISSON, Reading.PLANE_STRESS)
SOFTEST = 10.0
"""T/(12 β) up to which loops are solved here: softer ones go to a mesh, and take seconds."""


def _scene(materials, **others):
    k = materials.axial_stiffness
    return LoopScene(STRAIN, materials.beta, POISSON, axial_stiffness=k, **others)


def _answers(*scenes):
    """Heights and energies in the smooth basis."""
    found = [solve_scene(_scene(m), fidelity=Fidelity.COMPACT) for m in scenes]
    assert len({answer.buckled for answer in found}) == 1
    return [(answer.height_over_perimeter, answer.equilibrium.energy) for answer in found]


def _resized(materials, factor):
    return replace(
        materials,
        fabric_thickness_m=factor * materials.fabric_thickness_m,
        wire_diameter_m=factor * materials.wire_diameter_m,
        loop_radius_m=factor * materials.loop_radius_m,
    )


@pytest.mark.parametrize("diameter_m", [1e-4, 1e-3, 1e-2, 1.0, 10.0])
@pytest.mark.parametrize("wire", [1e-2, 2e-2])
def test_loops_from_a_tenth_of_a_millimetre_to_ten_metres_are_alike(diameter_m, wire):
    """Wires from 1 µm to 0.2 m: with all lengths in proportion nothing changes but the units."""
    here = replace(LARGE, wire_diameter_m=wire * 2 * LARGE.loop_radius_m)
    there = _resized(here, diameter_m / 2 / LARGE.loop_radius_m)
    assert there.wire_diameter_m == pytest.approx(wire * diameter_m)
    factor = there.loop_radius_m / here.loop_radius_m
    for dimensionless in ("beta", "axial_stiffness"):
        assert getattr(there, dimensionless) == pytest.approx(
            getattr(here, dimensionless), rel=1e-14
        )
    assert there.alpha(POISSON) == pytest.approx(here.alpha(POISSON), rel=1e-14)
    assert there.energy_unit_J == pytest.approx(factor**3 * here.energy_unit_J, rel=1e-14)
    assert there.radius_of_beta(here.beta) == pytest.approx(there.loop_radius_m, rel=1e-14)
    first, second = _answers(here, there)
    assert second == pytest.approx(first, rel=1e-10)
    assert (first[0] > 0.1) == (here.beta < TENSION / 12)


@pytest.mark.parametrize("power", range(-6, 7, 2))
def test_moduli_across_twelve_decades_change_nothing_but_the_units(power):
    factor = 10.0**power
    there = replace(
        LARGE, fabric_modulus_Pa=factor * 700e3, wire_modulus_Pa=factor * LARGE.wire_modulus_Pa
    )
    assert there.energy_unit_J == pytest.approx(factor * LARGE.energy_unit_J, rel=1e-14)
    first, second = _answers(LARGE, there)
    assert second == pytest.approx(first, rel=1e-10)


@settings(deadline=None, max_examples=30)
@given(st.floats(-4, 1), st.floats(-6, -2))
def test_any_wire_in_any_loop_on_the_papers_fabric(facts, log_diameter, log_wire):
    """Wires of 1 µm to 10 mm in loops of 0.1 mm to 10 m, thinner than a tenth of the loop."""
    diameter = 10**log_diameter
    wire = min(10**log_wire, diameter / 10)
    # a loop of given β has a diameter in proportion to d^(4/3)
    finest = replace(LARGE, wire_diameter_m=wire).radius_of_beta(TENSION / 12 / SOFTEST)
    materials = replace(LARGE, wire_diameter_m=wire, loop_radius_m=min(diameter / 2, finest))
    scene = _scene(materials)
    # fabric as thick as a small loop is wide is no sheet
    if materials.alpha(POISSON) < 0.01:
        scene = replace(scene, alpha=materials.alpha(POISSON))
    answer = solve_scene(scene, tolerance=0.05)
    facts.hold(scene, answer)
    facts.flat_when_it_must_be(scene, answer)


@pytest.mark.parametrize("power", [-6, -3, 0, 3, 6])
def test_fabric_from_a_pascal_up_on_one_wire(facts, power):
    """Soft fabric leaves the loop flat; on stiff fabric the wire counts for nothing."""
    materials = replace(LARGE, fabric_modulus_Pa=700e3 * 10.0**power)
    scene = _scene(materials)
    assert math.isclose(scene.beta, LARGE.beta / 10.0**power, rel_tol=1e-14)
    try:
        answer = solve_scene(scene, tolerance=0.2)
    except NotConvergedError as refusal:
        assert power > 0
        facts.names_a_limit(refusal)
        return
    facts.hold(scene, answer)
    facts.flat_when_it_must_be(scene, answer)
