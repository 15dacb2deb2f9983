"""One loop on a mesh: Surface Evolver's table, the compact solver, exact limits."""

import csv
from pathlib import Path

import numpy as np
import pytest

from solver.compact import solve_loop
from solver.errors import NotConvergedError, SceneError
from solver.mesh.solve import solve_loop_mesh
from solver.reading import Reading
from solver.scene import LoopScene
from solver.threshold import critical_beta

DATA = Path(__file__).parents[1] / "data"
ROWS = [
    row
    for name in ("evolver-circles.csv", "evolver-ellipses.csv")
    for row in csv.DictReader((DATA / name).read_text().splitlines())
    if float(row["compressed_fraction"]) == 0 and (row["k"] != "4" or row["strain"] == "0.3")
]
HEIGHT_TOLERANCE = {"1": 1e-2, "2": 5e-3, "3": 1e-3, "4": 2e-4}
SCENE = LoopScene(0.3, 0.0145, 0.3)


def _scene(row):
    return LoopScene(
        float(row["strain"]),
        float(row["beta"]),
        float(row["poisson"]),
        Reading(row["reading"]),
        axis_ratio=float(row["axis_ratio"]),
    )


def _name(row):
    keys = ("k", "strain", "beta", "poisson", "axis_ratio")
    return " ".join(row[key] for key in keys)


@pytest.mark.parametrize("row", [r for r in ROWS if r["branch"] == "minimum"], ids=_name)
def test_surface_evolver(row):
    """The same elements on the same mesh: the energy agrees to 6e-6 and better."""
    found = solve_loop_mesh(_scene(row), refinement=int(row["k"]))
    assert found.status == "converged"
    tolerance = 6e-5 if row["k"] == "1" else 6e-6
    assert found.energy == pytest.approx(float(row["energy"]), rel=tolerance)
    height = float(row["height_over_perimeter"])
    tolerance = HEIGHT_TOLERANCE[row["k"]]
    assert found.height_over_perimeter == pytest.approx(height, rel=tolerance, abs=1e-5)
    assert found.compressed_fraction == 0


@pytest.mark.parametrize(
    "row",
    [r for r in ROWS if r["branch"] == "axis-aligned" and r["k"] == "2"],
    ids=_name,
)
def test_an_ellipses_aligned_saddle_is_left(row):
    """A stationary point that is not a minimum: started there, the solve goes on."""
    scene = _scene(row)
    aligned = solve_loop_mesh(scene, refinement=2)
    start = aligned.positions.copy()
    x, y = aligned.mesh.points.T
    start[:, 2] = 0.4 * (x * x - y * y)
    found = solve_loop_mesh(scene, refinement=2, start=start)
    assert found.energy < float(row["energy"]) * 0.999
    assert found.energy == pytest.approx(aligned.energy, rel=1e-7)
    assert found.lowest_eigenvalue > 1e-3


def test_heights_converge_with_second_order_to_the_compact_limit():
    found = [solve_loop_mesh(SCENE, refinement=k) for k in (2, 3, 4)]
    exact = solve_loop(SCENE, tolerance=1e-6)
    for quantity, limit in (
        ([f.height_over_perimeter for f in found], exact.shape.height_over_perimeter),
        ([f.energy for f in found], exact.energy),
    ):
        changes = np.diff(quantity)
        assert np.log2(changes[0] / changes[1]) == pytest.approx(2, abs=0.1)
        richardson = quantity[-1] + changes[-1] / 3
        assert richardson == pytest.approx(limit, rel=1e-4)


def test_every_mesh_from_twenty_triangles_up_halves_its_edges_and_quarters_its_error():
    """Up to 81,920 triangles; the next one, of 327,680, is in benchmarks/ladder.md."""
    found = [solve_loop_mesh(SCENE, refinement=k) for k in range(7)]
    assert [len(f.mesh.triangles) for f in found] == [20 * 4**k for k in range(7)]
    assert all(f.status == "converged" for f in found)
    exact = solve_loop(SCENE, tolerance=1e-7)
    for numbers, limit in (
        ([f.height_over_perimeter for f in found], exact.shape.height_over_perimeter),
        ([f.energy for f in found], exact.energy),
    ):
        errors = np.abs(np.array(numbers) - limit)
        falls = errors[:-1] / errors[1:]
        assert falls[0] > 3
        assert falls[1:] == pytest.approx(4, rel=0.07)
    assert found[-1].height_over_perimeter == pytest.approx(
        exact.shape.height_over_perimeter, rel=3e-5
    )


@pytest.mark.parametrize(
    "scene",
    [
        LoopScene(0.3, 0.0145, 0.3),
        LoopScene(0.2, 0.005, 0.3),
        LoopScene(0.3, 0.06, 0.45, Reading.PUBLISHED),
        LoopScene(0.3, 0.02, 0.3, natural_curvature=0.6),
        LoopScene(0.3, 0.0145, 0.3, axis_ratio=1.5),
        LoopScene(0.3, 0.02, 0.3, axis_ratio=2),
        LoopScene(0.3, 0.025, 0.3, axis_ratio=2),
        LoopScene(0.3, 0.0225, 0.3, axis_ratio=3),
        LoopScene(0.3, 0.0145, 0.3, modulus_ratio=1.3),
    ],
)
def test_the_compact_solver_agrees(scene):
    """With the limits that two meshes tell."""
    coarse, fine = (solve_loop_mesh(scene, refinement=k) for k in (3, 4))
    exact = solve_loop(scene, tolerance=1e-4)
    limit = fine.energy + (fine.energy - coarse.energy) / 3
    assert limit == pytest.approx(exact.energy, rel=1e-4)
    height = fine.height_over_perimeter
    height += (height - coarse.height_over_perimeter) / 3
    assert height == pytest.approx(exact.shape.height_over_perimeter, rel=1e-3)


@pytest.mark.parametrize(("refinement", "ratio"), [(1, 0.9410), (2, 0.9851), (3, 0.9963)])
def test_flat_state_threshold_of_each_mesh(refinement, ratio):
    beta = ratio * critical_beta(0.3, 0.3, Reading.PLANE_STRESS)
    heights = [
        solve_loop_mesh(
            LoopScene(0.3, factor * beta, 0.3, axial_stiffness=1e6), refinement=refinement
        ).height
        for factor in (0.999, 1.001)
    ]
    assert heights[0] > 0.02
    assert heights[1] < 1e-3


def test_a_neighbouring_scene_takes_few_steps():
    near = solve_loop_mesh(LoopScene(0.3, 0.015, 0.3), refinement=2)
    cold = solve_loop_mesh(SCENE, refinement=2)
    warm = solve_loop_mesh(SCENE, refinement=2, start=near.positions)
    assert warm.energy == pytest.approx(cold.energy, rel=1e-9)
    assert warm.steps < cold.steps / 2


def test_twenty_random_starts_give_one_shape():
    known = solve_loop_mesh(SCENE, refinement=1)
    rng = np.random.default_rng(11)
    for _ in range(20):
        x, y = known.mesh.points.T
        start = np.stack([x, y, 0 * x], axis=1)
        lifts = np.stack([x * x - y * y, 2 * x * y, x, y, x**3 - 3 * x * y * y])
        start[:, 2] = rng.normal(0, 0.3, 5) @ lifts
        start += rng.normal(0, 0.01, start.shape)
        found = solve_loop_mesh(SCENE, refinement=1, start=start)
        assert found.energy == pytest.approx(known.energy, rel=1e-5)
        assert found.height == pytest.approx(known.height, rel=5e-3)


def test_turned_starts_give_turned_shapes():
    known = solve_loop_mesh(SCENE, refinement=1)
    turn = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))[0]
    found = solve_loop_mesh(SCENE, refinement=1, start=known.positions @ turn + 1.0)
    assert found.steps <= 1
    assert found.energy == pytest.approx(known.energy, rel=1e-12)
    assert found.height == pytest.approx(known.height, rel=1e-9)


def test_the_account_of_a_solve():
    found = solve_loop_mesh(SCENE, refinement=2)
    assert set(found.energy_terms) == {"fabric stretch", "wire bending", "wire stretch"}
    assert found.unknowns == 603
    assert found.gradient_norm < 1e-5
    assert found.coarser_height == pytest.approx(found.height, rel=0.03)
    assert found.smallest_stress > 0


@pytest.mark.parametrize("beta", [0.0145, 0.038, 0.05])
def test_the_lowest_eigenvalue_is_that_of_the_smooth_basis(beta):
    """The turn of the fabric under a saddle costs nothing, and is left out; beta = 0.05 is flat."""
    scene = LoopScene(0.3, beta, 0.3)
    exact = solve_loop(scene).lowest_eigenvalue
    found = [solve_loop_mesh(scene, refinement=k).lowest_eigenvalue for k in (2, 3)]
    assert found[1] == pytest.approx(exact, rel=0.07)
    assert abs(found[1] - exact) < 0.6 * abs(found[0] - exact)


def test_a_refusal_names_the_limit_and_the_scene():
    slack = LoopScene(0.5, 0.0002, 0.3)
    refusals = [
        solve_loop_mesh(
            scene, refinement=1, most_steps=1, tension_field=field, allow_unreliable=True
        ).status
        for scene, field in ((slack, False), (slack, True), (SCENE, False))
    ]
    for refusal, (strain, beta) in zip(
        refusals, ((0.5, 0.0002), (0.5, 0.0002), (SCENE.strain, SCENE.beta)), strict=True
    ):
        assert "after 1 steps of at most 1:" in refusal
        assert f"at beta = {beta:g} and strain = {strain:g}" in refusal
    assert "wrinkles at the mesh's scale" in refusals[0]
    assert "slack fabric is next to free to move" in refusals[1]
    assert "slack" not in refusals[2]


def test_not_converged_raises_with_a_remedy():
    scene = LoopScene(0.5, 0.0002, 0.3)
    with pytest.raises(NotConvergedError, match="raise beta or lower strain"):
        solve_loop_mesh(scene, refinement=1, most_steps=5)
    lenient = solve_loop_mesh(scene, refinement=1, most_steps=5, allow_unreliable=True)
    assert lenient.status.startswith("not converged")


def test_refinement_is_limited():
    with pytest.raises(SceneError, match="refinement"):
        solve_loop_mesh(SCENE, refinement=8)


@pytest.mark.parametrize("start", [np.zeros((20, 3)), np.full((201, 3), np.nan)])
def test_starts_of_another_mesh_are_refused(start):
    with pytest.raises(SceneError, match="start"):
        solve_loop_mesh(SCENE, refinement=2, start=start)
