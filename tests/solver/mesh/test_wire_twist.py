"""Twist on a mesh: writhe, derivatives, and the compact solver's twisted ellipses."""

import numpy as np
import pytest

from solver.checks import TWIST, writhe
from solver.compact import solve_loop
from solver.errors import SceneError
from solver.mesh.array_mesh import Between
from solver.mesh.elements import Curvature
from solver.mesh.loop_mesh import loop_fan
from solver.mesh.mesh_energy import mesh_energy
from solver.mesh.omissions import mesh_omissions
from solver.mesh.rod_energy import WireStiffness
from solver.mesh.scene import ArrayScene
from solver.mesh.solve import solve_loop_mesh
from solver.mesh.triangulation import Mesh, Wire
from solver.mesh.wire_twist import TwistEnergy, twist_energies, twist_strays
from solver.scene import LoopScene

COUNT = 24


def _loops(noise=0.02):
    """Three loops that writhe, (3, COUNT, 3)."""
    theta = np.arange(COUNT) * (2 * np.pi / COUNT)
    loop = np.stack([1.5 * np.cos(theta), np.sin(theta), 0.4 * np.sin(2 * theta)], axis=1)
    return loop + np.random.default_rng(0).normal(0, noise, (3, COUNT, 3))


def _twist():
    return TwistEnergy(np.arange(3 * COUNT).reshape(3, COUNT), np.array([1.0, 2.0, 0.5]))


def test_writhe_is_that_of_the_polygon():
    loops = _loops()
    assert _twist().writhe(loops) == pytest.approx([writhe(loop) for loop in loops], abs=1e-12)
    mirrored = loops * [1, 1, -1]
    assert _twist().writhe(mirrored) == pytest.approx(-_twist().writhe(loops))


def test_attitude_changes_nothing():
    turn = np.linalg.qr(np.random.default_rng(4).normal(size=(3, 3)))[0]
    known = _twist().energies(_loops())
    assert _twist().energies(2 * _loops() @ turn + 1.0) == pytest.approx(known)


def test_derivatives_against_centred_differences():
    twist, loops, step = _twist(), _loops(), 1e-6
    direction = np.random.default_rng(1).normal(size=loops.shape)
    flat = direction.reshape(3, -1)
    ahead, behind = (
        twist.derivatives(loops + s * step * direction, Curvature.TRUE) for s in (1, -1)
    )
    value, gradient, hessian = twist.derivatives(loops, Curvature.TRUE)
    assert value == pytest.approx(twist.energies(loops))
    slope = (ahead[0] - behind[0]) / (2 * step)
    assert np.sum(gradient * flat, axis=1) == pytest.approx(slope, abs=1e-9)
    bent = (ahead[1] - behind[1]) / (2 * step)
    assert (hessian @ flat[:, :, None])[:, :, 0] == pytest.approx(bent, abs=1e-8)
    assert hessian == pytest.approx(np.swapaxes(hessian, 1, 2))


def test_convex_curvature_has_no_negative_eigenvalue():
    true, convex = (_twist().derivatives(_loops(), c) for c in (Curvature.TRUE, Curvature.CONVEX))
    assert np.linalg.eigvalsh(convex[2]).min() > -1e-12
    assert np.linalg.eigvalsh(true[2]).min() < -1e-3
    assert np.array_equal(convex[1], true[1])


def test_wires_of_different_counts_and_open_ones():
    loop = loop_fan()
    wires = (loop.wires[0], Wire(loop.wires[0].vertices[::2]), Wire(np.arange(5), closed=False))
    mesh = Mesh(loop.points, loop.triangles, loop.region, loop.rounds, wires, loop.parents)
    stiff = WireStiffness(0.1, 1000.0, 0.0, 0.75)
    families = twist_energies(mesh, (stiff,) * 3)
    assert [family.vertices.shape for family in families] == [(1, 10), (1, 20)]
    length = 20 * 2 * np.sin(np.pi / 20)
    assert families[1].stiffness == pytest.approx([4 * np.pi**2 * 0.1 * 0.75 / length])
    assert twist_energies(mesh, (WireStiffness(0.1, 1000.0),) * 3) == ()
    positions = np.random.default_rng(3).normal(0, 0.1, (len(loop.points), 3))
    positions[:, :2] += loop.points
    energy = mesh_energy({"wire twist": families}, len(loop.points))
    expected = sum(float(f.energies(positions[f.vertices]).sum()) for f in families)
    assert energy.terms(positions) == pytest.approx({"wire twist": expected})


@pytest.mark.parametrize("beta", [0.0225, 0.0145])
def test_the_compact_solver_agrees(beta):
    """Of the thicker wire the saddle between the axes is lower, of the thinner one the other."""
    scene = LoopScene(0.3, beta, 0.3, axis_ratio=1.5, twist_ratio=0.75)
    exact = solve_loop(scene, tolerance=1e-5)
    coarse, fine = (solve_loop_mesh(scene, refinement=k) for k in (2, 3))
    for quantity, limit in (
        ([f.energy for f in (coarse, fine)], exact.energy),
        ([f.height for f in (coarse, fine)], exact.shape.height),
    ):
        assert quantity[1] + (quantity[1] - quantity[0]) / 3 == pytest.approx(limit, rel=1e-3)
    twist = [f.energy_terms["wire twist"] for f in (coarse, fine)]
    limit = twist[1] + (twist[1] - twist[0]) / 3
    expected = exact.energy_terms.get("wire twist", 0.0)
    assert limit == pytest.approx(expected, rel=1e-3, abs=1e-12)
    assert fine.gradient_norm < 1e-7
    assert fine.lowest_eigenvalue > 0.01
    assert fine.steps < 100
    assert TWIST not in {left.term for left in mesh_omissions(fine)}


def test_what_is_left_out_is_the_compact_solvers_share():
    scene = LoopScene(0.3, 0.0225, 0.3, axis_ratio=1.5)
    shares = [
        next(left for left in omitted if left.term == TWIST)
        for omitted in (
            mesh_omissions(solve_loop_mesh(scene, refinement=3)),
            solve_loop(scene).omitted,
        )
    ]
    assert all(left.matters for left in shares)
    assert shares[0].measure == shares[1].measure
    assert shares[0].value == pytest.approx(shares[1].value, rel=0.03)


def test_a_writhe_that_strays_is_seen():
    """A wire that runs round twice: the tangent's area tells its writhe but for 2."""
    theta = np.arange(COUNT) * (4 * np.pi / COUNT)
    radius, rise = 1 + 0.2 * np.cos(theta / 2), 0.1 * np.sin(theta / 2)
    twice = np.stack([radius * np.cos(theta), radius * np.sin(theta), rise], axis=1)
    strayed = []
    for sign in (1, -1):
        loop = twice * [1, 1, sign]
        energy = TwistEnergy(np.arange(COUNT)[None], np.ones(1))
        strayed.append(twist_strays((energy,), loop))
    assert sorted(strayed) == [False, True]
    assert not twist_strays((_twist(),), _loops().reshape(-1, 3))


def test_wires_with_negative_twist_ratios_are_refused():
    wires = (WireStiffness(0.1, 1.0, 0.0, -0.5),)
    with pytest.raises(SceneError, match="twist_ratio"):
        ArrayScene(LoopScene(0.3, 0.0145, 0.3), 1, 1, Between.CUT, wires=wires)


def test_all_wires_of_an_array_are_twisted():
    wires = (WireStiffness(0.1, 1.0), WireStiffness(0.2, 1.0))
    scene = ArrayScene(LoopScene(0.3, 0.0145, 0.3), 1, 2, Between.KEPT, wires=wires)
    assert [wire.twist_ratio for wire in scene.twisted(0.75).stiffness] == [0.75, 0.75]
    assert [wire.beta for wire in scene.twisted(0.75).stiffness] == [0.1, 0.2]
