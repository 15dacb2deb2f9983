"""Meshes of plane drawings: which regions they find, and how well they fill them."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solver.errors import SceneError
from solver.mesh.bonds import bond_energy
from solver.mesh.curve import Ellipse, circle, line
from solver.mesh.drawing import Drawing, Knot
from solver.mesh.face_mesh import smallest_angles
from solver.mesh.plane_mesh import Between, FabricRegions, plane_mesh
from solver.mesh.triangulation import GAP, embedded, refinements

KEPT = FabricRegions((True,) * 7, Between.KEPT)
CUT = FabricRegions((True,) * 7, Between.CUT)


def _three(a, b, c):
    """Three circles that touch each other, and the area of the gap between them."""
    x = ((a + b) ** 2 + (a + c) ** 2 - (b + c) ** 2) / (2 * (a + b))
    y = np.sqrt((a + c) ** 2 - x * x)
    centres, radii = np.array([[0, 0], [a + b, 0], [x, y]]), (a, b, c)
    knots, sectors = [], 0.0
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        ahead, aside = centres[j] - centres[i], centres[k] - centres[i]
        knots.append(Knot((i, j), tuple(centres[i] + ahead * radii[i] / (radii[i] + radii[j]))))
        cosine = ahead @ aside / np.linalg.norm(ahead) / np.linalg.norm(aside)
        sectors += radii[i] ** 2 * np.arccos(cosine) / 2
    curves = tuple(circle(tuple(m), r) for m, r in zip(centres, radii, strict=True))
    return Drawing(curves, tuple(knots)), (a + b) * y / 2 - sectors


@settings(max_examples=15, deadline=None)
@given(b=st.floats(0.5, 1.6), c=st.floats(0.5, 1.6))
def test_the_gap_between_three_circles_has_its_area(b, c):
    drawing, exact = _three(1.0, b, c)
    meshes = refinements(plane_mesh(drawing, KEPT), 3)
    discs = np.pi * (1 + b * b + c * c)
    errors = [mesh.areas.sum() - discs - exact for mesh in meshes]
    # what the mesh takes from the discs it gives to the gap: only the outer edge is missed
    assert abs(errors[-1]) < 2e-3 * discs
    assert all(abs(fine) < 0.3 * abs(coarse) for coarse, fine in pairwise(errors))
    assert meshes[-1].areas.min() > 0
    cut = plane_mesh(drawing, CUT)
    assert meshes[0].areas.sum() - cut.areas.sum() == pytest.approx(exact, rel=0.5)
    assert smallest_angles(meshes[0].points, meshes[0].triangles).min() > 1


@settings(max_examples=10, deadline=None)
@given(b=st.floats(0.5, 1.6), c=st.floats(0.5, 1.6))
def test_tangents_are_parallel_though_edges_differ(b, c):
    drawing, _ = _three(1.0, b, c)
    mesh = plane_mesh(drawing, CUT)
    bonds = bond_energy(mesh, 1.0)
    assert len(bonds.vertices) == 3
    flat = embedded(mesh.points)[bonds.vertices]
    # three points of a circle give its tangent exactly
    assert bonds.energies(flat).max() < 1e-12
    assert len(bond_energy(mesh, 1.0, frozenset({0, 2})).vertices) == 1


def test_vertices_of_wires_stay_on_their_curves():
    ellipse = Ellipse((0.3, 0.2), (1.3, 0.8), 0.5)
    across = line(*(tuple(p) for p in ellipse.at(np.array([0.1, 0.6]))))
    ends = tuple(Knot((0, 1), tuple(p)) for p in ellipse.at(np.array([0.1, 0.6])))
    mesh = refinements(plane_mesh(Drawing((ellipse, across), ends), CUT), 3)[-1]
    loop, open_wire = mesh.wires
    unit = (mesh.points[loop.vertices] - ellipse.centre) @ np.array(
        [[np.cos(0.5), -np.sin(0.5)], [np.sin(0.5), np.cos(0.5)]]
    )
    assert np.linalg.norm(unit / ellipse.semi_axes, axis=1) == pytest.approx(1)
    assert not open_wire.closed
    assert set(open_wire.vertices[[0, -1]]) <= set(loop.vertices)
    assert mesh.areas.sum() == pytest.approx(np.pi * 1.3 * 0.8, rel=1e-3)
    assert (mesh.region == GAP).all()


def test_a_large_loop_among_small_ones_is_filled_with_edges_of_the_same_length():
    drawing = Drawing((circle((0, 0), 3.0), circle((3.5, 0), 0.5)), (Knot((0, 1), (3.0, 0.0)),))
    mesh = plane_mesh(drawing, CUT)
    corners = mesh.points[mesh.triangles]
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    assert sides.max() < 1.8 * 2 * np.pi * 1.75 / 20
    assert smallest_angles(mesh.points, mesh.triangles).min() > 15
    assert len(mesh.wires[1].vertices) >= 12


def test_regions_are_kept_and_cut_one_by_one():
    drawing, _ = _three(1.0, 1.0, 1.0)
    middle = (1.0, 1 / np.sqrt(3))
    one_gap = plane_mesh(drawing, FabricRegions((True,) * 3, kept=(middle,)))
    assert one_gap.areas.sum() == pytest.approx(plane_mesh(drawing, KEPT).areas.sum())
    holed = plane_mesh(drawing, FabricRegions((True,) * 3, Between.KEPT, cut=((0.0, 0.0),)))
    assert holed.areas.sum() < one_gap.areas.sum() - 3
    bare = plane_mesh(drawing, FabricRegions((False,) * 3))
    assert len(bare.triangles) == 0
    assert bare.vertex_weights.min() > 0


def test_a_bare_ring_weighs_as_much_as_its_disc():
    mesh = plane_mesh(Drawing((circle((0, 0), 1.0),), ()), FabricRegions((False,)), 80)
    assert mesh.vertex_weights.sum() == pytest.approx(np.pi, rel=1e-2)


def test_fabric_round_a_loop_has_a_hole_that_the_loop_fills():
    drawing = Drawing((circle((0, 0), 1.0), circle((0.2, 0), 1.8)), (), outlines=1)
    mesh = refinements(plane_mesh(drawing, FabricRegions((True,))), 3)[-1]
    assert mesh.areas.sum() == pytest.approx(np.pi * 1.8**2, rel=2e-3)
    rim = mesh.points[mesh.borders[0].vertices] - [0.2, 0]
    assert np.linalg.norm(rim, axis=1) == pytest.approx(1.8)
    assert len(mesh.wires) == 1
    hollow = plane_mesh(drawing, FabricRegions((False,)))
    assert hollow.areas.sum() == pytest.approx(np.pi * (1.8**2 - 1), rel=0.03)


@pytest.mark.parametrize(
    ("drawing", "regions", "message"),
    [
        (Drawing((circle((0, 0), 1.0), circle((1, 0), 1.0)), ()), CUT, "cross near"),
        (Drawing((circle((0, 0), 1.0), circle((3, 0), 1.0)), ()), CUT, "2 parts"),
        (
            Drawing((circle((0, 0), 1.0), circle((2, 0), 1.0)), (Knot((0, 1), (1, 0.1)),)),
            CUT,
            "joint 0 .* away from curve 0",
        ),
        (Drawing((circle((0, 0), 1.0),), ()), FabricRegions((True,), cut=((5, 5),)), "no region"),
        (
            Drawing((circle((0, 0), 1.0),), ()),
            FabricRegions((True,), kept=((0, 0),), cut=((0.1, 0),)),
            "both kept and cut",
        ),
        (
            Drawing((circle((0, 0), 1.0), circle((2, 0), 1.0)), (Knot((0, 1), (1, 0)),) * 2),
            CUT,
            "or two are",
        ),
    ],
)
def test_drawings_that_cannot_be_meshed_are_refused(drawing, regions, message):
    with pytest.raises(SceneError, match=message):
        plane_mesh(drawing, regions)
