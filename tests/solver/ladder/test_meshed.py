"""What the last rung says of a shape that passes through itself, where it cannot mend that."""

import pytest

from solver.checks import CONTACT
from solver.errors import NotConvergedError
from solver.ladder import meshed
from solver.ladder.choose import solve_scene
from solver.ladder.fidelity import Fidelity
from solver.scene import LoopScene

CLOSED = LoopScene(2.0, 0.0145, 0.3)


def test_without_the_library_the_remedy_is_told(monkeypatch):
    monkeypatch.setattr(meshed, "contact_available", lambda: False)
    with pytest.raises(NotConvergedError, match=r"pip install 'sesame-cad\[contact\]'"):
        solve_scene(CLOSED, fidelity=Fidelity.MESH, tolerance=0.5)


def test_a_mesh_too_large_for_contact_is_told(monkeypatch):
    monkeypatch.setattr(meshed, "LARGEST_IN_CONTACT", 100)
    with pytest.raises(NotConvergedError, match="up to 100 triangles"):
        solve_scene(CLOSED, fidelity=Fidelity.MESH, tolerance=0.5)


def test_who_asks_for_the_shape_nevertheless_is_told_what_it_lacks(monkeypatch):
    monkeypatch.setattr(meshed, "contact_available", lambda: False)
    crossed = solve_scene(CLOSED, fidelity=Fidelity.MESH, tolerance=0.5, allow_unreliable=True)
    (contact,) = (left for left in crossed.omitted if left.term == CONTACT)
    assert contact.fatal
    assert contact.value == crossed.equilibrium.distances.crossings > 0


def test_a_loop_that_meets_itself_in_the_smooth_basis_is_refused_there():
    with pytest.raises(NotConvergedError):
        solve_scene(CLOSED, fidelity=Fidelity.COMPACT)
