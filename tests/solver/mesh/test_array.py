"""Grids of loops that touch."""

import math
from dataclasses import replace

import numpy as np
import pytest

from solver.compact import solve_loop
from solver.errors import SceneError
from solver.ladder.choose import solve_scene
from solver.ladder.fidelity import Fidelity
from solver.mesh.array_mesh import Between
from solver.mesh.curve import Ellipse
from solver.mesh.measures import area_vector
from solver.mesh.omissions import mesh_omissions
from solver.mesh.rod_energy import WireStiffness
from solver.mesh.scene import ArrayScene, Contact
from solver.mesh.sheet import Joint, SheetScene, SheetWire
from solver.mesh.solve import solve_array, solve_loop_mesh
from solver.scene import LoopScene

LOOP = LoopScene(0.3, 0.0145, 0.3)


@pytest.mark.parametrize("poisson", [0.3, 0.45])
@pytest.mark.parametrize("contact", list(Contact))
@pytest.mark.parametrize(("rows", "columns"), [(1, 1), (1, 3), (3, 3)])
def test_cut_grids_tile_exactly(rows, columns, contact, poisson):
    loop = LoopScene(0.3, 0.0145, poisson)
    one = solve_loop_mesh(loop, refinement=2)
    scene = ArrayScene(loop, rows, columns, Between.CUT, contact)
    found = solve_array(scene, refinement=2)
    levelling = found.energy_terms.get("levelling", 0.0)
    assert levelling < 1e-5 * found.energy
    assert (found.energy - levelling) / (rows * columns) == pytest.approx(one.energy, rel=1e-6)
    assert found.height == pytest.approx(one.height, rel=2e-3)
    assert found.loop_heights == pytest.approx(np.full(rows * columns, one.height), rel=2e-3)
    assert found.energy_terms.get("bonds", 0.0) < 1e-6


def test_the_pitch_of_tiles():
    found = solve_array(ArrayScene(LOOP, 1, 2, Between.CUT), refinement=2)
    middles = [found.positions[wire.vertices].mean(axis=0) for wire in found.mesh.wires]
    width = solve_loop(LOOP).shape.width
    assert np.linalg.norm(middles[1] - middles[0]) == pytest.approx(width, rel=1e-2)


@pytest.fixture(scope="module")
def kept():
    """Two by two loops, on meshes refined once, twice and three times."""
    scene = ArrayScene(LOOP, 2, 2, Between.KEPT)
    return [solve_array(scene, refinement=k, tension_field=True) for k in (1, 2, 3)]


def test_kept_fabric_frustrates_the_tiling(kept):
    for k, found in enumerate(kept, start=1):
        one = solve_loop_mesh(LOOP, refinement=k)
        assert found.status == "converged"
        assert found.energy / 4 > 1.005 * one.energy
        # the array rises as a whole, higher than each loop
        assert found.height > 1.25 * found.loop_heights.max()
    # what hinges is so soft that the height settles later than all else
    assert kept[0].height_over_perimeter == pytest.approx(0.187, abs=0.003)
    assert kept[-1].height_over_perimeter == pytest.approx(0.175, abs=0.012)


def test_kept_arrays_settle_with_refinement(kept):
    energies = [found.energy for found in kept]
    assert (energies[0] - energies[1]) / (energies[1] - energies[2]) == pytest.approx(3.65, abs=0.2)
    loops = [found.loop_heights.mean() for found in kept]
    assert loops[-1] == pytest.approx(0.8275, abs=2e-3)


def test_kept_gaps_go_slack_and_loops_do_not(kept):
    assert 0.02 < kept[0].compressed_fraction < 0.25
    plain = solve_array(ArrayScene(LOOP, 2, 2, Between.KEPT), refinement=1)
    assert plain.smallest_stress < 0


def test_three_by_three_bows():
    scene = ArrayScene(LOOP, 3, 3, Between.KEPT)
    found = solve_array(scene, refinement=1, tension_field=True)
    axes = [area_vector(found.positions[wire.vertices]) for wire in found.mesh.wires]
    units = np.array([axis / np.linalg.norm(axis) for axis in axes])
    assert found.height > 1.5 * found.loop_heights.max()
    assert (units[0] @ units[8]) < 0.95


def test_a_row_has_no_gaps_to_keep():
    kept, cut = (solve_array(ArrayScene(LOOP, 1, 3, way), refinement=1) for way in Between)
    assert kept.energy == pytest.approx(cut.energy, rel=1e-8)
    assert kept.height == pytest.approx(cut.height, rel=1e-4)


def test_wires_of_different_stiffness():
    wires = (WireStiffness(0.0145, 1000.0), WireStiffness(0.03, 1000.0))
    scene = ArrayScene(LOOP, 1, 2, Between.CUT, Contact.POINT, wires)
    found = solve_array(scene, refinement=1)
    assert found.status == "converged"
    assert found.loop_heights[1] < 0.8 * found.loop_heights[0]
    # joined at one point, each keeps its own shape
    alone = [solve_loop_mesh(LoopScene(0.3, wire.beta, 0.3), refinement=1).energy for wire in wires]
    assert found.energy == pytest.approx(sum(alone), rel=1e-4)
    # level, they are together as high as the higher one
    assert found.height == pytest.approx(found.loop_heights.max(), rel=2e-3)
    assert found.free_motions == 5  # two turns of fabric, and three of one loop about the point
    bonded = solve_array(ArrayScene(LOOP, 1, 2, Between.CUT, wires=wires), refinement=1)
    assert bonded.energy == pytest.approx(sum(alone), rel=1e-3)


def test_tiles_lie_level_on_fine_meshes_too():
    one = solve_loop_mesh(LOOP, refinement=3)
    found = solve_array(ArrayScene(LOOP, 1, 2, Between.CUT), refinement=3)
    assert found.height == pytest.approx(one.height, rel=1e-4)
    assert found.coarser_height == pytest.approx(one.coarser_height, rel=1e-4)
    assert found.free_motions == 3  # the hinge, and two turns of fabric


@pytest.mark.parametrize("modulus_ratio", [0.8, 1.1, 1.5, 3.0])
def test_loops_of_orthotropic_fabric_tile(modulus_ratio):
    loop = replace(LOOP, modulus_ratio=modulus_ratio)
    one = solve_loop(loop)
    heights = []
    for refinement in (2, 3):
        found = solve_array(ArrayScene(loop, 2, 2, Between.CUT), refinement=refinement)
        assert found.status == "converged"
        assert found.height == pytest.approx(found.loop_heights.max(), rel=1e-3)
        heights.append(found.height)
    # a second-order error, of which the finer mesh has a quarter
    assert (4 * heights[1] - heights[0]) / 3 == pytest.approx(one.shape.height, rel=3e-3)


def test_wires_that_are_equal_are_those_of_the_loop():
    wires = (WireStiffness(0.03, 500.0),) * 2
    given = solve_array(ArrayScene(LOOP, 1, 2, Between.CUT, wires=wires), refinement=2)
    loop = replace(LOOP, beta=0.03, axial_stiffness=500.0)
    own = solve_array(ArrayScene(loop, 1, 2, Between.CUT), refinement=2)
    assert given.height == pytest.approx(own.height, rel=1e-9)
    assert given.coarser_height == pytest.approx(own.coarser_height, rel=1e-9)


def test_loops_that_do_not_tile_lie_level():
    wires = (WireStiffness(0.03, 1000.0), WireStiffness(0.02, 1000.0))
    scenes = (
        ArrayScene(LOOP, 1, 2, Between.CUT, wires=wires),
        ArrayScene(replace(LOOP, axis_ratio=1.5), 1, 2, Between.CUT),
    )
    for scene, motions in zip(scenes, (3, 1), strict=True):
        found = solve_array(scene, refinement=2)
        assert found.status == "converged"
        assert found.height < 1.01 * found.loop_heights.max()
        # the coarser mesh tells the error of the whole height, too
        assert abs(found.height / found.coarser_height - 1) < 0.03
        assert found.free_motions == motions
        weight = next(left for left in mesh_omissions(found) if left.term.startswith("weight"))
        assert weight.matters


@pytest.mark.parametrize(
    "scene",
    [
        ArrayScene(LoopScene(0.0, 0.0145, 0.3), 2, 2, Between.KEPT),
        ArrayScene(LoopScene(0.0, 0.0145, 0.3), 2, 2, Between.CUT),
        ArrayScene(LoopScene(0.01, 0.5, 0.3), 2, 2, Between.CUT),
        ArrayScene(LOOP, 1, 2, Between.CUT, wires=(WireStiffness(1.0, 1e3), WireStiffness(2, 1e3))),
    ],
)
def test_what_does_not_buckle_is_flat(scene):
    answer = solve_scene(scene, fidelity=Fidelity.MESH, refinement=2)
    assert not answer.buckled
    assert answer.height_over_perimeter < 1e-9


def test_scenes_out_of_range_are_refused():
    with pytest.raises(SceneError, match="loops"):
        ArrayScene(LOOP, 0, 2, Between.CUT)
    with pytest.raises(SceneError, match="one for each"):
        ArrayScene(LOOP, 1, 2, Between.CUT, wires=(WireStiffness(0.1, 1.0),))
    with pytest.raises(SceneError, match="greater than 0"):
        ArrayScene(LOOP, 1, 1, Between.CUT, wires=(WireStiffness(-0.1, 1.0),))


@pytest.mark.parametrize(
    ("wire", "said"),
    [
        (WireStiffness(math.inf, 1.0), "finite"),
        (WireStiffness(math.nan, 1.0), "finite"),
        (WireStiffness(0.1, math.inf), "finite"),
        (WireStiffness(0.1, 1.0, natural_curvature=-3.0), "natural_curvature"),
        (WireStiffness(0.1, 1.0, natural_curvature=math.nan), "natural_curvature"),
        (WireStiffness(0.1, 1.0, twist_ratio=math.inf), "twist_ratio"),
        (WireStiffness(0.1, 1.0, natural_curvature=1.0, twist_ratio=0.7), "straight wire"),
    ],
)
def test_wires_out_of_range_are_refused(wire, said):
    with pytest.raises(SceneError, match=f"wire 1: .*{said}"):
        ArrayScene(LOOP, 1, 2, Between.CUT, wires=(WireStiffness(0.1, 1.0), wire))


@pytest.mark.parametrize("contact", list(Contact))
def test_joints_at_no_point_are_refused(contact):
    wires = tuple(
        SheetWire(Ellipse((x, 0.0), (1.0, 1.0)), WireStiffness(0.1, 1.0)) for x in (0.0, 2.0)
    )
    with pytest.raises(SceneError, match=r"joint 0 .*finite"):
        SheetScene(LOOP, wires, (Joint((0, 1), (math.nan, 0.0), contact),))


@pytest.mark.parametrize("segments", [8, 28])
def test_segments_are_the_edges_of_a_loop_and_its_triangles(segments):
    found = solve_array(
        ArrayScene(LOOP, 1, 2, Between.CUT), refinement=0, segments=segments, most_steps=200
    )
    assert [len(wire.edges) for wire in found.mesh.wires] == [segments] * 2
    assert len(found.mesh.triangles) == 2 * segments
    alone = solve_loop_mesh(LOOP, refinement=0, segments=segments)
    assert found.energy == pytest.approx(2 * alone.energy, rel=1e-5)
