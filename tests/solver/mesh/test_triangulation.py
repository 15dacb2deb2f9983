from itertools import pairwise

import numpy as np
import pytest

from solver.errors import SceneError
from solver.mesh.array_mesh import Between, Grid, array_fan
from solver.mesh.loop_mesh import loop_fan
from solver.mesh.triangulation import (
    GAP,
    Mesh,
    RoundRegion,
    Wire,
    embedded,
    prolonged,
    refinements,
    unrefined,
)

COARSEST = [
    loop_fan(),
    loop_fan(1.7),
    array_fan(Grid(2, 3), Between.CUT),
    array_fan(Grid(3, 2), Between.KEPT),
    array_fan(Grid(2, 2), Between.KEPT, 1.4),
]


def _square():
    """Two triangles with an open wire along their outline."""
    points = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    triangles = np.array([[0, 1, 2], [0, 2, 3]])
    wire = Wire(np.array([0, 1, 2, 3]), closed=False)
    return unrefined(points, triangles, np.full(2, GAP), (), (wire,))


@pytest.mark.parametrize("coarsest", COARSEST)
def test_refinement_splits_in_four_and_keeps_the_vertices(coarsest):
    meshes = refinements(coarsest, 3)
    for coarse, fine in pairwise(meshes):
        assert len(fine.triangles) == 4 * len(coarse.triangles)
        assert np.array_equal(fine.points[: len(coarse.points)], coarse.points)
        assert fine.areas.min() > 0
        assert fine.vertex_areas.sum() == pytest.approx(fine.areas.sum())
        for wire, refined_wire in zip(coarse.wires, fine.wires, strict=True):
            assert np.array_equal(refined_wire.vertices[::2], wire.vertices)


@pytest.mark.parametrize("coarsest", COARSEST)
def test_every_wire_lies_on_its_ellipse_along_edges(coarsest):
    mesh = refinements(coarsest, 2)[-1]
    sides = np.sort(mesh.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    known = {tuple(side) for side in sides.tolist()}
    for wire, region in zip(mesh.wires, mesh.rounds, strict=True):
        inside = (mesh.points[wire.vertices] - region.centre) / np.array(region.semi_axes)
        assert np.linalg.norm(inside, axis=1) == pytest.approx(np.ones(len(inside)))
        assert {tuple(edge) for edge in np.sort(wire.edges, axis=1).tolist()} <= known


def test_area_of_a_disc_has_second_order():
    errors = [np.pi - mesh.areas.sum() for mesh in refinements(loop_fan(), 3)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders == pytest.approx(np.full(3, 2.0), abs=0.02)


def test_perimeter_of_an_ellipse():
    mesh = refinements(loop_fan(2.5), 5)[-1]
    ends = mesh.points[mesh.wires[0].edges]
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    assert lengths.sum() == pytest.approx(2 * np.pi, rel=1e-4)


def test_kept_gaps_fill_the_plane_between_the_loops():
    cut, kept = (refinements(array_fan(Grid(2, 2), b), 4)[-1] for b in Between)
    gap = kept.areas[kept.region == GAP].sum()
    # the square between four centres less four quarter discs, as polygons
    assert gap == pytest.approx(4 - cut.areas.sum() / 4)


def test_kept_and_cut_grids_have_the_same_loops():
    cut, kept = (refinements(array_fan(Grid(3, 2), b), 2)[-1] for b in Between)
    assert kept.areas[kept.region != GAP] == pytest.approx(cut.areas)


@pytest.mark.parametrize("coarsest", COARSEST)
def test_prolongation_moves_rigidly(coarsest):
    coarse, fine = refinements(coarsest, 1)
    turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    moved = prolonged(coarse, fine, embedded(coarse.points) @ turn + 0.3)
    # the edge's new vertices lie off their parents' chord, by less than h²/8
    assert moved == pytest.approx(embedded(fine.points) @ turn + 0.3, abs=0.05)
    shifted = prolonged(coarse, fine, embedded(coarse.points) + np.array([1.0, 2.0, 3.0]))
    assert shifted == pytest.approx(embedded(fine.points) + np.array([1.0, 2.0, 3.0]))


@pytest.mark.parametrize("closed", [True, False])
def test_wires_interpolate_smooth_values_with_fourth_order(closed):
    errors = []
    for count in (20, 40):
        angle = np.arange(count) * (2 * np.pi / count)
        wire = Wire(np.arange(count), closed=closed)
        middle = angle + np.pi / count
        exact = np.sin(middle) if closed else np.sin(middle[:-1])
        errors.append(np.abs(wire.midway(np.sin(angle)[:, None])[:, 0] - exact).max())
    assert np.log2(errors[0] / errors[1]) == pytest.approx(4, abs=0.2)


def test_open_wires_keep_their_ends():
    fine = refinements(_square(), 2)[-1]
    wire = fine.wires[0]
    assert not wire.closed
    assert len(wire.edges) == 12
    assert len(wire.corners) == 11
    assert wire.vertices[0] == 0
    assert wire.vertices[-1] == 3


def test_short_open_wires_interpolate_linearly():
    wire = Wire(np.array([0, 1]), closed=False)
    assert wire.midway(np.array([[1.0], [3.0]])) == pytest.approx(np.array([[2.0]]))


def test_clockwise_triangles_are_refused():
    with pytest.raises(SceneError, match="clockwise"):
        unrefined(np.eye(3)[:, :2], np.array([[1, 0, 2]]), np.zeros(1, int), (RoundRegion(),), ())


def test_a_mesh_is_its_own_parent():
    mesh: Mesh = loop_fan()
    assert np.array_equal(mesh.parents[:, 0], np.arange(21))
