"""How near a mesh comes to itself, against shapes of which that is known, and against ipctk."""

import ipctk
import numpy as np
import pytest

from solver.mesh.self_contact import crossings, mesh_edges, self_contact
from solver.mesh.triangulation import embedded


@pytest.mark.parametrize("gap", [0.09, 0.01, 1e-4])
def test_distance_of_opposite_rims(gap, rolled_disc):
    mesh, positions = rolled_disc(gap)
    near = self_contact(mesh, positions)
    assert near.wire_to_wire == pytest.approx(gap, rel=1e-6)
    assert near.wire_to_fabric == pytest.approx(gap, rel=1e-6)
    assert near.crossings == 0


def test_what_is_far_is_not_looked_at(rolled_disc):
    mesh, positions = rolled_disc(0.12)
    near = self_contact(mesh, positions)
    assert near.wire_to_wire == near.wire_to_fabric == float("inf")
    assert self_contact(mesh, positions, 0.2).wire_to_wire == pytest.approx(0.12)


def test_flat_fabric_does_not_cross_itself(rolled_disc):
    mesh, _ = rolled_disc(0.1)
    assert crossings(mesh, embedded(mesh.points)) == 0


@pytest.mark.parametrize("overlap", [-0.05, 0.015, 0.03, 0.3])
def test_crossings_are_those_of_another_program(overlap, rolled_disc):
    """A rim that is moved sideways through the other."""
    mesh, positions = rolled_disc(0.02)
    positions[:, 0] += overlap * np.where(mesh.points[:, 0] > 0.7, -1.0, 0.0)
    sides = mesh_edges(mesh.triangles)
    body = ipctk.CollisionMesh(
        np.asfortranarray(embedded(mesh.points)),
        np.asfortranarray(sides, dtype=np.int32),
        np.asfortranarray(mesh.triangles, dtype=np.int32),
    )
    expected = ipctk.has_intersections(body, np.asfortranarray(positions))
    assert (crossings(mesh, positions) > 0) == expected == (overlap > 0.02)


def test_a_turned_shape_is_as_near_to_itself(rolled_disc):
    mesh, positions = rolled_disc(0.03)
    near = self_contact(mesh, positions)
    turned = self_contact(mesh, positions @ np.linalg.qr(np.ones((3, 3)) + np.eye(3))[0])
    assert turned.wire_to_wire == pytest.approx(near.wire_to_wire, rel=1e-9)
