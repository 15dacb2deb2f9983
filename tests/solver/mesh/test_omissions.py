"""What a solved mesh says of itself."""

from dataclasses import replace

import numpy as np
import pytest

from solver.mesh.array_mesh import Grid, array_fan
from solver.mesh.omissions import _stiff_gaps
from solver.mesh.plane_mesh import Between
from solver.mesh.triangulation import refined


@pytest.mark.parametrize("stiff", [True, False])
def test_gaps_of_thin_triangles_are_told(stiff):
    """Fans about the middles of gaps have such."""
    mesh = refined(array_fan(Grid(2, 2), Between.KEPT))
    if stiff:
        rim = np.unique(np.concatenate([wire.vertices for wire in mesh.wires]))
        points = 1.0 + 0.1 * (mesh.points - 1.0)
        points[rim] = mesh.points[rim]
        mesh = replace(mesh, points=points)
    (term,) = _stiff_gaps(mesh)
    assert term.matters is stiff
    assert (term.value >= 0.3) is stiff
    assert _stiff_gaps(array_fan(Grid(2, 2), Between.CUT)) == ()
