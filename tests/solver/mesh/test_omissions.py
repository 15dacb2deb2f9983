"""What a solved mesh says of itself."""

import pytest

from solver.mesh.array_mesh import Grid, array_fan
from solver.mesh.omissions import _stiff_gaps
from solver.mesh.plane_mesh import Between
from solver.mesh.triangulation import refined


@pytest.mark.parametrize(("segments", "stiff"), [(20, True), (28, False)])
def test_gaps_of_thin_triangles_are_told(segments, stiff):
    """Fans of 20 edges and more are thin; from 24 on, gaps are triangulated otherwise."""
    mesh = refined(array_fan(Grid(2, 2), Between.KEPT, segments=segments))
    (term,) = _stiff_gaps(mesh)
    assert term.matters is stiff
    assert (term.value >= 0.3) is stiff
    assert _stiff_gaps(array_fan(Grid(2, 2), Between.CUT)) == ()
