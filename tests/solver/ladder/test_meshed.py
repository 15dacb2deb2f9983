"""What the last rung says of a shape that passes through itself, where it cannot mend that."""

import pytest

from solver.checks import CONTACT, TWIST
from solver.errors import NotConvergedError
from solver.ladder import contact, meshed
from solver.ladder.choose import solve_scene
from solver.ladder.contact import ContactChoice
from solver.ladder.fidelity import Fidelity
from solver.mesh.array_mesh import Between
from solver.mesh.scene import ArrayScene
from solver.scene import LoopScene

CLOSED = LoopScene(2.0, 0.0145, 0.3)


def test_without_the_library_the_remedy_is_told(monkeypatch):
    monkeypatch.setattr(contact, "contact_available", lambda: False)
    with pytest.raises(NotConvergedError, match=r"pip install 'sesame-cad\[contact\]'"):
        solve_scene(CLOSED, fidelity=Fidelity.MESH, tolerance=0.5)


def test_a_mesh_too_large_for_contact_is_told(monkeypatch):
    monkeypatch.setattr(contact, "LARGEST_IN_CONTACT", 100)
    with pytest.raises(NotConvergedError, match="up to 100 triangles"):
        solve_scene(CLOSED, fidelity=Fidelity.MESH, tolerance=0.5)


def test_contact_that_does_not_settle_is_refused_with_a_remedy(monkeypatch):
    monkeypatch.setattr(contact, "_MOST_STEPS", 2)
    limit = "after 2 steps on 201 vertices, the most that it may take"
    remedy = r"raise beta or lower strain, or take the shape without contact \(--contact off\)"
    with pytest.raises(NotConvergedError, match=f"{limit}.*{remedy}") as refusal:
        solve_scene(CLOSED, fidelity=Fidelity.MESH, tolerance=0.5)
    assert str(refusal.value).count("--contact off") == 1


def test_a_coarser_mesh_that_has_a_shape_is_told(monkeypatch):
    solve = meshed.solve_on_mesh

    def refusing(scene, refinement, **options):
        if refinement == 4:
            raise NotConvergedError("tired")
        return solve(scene, refinement, **options)

    monkeypatch.setattr(meshed, "solve_on_mesh", refusing)
    loop = LoopScene(0.3, 0.0145, 0.3)
    told = r"tired, or allow a tolerance above 1\.5e-03: the mesh before, of 1280 triangles"
    with pytest.raises(NotConvergedError, match=told):
        solve_scene(loop, fidelity=Fidelity.MESH, tolerance=1e-3)
    answer = solve_scene(loop, fidelity=Fidelity.MESH, tolerance=1.6e-3)
    assert len(answer.equilibrium.mesh.triangles) == 1280


def test_a_wire_that_would_wriggle_is_refused_on_the_coarsest_mesh(monkeypatch):
    solve = meshed.solve_on_mesh

    def refusing(scene, refinement, **options):
        assert refinement == 2
        return solve(scene, refinement, **options)

    monkeypatch.setattr(meshed, "solve_on_mesh", refusing)
    wriggling = LoopScene(0.3, 0.0145, 0.3, natural_curvature=4.0)
    with pytest.raises(NotConvergedError, match=r"resistance to twist.*lower natural_curvature"):
        solve_scene(wriggling, fidelity=Fidelity.MESH, tolerance=1e-3)


def test_a_flat_wire_of_its_own_curvature_does_not_wriggle():
    answer = solve_scene(
        LoopScene(0.0, 0.0145, 0.3, natural_curvature=1.0), fidelity=Fidelity.MESH, tolerance=0.01
    )
    assert not answer.buckled


def test_who_asks_for_the_shape_nevertheless_is_told_what_it_lacks(monkeypatch):
    monkeypatch.setattr(contact, "contact_available", lambda: False)
    crossed = solve_scene(CLOSED, fidelity=Fidelity.MESH, tolerance=0.5, allow_unreliable=True)
    (left_out,) = (left for left in crossed.omitted if left.term == CONTACT)
    assert left_out.fatal
    assert left_out.value == crossed.equilibrium.distances.crossings > 0


def test_contact_is_left_out_on_demand_and_told():
    array = ArrayScene(LoopScene(0.3, 0.0145, 0.3), 2, 2, Between.KEPT)
    answer = solve_scene(array, tolerance=0.5, contact=ContactChoice.OFF)
    found = answer.equilibrium
    assert found.status == "converged"
    assert found.contact is None
    assert found.distances.crossings > 0
    told = f"as asked: the shape passes through itself, at {found.distances.crossings} pairs"
    assert told in answer.reason
    (left_out,) = (left for left in answer.omitted if left.term == CONTACT)
    assert left_out.matters
    assert left_out.value == found.distances.crossings
    assert "contact" not in answer.terms


def test_leaving_contact_out_does_not_excuse_another_fault():
    array = ArrayScene(LoopScene(0.3, 0.0145, 0.3), 2, 2, Between.KEPT)
    with pytest.raises(NotConvergedError, match="tolerance"):
        solve_scene(array, tolerance=1e-8, contact=ContactChoice.OFF)


def _refusing_all_but_a_corner(monkeypatch):
    solve = meshed.solve_on_mesh

    def refusing(scene, refinement, **options):
        assert scene.rows * scene.columns <= 4
        return solve(scene, refinement, **options)

    monkeypatch.setattr(meshed, "solve_on_mesh", refusing)


def test_arrays_too_large_for_contact_are_refused_before_they_are_solved(monkeypatch):
    _refusing_all_but_a_corner(monkeypatch)
    array = ArrayScene(LoopScene(0.3, 0.0145, 0.3), 10, 10, Between.KEPT)
    with pytest.raises(NotConvergedError, match=r"17072 triangles .*--contact off"):
        solve_scene(array)


def test_large_arrays_of_which_no_corner_meets_itself_are_solved(monkeypatch):
    _refusing_all_but_a_corner(monkeypatch)
    with pytest.raises(AssertionError):
        solve_scene(ArrayScene(LoopScene(0.05, 0.0145, 0.3), 10, 10, Between.KEPT))


def test_a_loop_that_meets_itself_in_the_smooth_basis_is_refused_there():
    with pytest.raises(NotConvergedError):
        solve_scene(CLOSED, fidelity=Fidelity.COMPACT)


WRITHING = LoopScene(0.3, 0.0225, 0.3, axis_ratio=1.5)


def test_twist_is_added_where_the_shape_without_it_writhes():
    answer = meshed.by_mesh(WRITHING, "tried", 0.05, lenient=False, add_twist=True)
    assert "wire twist" in answer.terms
    assert answer.reason == f"tried; {meshed.TWIST_ADDED}"
    assert answer.equilibrium.scene.twist_ratio > 0


def test_where_no_shape_with_twist_is_found_it_is_left_out_and_told(monkeypatch):
    solve = meshed.solve_on_mesh

    def refusing(scene, refinement, **options):
        if scene.twist_ratio > 0:
            raise NotConvergedError("with twist")
        return solve(scene, refinement, **options)

    monkeypatch.setattr(meshed, "solve_on_mesh", refusing)
    answer = meshed.by_mesh(WRITHING, "tried", 0.05, lenient=False, add_twist=True)
    assert answer.reason == "tried"
    assert next(left for left in answer.omitted if left.term == TWIST).matters


def test_refinement_ends_at_a_number_of_triangles(monkeypatch):
    monkeypatch.setattr(meshed, "MOST_TRIANGLES", 1000)
    array = ArrayScene(LoopScene(0.3, 0.03, 0.3), 1, 2, Between.CUT)
    with pytest.raises(NotConvergedError, match=r"of 640 triangles, .* or solve fewer loops"):
        meshed.by_mesh(array, "tried", 1e-9, lenient=False)


def test_tiles_tell_their_error():
    loop = LoopScene(0.3, 0.0145, 0.3)
    array = ArrayScene(loop, 1, 2, Between.CUT)
    answer = solve_scene(array, fidelity=Fidelity.MESH, tolerance=0.1)
    alone = solve_scene(loop).height_over_perimeter
    assert 1e-4 < answer.height_error < 0.02
    assert answer.height_over_perimeter == pytest.approx(alone, rel=2 * answer.height_error)
