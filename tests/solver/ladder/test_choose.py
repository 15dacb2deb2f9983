"""Which rung is taken, and that the rungs agree where more than one can go."""

import subprocess
import sys
from dataclasses import replace

import pytest

from solver.checks import GAUSS, TWIST
from solver.compact import solve_loop
from solver.equilibrium import Kind
from solver.errors import NotConvergedError, SceneError
from solver.ladder.answer import Rung
from solver.ladder.choose import solve_scene
from solver.ladder.fabric_share import FABRIC_BENDING
from solver.ladder.fidelity import Fidelity
from solver.ladder.law import law_error
from solver.many import solve_many
from solver.mesh.array_mesh import Between
from solver.mesh.curve import circle, line
from solver.mesh.rod_energy import WireStiffness
from solver.mesh.scene import ArrayScene, Contact
from solver.mesh.sheet import Joint, SheetScene, SheetWire
from solver.mesh.solve_sheet import solve_sheet
from solver.reading import Reading
from solver.scene import LoopScene

LOOP = LoopScene(0.3, 0.0145, 0.3)


def test_auto_takes_the_law_only_within_its_error():
    error = law_error(LOOP)
    assert 0 < error < 0.2
    assert solve_scene(LOOP, tolerance=1.01 * error).rung is Rung.SCALING
    assert solve_scene(LOOP, tolerance=0.99 * error).rung is Rung.COMPACT


@pytest.mark.parametrize(("stiffness", "tolerance"), [(1.0, 0.2), (0.01, 0.1), (10.0, 0.1)])
def test_auto_knows_that_a_soft_wire_shortens(stiffness, tolerance):
    scene = replace(LOOP, axial_stiffness=stiffness)
    exact = solve_scene(scene, fidelity=Fidelity.COMPACT)
    answer = solve_scene(scene, tolerance=tolerance)
    assert answer.buckled == exact.buckled
    height = exact.height_over_perimeter
    assert answer.height_over_perimeter == pytest.approx(height, rel=tolerance)


def test_auto_goes_on_where_the_law_finds_fabric_that_may_be_slack():
    slack, taut = (LoopScene(0.45, b, 0.45, Reading.PUBLISHED) for b in (0.02, 0.1))
    assert law_error(slack) == float("inf")
    assert 0 < law_error(taut) < 0.05
    (left,) = (
        o for o in solve_scene(slack, fidelity=Fidelity.SCALING).omitted if "slack" in o.term
    )
    assert left.matters
    assert left.value > 1


@pytest.mark.parametrize("tolerance", [float("nan"), -1.0, 0.0, float("inf")])
def test_a_tolerance_is_a_finite_number_above_0(tolerance):
    for fidelity in Fidelity:
        with pytest.raises(SceneError, match="tolerance"):
            solve_scene(LOOP, fidelity=fidelity, tolerance=tolerance)
    with pytest.raises(SceneError, match="tolerance"):
        solve_loop(LOOP, tolerance=tolerance)
    with pytest.raises(SceneError, match="tolerance"):
        solve_many(0.3, 0.0145, 0.3, tolerance=tolerance)


def test_the_law_is_not_trusted_where_it_was_not_compared():
    assert law_error(LoopScene(0.3, 0.001, 0.3)) == float("inf")
    assert law_error(LoopScene(1.0, 0.1, 0.3)) == float("inf")
    assert law_error(LoopScene(0.3, 0.0145, 0.3, axis_ratio=1.2)) == float("inf")


@pytest.mark.parametrize(
    "scene",
    [LOOP, LoopScene(0.2, 0.01, 0.4), LoopScene(0.3, 0.06, 0.45, Reading.PUBLISHED)],
)
def test_the_rungs_agree_within_their_stated_errors(scene):
    law, compact, mesh = (
        solve_scene(scene, fidelity=fidelity, tolerance=2e-3)
        for fidelity in (Fidelity.SCALING, Fidelity.COMPACT, Fidelity.MESH)
    )
    exact = compact.height_over_perimeter
    assert law.height_over_perimeter == pytest.approx(exact, rel=law.height_error)
    assert mesh.height_over_perimeter == pytest.approx(exact, rel=2 * mesh.height_error)
    assert mesh.height_error <= 2e-3


def test_all_rungs_know_a_flat_loop():
    scene = LoopScene(0.1, 0.03, 0.3)
    for fidelity in Fidelity:
        answer = solve_scene(scene, fidelity=fidelity)
        assert not answer.buckled
        assert answer.height_over_perimeter == pytest.approx(0, abs=1e-6)


def test_arrays_that_tile_are_one_loop():
    tiled = solve_scene(ArrayScene(LOOP, 3, 3, Between.CUT))
    assert tiled.rung is Rung.COMPACT
    assert "tile" in tiled.reason
    alone = solve_scene(LOOP)
    assert tiled.height_over_perimeter == alone.height_over_perimeter


def test_arrays_that_act_on_each_other_are_meshed():
    kept = solve_scene(ArrayScene(LOOP, 2, 2, Between.KEPT), refinement=1)
    assert kept.rung is Rung.MESH
    assert kept.height_over_perimeter > 1.2 * solve_scene(LOOP).height_over_perimeter
    # the fabric in the middle draws the loops together until they meet
    assert "contact was added" in kept.reason
    assert "contact" in kept.terms
    assert kept.equilibrium.contact.before.crossings > 0
    assert not kept.equilibrium.meets_itself
    assert all("contact" not in left.term for left in kept.omitted)


@pytest.mark.parametrize("fidelity", [Fidelity.SCALING, Fidelity.COMPACT])
def test_one_loop_rungs_refuse_arrays_that_do_not_tile(fidelity):
    with pytest.raises(SceneError, match="mesh"):
        solve_scene(ArrayScene(LOOP, 2, 2, Between.KEPT), fidelity=fidelity)


def test_any_scene_is_meshed_until_it_is_near_enough():
    """A wire across a loop: no other rung knows it."""
    loop = SheetWire(circle((0.0, 0.0), 1.0), WireStiffness(0.0145, 1000.0))
    across = SheetWire(line((-1.0, 0.0), (1.0, 0.0)), WireStiffness(0.0145, 1000.0))
    ends = tuple(Joint((0, 1), (x, 0.0), Contact.POINT) for x in (-1.0, 1.0))
    scene = SheetScene(LOOP, (loop, across), ends)
    answer = solve_scene(scene, tolerance=0.01)
    assert answer.rung is Rung.MESH
    assert answer.height_error <= 0.01
    finer = solve_sheet(answer.equilibrium.scene, refinement=3)  # with its wires' twist
    exact = pytest.approx(finer.height_over_perimeter, rel=2 * answer.height_error)
    assert answer.height_over_perimeter == exact
    assert {"fabric stretch", "wire bending"} <= set(answer.terms)
    for fidelity in (Fidelity.SCALING, Fidelity.COMPACT):
        with pytest.raises(SceneError, match="mesh solves any scene"):
            solve_scene(scene, fidelity=fidelity)


def test_free_hinges_are_told():
    rods = (WireStiffness(0.2, 1000.0),) * 2
    rings = tuple(
        SheetWire(circle((2.0 * k, 0.0), 1.0), rod, spanned=False) for k, rod in enumerate(rods)
    )
    scene = SheetScene(LOOP, rings, (Joint((0, 1), (1.0, 0.0)),))
    answer = solve_scene(scene, tolerance=0.05)
    weight = next(o for o in answer.omitted if "weight" in o.term)
    assert weight.matters
    assert weight.value == 1


def test_the_law_refuses_ellipses():
    with pytest.raises(SceneError, match="compact"):
        solve_scene(LoopScene(0.3, 0.0145, 0.3, axis_ratio=1.5), fidelity=Fidelity.SCALING)


def test_an_error_that_no_mesh_meets_is_told():
    with pytest.raises(NotConvergedError, match="tolerance"):
        solve_scene(ArrayScene(LOOP, 1, 2, Between.KEPT), fidelity=Fidelity.MESH, tolerance=1e-8)


def test_the_law_loads_no_sparse_matrices():
    program = (
        "import sys\n"
        "from solver.ladder.law import by_law\n"
        "from solver.scene import LoopScene\n"
        "by_law(LoopScene(0.3, 0.0145, 0.3), 'asked for')\n"
        "print([m for m in sys.modules if m.startswith(('scipy.sparse', 'solver.mesh'))])\n"
    )
    run = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert run.stdout.strip() == "[]"


@pytest.mark.parametrize(("strain", "beta"), [(0.3, 0.002), (0.5, 0.005)])
def test_slack_fabric_gets_a_tension_field(strain, beta):
    answer = solve_scene(LoopScene(strain, beta, 0.3), tolerance=5e-3)
    assert answer.rung is Rung.MESH
    assert "tension field" in answer.reason
    assert "fabric stretch (tension field)" in answer.terms
    assert all("slack" not in left.term for left in answer.omitted)
    assert answer.height_over_perimeter == pytest.approx(0.156, abs=3e-3)


def test_what_slack_fabric_allows_no_nearer_is_told():
    with pytest.raises(NotConvergedError, match="allow a larger tolerance"):
        solve_scene(LoopScene(0.3, 0.002, 0.3), tolerance=1e-5)


def test_a_shape_with_writhe_gets_the_wires_twist():
    """Without twist the ellipse's diagonal saddle is lowest; with it, the one along the axes."""
    scene = LoopScene(0.3, 0.0145, 0.3, axis_ratio=1.5)
    without = solve_scene(scene, fidelity=Fidelity.COMPACT)
    answer = solve_scene(scene)
    assert without.equilibrium.kind is Kind.DIAGONAL
    assert answer.equilibrium.kind is Kind.ALIGNED
    assert "twist was added" in answer.reason
    assert answer.equilibrium.scene.twist_ratio == 0.75


def test_a_rough_shape_of_slack_fabric_does_not_tell_that_its_wire_would_wriggle():
    answer = solve_scene(replace(LOOP, natural_curvature=2.0), tolerance=0.01)
    assert answer.rung is Rung.MESH
    assert answer.height_over_perimeter == pytest.approx(0.1555, rel=5e-3)


@pytest.mark.parametrize("natural_curvature", [2.5, 4.0])
def test_a_wire_that_would_wriggle_is_not_passed_on_to_a_mesh(natural_curvature, monkeypatch):
    monkeypatch.delattr("solver.ladder.meshed.solve_on_mesh")
    scene = replace(LOOP, natural_curvature=natural_curvature)
    with pytest.raises(NotConvergedError, match="resistance to twist"):
        solve_scene(scene, tolerance=0.01)


def test_a_flat_wire_of_its_own_curvature_is_solved():
    answer = solve_scene(LoopScene(0.0, 0.0145, 0.3, natural_curvature=1.0))
    assert not answer.buckled


def test_a_round_loop_needs_no_twist():
    assert solve_scene(LOOP).equilibrium.scene.twist_ratio == 0


def _told(answer, term):
    return next(left for left in answer.omitted if left.term == term)


@pytest.mark.parametrize(("axis_ratio", "beta"), [(1.0, 0.0145), (1.0, 0.038), (1.5, 0.0225)])
def test_fabric_that_hardly_resists_bending_is_solved_without(axis_ratio, beta):
    bare = LoopScene(0.3, beta, 0.3, axis_ratio=axis_ratio)
    scene = replace(bare, alpha=1e-4)
    answer = solve_scene(scene)
    assert "fabric bending" not in answer.terms
    share = _told(answer, FABRIC_BENDING).value
    assert 0 < share < 3e-4
    assert answer.height_over_perimeter == solve_scene(bare).height_over_perimeter
    # the height changes by less than the share
    kept = replace(answer.equilibrium.scene, alpha=1e-4)
    heights = [
        solve_scene(s, fidelity=Fidelity.COMPACT, tolerance=1e-6).height_over_perimeter
        for s in (replace(kept, alpha=0.0), kept)
    ]
    assert abs(heights[1] / heights[0] - 1) < share


def test_fabric_whose_bending_matters_has_it():
    answer = solve_scene(replace(LOOP, alpha=0.1))
    assert answer.rung is Rung.COMPACT
    assert "fabric bending" in answer.terms
    assert "of what buckling releases" in answer.reason
    assert _told(answer, GAUSS).matters


def test_a_tolerance_decides_what_matters():
    coarse, fine = (solve_scene(replace(LOOP, alpha=1e-3), tolerance=t) for t in (1e-3, 1e-4))
    assert "fabric bending" not in coarse.terms
    assert "fabric bending" in fine.terms


def test_a_mesh_tells_the_share_of_slack_fabric():
    answer = solve_scene(LoopScene(0.3, 0.002, 0.3, alpha=1e-6), tolerance=1e-2)
    assert "fabric stretch (tension field)" in answer.terms
    assert 0 < _told(answer, FABRIC_BENDING).value < 1e-3


def test_the_law_refuses_fabric_that_resists_bending():
    with pytest.raises(SceneError, match="alpha = 0"):
        solve_scene(replace(LOOP, alpha=1e-4), fidelity=Fidelity.SCALING)


def test_a_flat_loop_has_no_bending():
    answer = solve_scene(LoopScene(0.1, 0.03, 0.3, axis_ratio=1.2, alpha=1.0))
    assert not answer.buckled
    assert _told(answer, FABRIC_BENDING).value == 0


def test_the_mesh_and_the_compact_rung_agree_on_twist_and_bending():
    scene = LoopScene(0.3, 0.0225, 0.3, axis_ratio=1.5, twist_ratio=0.75, alpha=1e-3)
    compact, mesh = (
        solve_scene(scene, fidelity=fidelity, tolerance=0.05)
        for fidelity in (Fidelity.COMPACT, Fidelity.MESH)
    )
    assert {"wire twist", "fabric bending"} <= set(compact.terms) & set(mesh.terms)
    exact = compact.height_over_perimeter
    assert mesh.height_over_perimeter == pytest.approx(exact, rel=2 * mesh.height_error)


def test_an_array_that_writhes_gets_the_wires_twist():
    loop = replace(LOOP, beta=0.0225, axis_ratio=1.5)
    scene = ArrayScene(loop, 1, 2, Between.KEPT)
    answer = solve_scene(scene, tolerance=0.05)
    without = solve_scene(scene, tolerance=0.05, fidelity=Fidelity.MESH)
    assert _told(without, TWIST).matters
    assert "wire twist" in answer.terms
    assert "twist was added" in answer.reason
