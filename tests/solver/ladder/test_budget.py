"""What a solve may take is counted, and what is refused for it says so."""

import pytest

from solver.errors import NotConvergedError
from solver.ladder import budget, choose, meshed
from solver.ladder.answer import Rung
from solver.ladder.budget import Budget
from solver.ladder.choose import solve_scene
from solver.ladder.edges import loop_vertices
from solver.ladder.fidelity import Fidelity
from solver.mesh.loop_mesh import SEGMENTS
from solver.mesh.mirror import mirrors
from solver.mesh.solve import solve_loop_mesh
from solver.scene import LoopScene

SLACK = LoopScene(0.3, 0.002, 0.3)
CLOSED = LoopScene(2.0, 0.0145, 0.3)


def test_steps_are_dealt_until_the_work_is_done():
    left = Budget(100_000)
    assert left.steps(500, 100, 0.0) == 500
    assert not left.ran_short
    left.spend(60_000, 0.0)
    assert left.steps(500, 100, 0.0) == 400
    assert left.ran_short
    assert left.work == 40_000


def test_costly_steps_count_as_several():
    plain, bent, touching = (Budget(100_000) for _ in range(3))
    assert plain.steps(10**6, 100, 0.0) == 1000
    assert bent.steps(10**6, 100, 0.1) < plain.steps(10**6, 100, 0.0)
    assert touching.steps(10**6, 100, 0.0, contact=True) < 1000
    bent.spend(10_000, 0.1)
    plain.spend(10_000, 0.0)
    assert plain.steps(10**6, 100, 0.0) == 900
    assert bent.steps(10**6, 100, 0.0) < 900


def test_a_mesh_is_not_begun_with_a_few_steps():
    left = Budget(1000)
    assert left.allows(10, 0.0)
    assert not left.ran_short
    assert not left.allows(100, 0.0)
    assert left.ran_short


@pytest.mark.parametrize("refinement", [1, 2, 3])
def test_the_vertices_of_a_loop_are_known_before(refinement):
    found = solve_loop_mesh(SLACK, refinement=refinement, allow_unreliable=True, most_steps=1)
    assert loop_vertices(SEGMENTS, refinement) == len(found.mesh.points)


def test_a_solve_tells_its_work():
    ellipse = LoopScene(0.3, 0.0145, 0.3, axis_ratio=1.2)
    one = solve_loop_mesh(ellipse, refinement=1)
    assert one.work == one.steps * len(one.positions)
    # of a round loop a quarter of the vertices moves
    circle = solve_loop_mesh(LoopScene(0.3, 0.0145, 0.3), refinement=1)
    assert circle.work == circle.steps * len(mirrors(circle.mesh).chosen)
    finer = solve_loop_mesh(ellipse, refinement=2)
    assert finer.steps * len(one.positions) < finer.work < finer.steps * len(finer.positions)


def test_an_error_that_more_work_would_lower_is_refused_with_the_limit(monkeypatch):
    monkeypatch.setattr(meshed, "MOST_WORK", 20_000)
    with pytest.raises(NotConvergedError, match="more than 20000 steps times vertices"):
        solve_scene(SLACK, tolerance=1e-5)


def test_contact_that_takes_too_long_is_refused_with_the_limit():
    with pytest.raises(
        NotConvergedError, match=r"contact: .* steps on 201 vertices.* lower strain"
    ):
        meshed.by_mesh(CLOSED, "tried", 0.5, lenient=False, budget=Budget(12_000))


def test_bent_fabric_that_is_taut_is_not_tried_on_a_mesh_without_its_bending(monkeypatch):
    """Without its bending it is slack, and takes a mesh."""

    def no_mesh(*_args, **_options):
        raise AssertionError

    monkeypatch.setattr(choose, "by_mesh", no_mesh)
    scene = LoopScene(0.3, 0.002, 0.3, alpha=0.01)
    answer = solve_scene(scene, tolerance=1e-2)
    assert answer.rung is Rung.COMPACT
    assert "fabric bending" in answer.terms
    asked = solve_scene(scene, fidelity=Fidelity.COMPACT, tolerance=1e-2)
    assert answer.height_over_perimeter == asked.height_over_perimeter


def test_the_limit_that_is_told_is_the_one_that_holds():
    assert meshed.MOST_WORK == budget.MOST_WORK
