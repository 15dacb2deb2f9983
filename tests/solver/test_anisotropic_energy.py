"""Energies of ellipses, orthotropic fabric and naturally curved wires; the tabulated polynomial."""

from dataclasses import replace

import numpy as np
import pytest

from solver.batch import LoopBatch
from solver.disc_basis import disc_basis
from solver.disc_functions import DiscFunction
from solver.first_guess import inextensional_saddle
from solver.loop_energy import loop_energy, scene_membrane
from solver.membrane import Membrane
from solver.reading import Reading
from solver.rod import Rod
from solver.scene import LoopScene
from solver.shape import from_expansion
from solver.symmetry import ALIGNED, DIAGONAL

SCENES = [
    LoopScene(0.3, 0.0145, 0.3, axis_ratio=1.5),
    LoopScene(0.3, 0.0145, 0.3, modulus_ratio=1.4),
    LoopScene(0.3, 0.0145, 0.3, natural_curvature=0.7),
    LoopScene(
        0.5, 0.06, 0.4, Reading.PUBLISHED, 50.0, axis_ratio=3.0, modulus_ratio=0.8,
        natural_curvature=0.4,
    ),
]  # fmt: skip


def _shape(basis, seed=0, noise=0.02):
    q = from_expansion(basis.unknowns, inextensional_saddle(0.3, 1.0))
    return q + np.random.default_rng(seed).normal(0, noise, basis.size) / 3


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("space", ["saddle", ALIGNED, DIAGONAL, "oblique"])
def test_derivatives_against_centred_differences(scene, space):
    basis = disc_basis(5, space)
    energy = loop_energy(scene, basis)
    q = _shape(basis)
    direction = np.random.default_rng(1).normal(size=basis.size)
    step = 1e-6
    value, slope, hessian = energy.derivatives(q)
    ahead, behind = (energy.derivatives(q + sign * step * direction) for sign in (1, -1))
    scale = np.abs(hessian).max()
    assert value == pytest.approx(energy.value(q), rel=1e-12)
    assert (ahead[0] - behind[0]) / (2 * step) == pytest.approx(slope @ direction, rel=1e-5)
    difference = (ahead[1] - behind[1]) / (2 * step)
    assert difference == pytest.approx(hessian @ direction, abs=1e-7 * scale)


@pytest.mark.parametrize("degree", [5, 7, 9])
@pytest.mark.parametrize("scene", [LoopScene(0.3, 0.0145, 0.3), LoopScene(1.0, 0.1, -0.7)])
def test_the_polynomial_is_the_integral(scene, degree):
    energy = loop_energy(scene, disc_basis(degree, "saddle"))
    assert energy.polynomial is not None
    integrated = replace(energy, polynomial=None)
    q = _shape(energy.basis)
    for one, other in zip(energy.derivatives(q), integrated.derivatives(q), strict=True):
        assert one == pytest.approx(other, rel=1e-10, abs=1e-10)


def test_a_batch_is_its_members():
    scenes = [
        LoopScene(0.3, 0.0145, 0.3),
        LoopScene(0.5, 0.06, 0.45, Reading.PUBLISHED, axial_stiffness=50.0),
    ]
    basis = disc_basis(7, "saddle")
    q = np.stack([_shape(basis, seed) for seed in range(2)])
    batch = LoopBatch.of(scenes)
    together = batch.derivatives(basis, q)
    stress = batch.smallest_stress(basis, q)
    for i, scene in enumerate(scenes):
        alone = loop_energy(scene, basis).derivatives(q[i])
        membrane = scene_membrane(scene)
        principal = np.linalg.eigvalsh(
            membrane.stress(membrane.green_lagrange(basis.gradient @ q[i]))
        )
        assert stress[i] == pytest.approx(principal.min())
        for one, other in zip(together, alone, strict=True):
            assert one[i] == pytest.approx(other, rel=1e-9, abs=1e-9)


def test_orthotropic_stiffness_in_a_tension_test():
    """Stress along x, none across: the modulus is E1 when Poisson's coupling is taken out."""
    membrane = Membrane(0.0, 0.5, 0.0, moduli=(1.2, 0.8))
    along = np.array([[0.1, 0.0], [0.0, 0.0]])
    shear = np.array([[0.0, 0.1], [0.1, 0.0]])
    assert membrane.stress(along)[0, 0] == pytest.approx(1.2 * 0.1)
    assert membrane.stress(along[::-1, ::-1])[1, 1] == pytest.approx(0.8 * 0.1)
    assert membrane.stress(shear)[0, 1] == pytest.approx(0.1 * (1.2 * 0.8) ** 0.5)


def test_the_undeformed_ellipse_stretches_no_wire():
    scene = LoopScene(0.3, 0.0145, 0.3, axis_ratio=3.0)
    a, b = scene.semi_axes
    energy = loop_energy(scene, disc_basis(5, ALIGNED))
    laid = {(0, DiscFunction(1, 0, "cos")): a / 2, (1, DiscFunction(1, 0, "sin")): b / 2}
    terms = energy.terms(from_expansion(energy.basis.unknowns, laid))
    flat = 1.3**2 / 2 - 0.5
    density = flat**2 / (1 - 0.3)
    assert terms["wire stretch"] == pytest.approx(0, abs=1e-20)
    assert terms["fabric stretch"] == pytest.approx(density * np.pi * a * b / 1.3**2)


def test_a_circle_of_its_natural_curvature_does_not_bend():
    theta = np.linspace(0, 2 * np.pi, 20, endpoint=False)
    tangent = 0.5 * np.stack([-np.sin(theta), np.cos(theta), 0 * theta], axis=1)
    second = -0.5 * np.stack([np.cos(theta), np.sin(theta), 0 * theta], axis=1)
    arc = np.full(20, 2 * np.pi / 20)
    assert Rod(1.0, 1.0, 2.0).energies(tangent, second, arc)[0] == pytest.approx(0)
    assert Rod(1.0, 1.0, 1.0).energies(tangent, second, arc)[0] == pytest.approx(np.pi)
