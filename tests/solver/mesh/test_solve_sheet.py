"""Scenes of any plane arrangement, against exact limits and against each other."""

from dataclasses import replace

import numpy as np
import pytest

from solver.errors import SceneError
from solver.mesh.array_mesh import Between
from solver.mesh.circle_sheet import circle_scene, sheet_of
from solver.mesh.curve import Arc, Ellipse, circle, line
from solver.mesh.levelling import LevellingEnergy
from solver.mesh.measures import bow
from solver.mesh.omissions import mesh_omissions
from solver.mesh.rod_energy import WireStiffness
from solver.mesh.scene import ArrayScene, Contact
from solver.mesh.sheet import Joint, SheetScene, SheetWire
from solver.mesh.solve import solve_array, solve_loop_mesh
from solver.mesh.solve_sheet import solve_sheet
from solver.scene import LoopScene

LOOP = LoopScene(0.3, 0.0145, 0.3)
WIRE = WireStiffness(0.0145, 1000.0)
ROD = WireStiffness(0.2, 1e4)
RING = SheetWire(circle((0.0, 0.0), 1.0), ROD, spanned=False)
HEXAGON = [(2 * np.cos(k * np.pi / 3), 2 * np.sin(k * np.pi / 3)) for k in range(6)]
FLOWER = ((0.0, 0.0), *HEXAGON)
TOUCHING = tuple((0, k) for k in range(1, 7)) + tuple((k, k % 6 + 1) for k in range(1, 7))


def _pair(radius=0.7, **how):
    return circle_scene(
        LOOP, ((0.0, 0.0), (1 + radius, 0.0)), (1.0, radius), ((0, 1),), wires=(WIRE, WIRE), **how
    )


def test_a_bare_ring_has_the_energy_of_its_bending():
    errors = [
        solve_sheet(SheetScene(LOOP, (RING,)), refinement=k).energy - 2 * np.pi * 0.2
        for k in (0, 1, 2)
    ]
    assert abs(errors[2]) < 1e-3
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.2)


def test_a_bare_ring_of_curved_wire():
    curved = replace(RING, stiffness=replace(ROD, natural_curvature=0.5))
    found = solve_sheet(SheetScene(LOOP, (curved,)))
    assert found.energy == pytest.approx(2 * np.pi * 0.2 * 0.25, rel=2e-3)
    assert found.height == pytest.approx(0, abs=1e-5)


def test_a_straight_rod_has_no_energy():
    found = solve_sheet(SheetScene(LOOP, (SheetWire(line((0, 0), (3, 1)), ROD),)))
    assert found.energy == pytest.approx(0, abs=1e-12)
    assert found.lowest_eigenvalue > 0.1
    assert found.loop_heights == pytest.approx([0], abs=1e-6)
    assert found.perimeter == pytest.approx(np.sqrt(10))


def test_an_open_rod_relaxes_to_its_own_curvature():
    own = replace(ROD, natural_curvature=0.8)
    found = solve_sheet(SheetScene(LOOP, (SheetWire(Arc((0, 0), 1.0, 0.0, 1.5), own),)))
    assert found.energy == pytest.approx(0, abs=1e-10)
    points = found.positions[found.mesh.wires[0].vertices]
    before, after = np.diff(points[:-1], axis=0), np.diff(points[1:], axis=0)
    lengths = np.linalg.norm(before, axis=1)
    turn = np.linalg.norm(np.cross(before, after), axis=1) / lengths**2
    assert turn / lengths == pytest.approx(np.full(len(turn), 0.8), rel=1e-3)
    # nothing holds the plane in which each part bends
    assert found.free_motions > 10


def test_a_row_of_two_bonded_rings_keeps_its_energy_and_hinges():
    other = replace(RING, curve=circle((2.0, 0.0), 1.0))
    found = solve_sheet(SheetScene(LOOP, (RING, other), (Joint((0, 1), (1.0, 0.0)),)))
    alone = solve_sheet(SheetScene(LOOP, (RING,)))
    assert found.energy == pytest.approx(2 * alone.energy, rel=1e-6)
    assert found.free_motions == 1


@pytest.mark.parametrize("contact", list(Contact))
def test_two_cut_loops_are_the_grid(contact):
    grid = ArrayScene(LOOP, 1, 2, Between.CUT, contact)
    expected = solve_array(grid, refinement=1)
    found = solve_sheet(sheet_of(grid), refinement=1)
    levelling = found.energy_terms["levelling"]
    assert levelling < 1e-5 * found.energy
    bare = expected.energy - expected.energy_terms["levelling"]
    assert found.energy - levelling == pytest.approx(bare, rel=2e-6)
    assert found.free_motions == expected.free_motions
    assert found.loop_heights == pytest.approx(expected.loop_heights, rel=1e-3)
    assert found.height == pytest.approx(expected.height, rel=2e-2)
    # two turns of fabric under its saddle, and the hinges: one of a bond, three of a point
    assert found.free_motions == (3 if contact is Contact.BONDED else 5)
    weight = next(o for o in mesh_omissions(found) if "weight" in o.term)
    assert weight.matters
    assert weight.value == found.free_motions


def test_four_kept_loops_are_the_grid():
    """Though only the grid is looked for among shapes with mirror planes."""
    grid = ArrayScene(LOOP, 2, 2, Between.KEPT)
    expected = solve_array(grid, refinement=1, tension_field=True)
    found = solve_sheet(sheet_of(grid), refinement=1, tension_field=True)
    assert found.energy == pytest.approx(expected.energy, rel=1e-8)
    assert found.height == pytest.approx(expected.height, rel=1e-4)
    assert "levelling" not in found.energy_terms
    assert found.free_motions == 0


def test_one_ellipse_is_the_loop():
    loop = LoopScene(0.3, 0.0145, 0.3, axis_ratio=1.5)
    turned = SheetWire(Ellipse((3.0, -1.0), loop.semi_axes, 0.7), WIRE)
    found = solve_sheet(SheetScene(loop, (turned,)), refinement=1)
    expected = solve_loop_mesh(loop, refinement=1)
    assert found.energy == pytest.approx(expected.energy, rel=1e-8)
    assert found.height == pytest.approx(expected.height, rel=1e-4)


@pytest.mark.parametrize("between", list(Between))
def test_a_flower_of_seven_is_frustrated(between):
    scene = circle_scene(LOOP, FLOWER, (1.0,) * 7, TOUCHING, between=between)
    found = solve_sheet(scene, refinement=1)
    alone = solve_sheet(circle_scene(LOOP, ((0, 0),), (1.0,), ()), refinement=1)
    assert found.status == "converged"
    assert found.energy > 7 * 1.005 * alone.energy
    assert found.lowest_eigenvalue > 1e-3
    assert found.free_motions == 0
    assert np.ptp(found.loop_heights) > 0.05


def test_cut_gaps_cost_less_than_kept_ones():
    brick = ((0.0, 0.0), (2.0, 0.0), (1.0, 3**0.5), (3.0, 3**0.5))
    pairs = ((0, 1), (2, 3), (0, 2), (1, 2), (1, 3))
    kept, cut = (
        solve_sheet(circle_scene(LOOP, brick, (1.0,) * 4, pairs, between=b), refinement=1)
        for b in (Between.KEPT, Between.CUT)
    )
    assert cut.energy < kept.energy
    assert cut.status == kept.status == "converged"


def test_the_unit_of_length_plays_no_part():
    scene = _pair()
    found = solve_sheet(scene, refinement=0, starts=1)
    other = solve_sheet(scene.in_units_of(2.5), refinement=0, starts=1)
    assert other.energy == pytest.approx(found.energy / 2.5**2, rel=1e-7)
    assert other.loop_heights == pytest.approx(found.loop_heights / 2.5, rel=1e-3)
    assert other.mesh.points == pytest.approx(found.mesh.points / 2.5)
    assert other.perimeter == pytest.approx(found.perimeter / 2.5)


def test_a_loop_of_twice_the_size_is_the_same_loop_at_eight_times_the_beta():
    wire = WireStiffness(8 * 0.0145, 2000.0)
    large = circle_scene(LOOP, ((1.0, 0.0),), (2.0,), (), wires=(wire,))
    found, one = solve_sheet(large, refinement=2), solve_loop_mesh(LOOP, refinement=2)
    assert found.energy == pytest.approx(4 * one.energy, rel=1e-8)
    assert found.height == pytest.approx(2 * one.height, rel=1e-4)


def test_a_small_loop_is_a_loop_of_larger_beta():
    small = solve_sheet(_pair(contact=Contact.POINT), refinement=1).loop_heights[1]
    alone = solve_loop_mesh(LoopScene(0.3, 0.0145 / 0.7**3, 0.3), refinement=1)
    assert small / 0.7 == pytest.approx(alone.height, abs=5e-3)


def test_turned_and_relabelled_scenes_have_the_same_energy():
    found = solve_sheet(_pair(0.8, between=Between.CUT), refinement=1)
    turn = np.exp(0.9j)
    middles = [complex(*wire.curve.centre) * turn + (2 - 1j) for wire in _pair(0.8).wires]
    moved = circle_scene(
        LOOP,
        tuple((m.real, m.imag) for m in reversed(middles)),
        (0.8, 1.0),
        ((1, 0),),
        wires=(WIRE, WIRE),
    )
    other = solve_sheet(moved, refinement=1)
    assert other.energy == pytest.approx(found.energy, rel=1e-5)
    assert other.loop_heights[::-1] == pytest.approx(found.loop_heights, rel=1e-2)


def test_a_wire_across_a_loop_is_a_straight_hinge_line():
    loop = SheetWire(circle((0.0, 0.0), 1.0), WIRE)
    across = SheetWire(line((-1.0, 0.0), (1.0, 0.0)), ROD)
    ends = tuple(Joint((0, 1), (x, 0.0), Contact.POINT) for x in (-1.0, 1.0))
    found = solve_sheet(SheetScene(LOOP, (loop, across), ends), refinement=1)
    alone = solve_loop_mesh(LOOP, refinement=1)
    assert found.status == "converged"
    assert found.energy > alone.energy
    assert found.loop_heights[1] < 0.01
    assert 0.5 * alone.height < found.loop_heights[0] < alone.height


def test_bow_of_an_open_chain():
    chain = np.array([[0.0, 0, 0], [1, 0, 0.5], [2, 0, 0]])
    assert bow(chain) == pytest.approx(0.5)
    assert bow(np.concatenate([chain[:2], chain[:1]])) == pytest.approx(np.sqrt(1.25))


def test_levelling_against_differences():
    rng = np.random.default_rng(1)
    springs = LevellingEnergy(np.arange(5)[:, None], rng.uniform(1, 2, 5))
    at, along = rng.normal(size=(2, 5, 1, 3))
    ahead, behind = (springs.energies(at + s * 1e-5 * along) for s in (1, -1))
    _, gradient, hessian = springs.derivatives(at, None)
    assert np.sum(gradient * along[:, 0], axis=1) == pytest.approx((ahead - behind) / 2e-5)
    slopes = [springs.derivatives(at + s * 1e-5 * along, None)[1] for s in (1, -1)]
    bent = (hessian @ along[:, 0, :, None])[:, :, 0]
    assert (slopes[0] - slopes[1]) / 2e-5 == pytest.approx(bent)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: SheetScene(LOOP, ()), "0 wires"),
        (lambda: SheetScene(LOOP, (RING,), (Joint((0, 1), (1, 0)),)), "joint 0 of wires"),
        (lambda: SheetScene(LOOP, (RING,), (Joint((0, 0), (1, 0)),)), "two or more different"),
        (
            lambda: SheetScene(
                LOOP, (RING, SheetWire(line((-1, 0), (1, 0)), ROD)), (Joint((0, 1), (1, 0)),)
            ),
            "ends there",
        ),
        (
            lambda: SheetScene(
                LOOP, (RING, SheetWire(line((-2, 0), (2, 0)), ROD)), (Joint((0, 1), (1, 0)),)
            ),
            "cross at 90 degrees",
        ),
        (
            lambda: SheetScene(LOOP, (replace(RING, stiffness=WireStiffness(-1, 1)),)),
            "wire 0: beta",
        ),
        (
            lambda: SheetScene(LOOP, (replace(RING, stiffness=WireStiffness(1, 1, -1)),)),
            "wire 0: natural_curvature",
        ),
        (lambda: SheetScene(LOOP, (RING,), outlines=(line((0, 0), (1, 0)),)), "closed curve"),
        (lambda: circle_scene(LOOP, ((0, 0),), (1.0, 2.0), ()), "one for each"),
        (lambda: circle_scene(LOOP, ((0, 0),), (1.0,), ((0, 1),)), "contact"),
        (lambda: solve_sheet(SheetScene(LOOP, (RING,)), starts=0), "starts = 0"),
        (lambda: solve_sheet(SheetScene(LOOP, (RING,)), segments=3), "segments = 3"),
        (lambda: solve_sheet(SheetScene(LOOP, (RING,)), refinement=9), "refinement = 9"),
    ],
)
def test_scenes_that_make_no_sense_are_refused(make, message):
    with pytest.raises(SceneError, match=message):
        make()
