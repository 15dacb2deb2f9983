"""Derivatives of every energy term, and what must not change it."""

import numpy as np
import pytest

from solver.disc_basis import disc_basis
from solver.loop_energy import loop_energy
from solver.membrane import Membrane
from solver.reading import Reading
from solver.rod import Rod
from solver.scene import LoopScene

SPACES = ["saddle", (0, 0), (1, 0), (1, 1)]
SCENES = [
    LoopScene(0.3, 0.0145, 0.3),
    LoopScene(0.5, 0.06, 0.45, Reading.PUBLISHED),
    LoopScene(0.2, 0.01, -0.5, axial_stiffness=50.0),
]


def _deformation(rng, basis):
    """A shape well away from flat: the disc, plus noise."""
    points, edge = len(basis.area), len(basis.arc)
    gradient = np.zeros((points, 3, 2))
    gradient[:, 0, 0] = gradient[:, 1, 1] = 1
    gradient += rng.normal(0, 0.2, (points, 3, 2))
    tangent = np.array([0.3, 0.9, 0.2]) + rng.normal(0, 0.2, (edge, 3))
    return gradient, tangent, rng.normal(0, 1, (edge, 3))


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("space", SPACES)
def test_derivatives_against_centred_differences(scene, space):
    rng = np.random.default_rng(3)
    basis = disc_basis(5, space)
    energy = loop_energy(scene, basis)
    gradient, tangent, second = _deformation(rng, basis)
    direction = rng.normal(0, 1, basis.size)

    def at(step):
        q = step * direction
        return energy.derivatives_around(
            gradient + basis.gradient @ q, tangent + basis.tangent @ q, second + basis.second @ q
        )

    step = 1e-6
    _, slope, hessian = at(0.0)
    ahead, behind = at(step), at(-step)
    scale = np.abs(slope).max() + 1
    assert (ahead[0] - behind[0]) / (2 * step) == pytest.approx(slope @ direction, rel=1e-6)
    difference = (ahead[1] - behind[1]) / (2 * step)
    assert difference == pytest.approx(hessian @ direction, rel=1e-5, abs=1e-5 * scale)
    assert hessian == pytest.approx(hessian.T)


def test_membrane_and_rod_know_no_rotation():
    rng = np.random.default_rng(4)
    rotation = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    gradient, area = rng.normal(size=(9, 3, 2)), rng.uniform(size=9)
    tangent, second = rng.normal(size=(2, 9, 3))
    membrane, rod = Membrane(0.3, 0.4, 0.2), Rod(0.1, 10.0)
    turned = np.einsum("ab,pbj->paj", rotation, gradient)
    assert membrane.energy(turned, area) == pytest.approx(membrane.energy(gradient, area))
    turned_rod = rod.energies(tangent @ rotation.T, second @ rotation.T, area)
    assert turned_rod == pytest.approx(rod.energies(tangent, second, area))


def test_the_unstretched_disc_has_no_energy():
    membrane = Membrane(0.3, 0.4, 0.2)
    gradient = np.zeros((1, 3, 2))
    gradient[0, :2] = np.eye(2) / 1.3
    assert membrane.energy(gradient, np.ones(1)) == pytest.approx(0, abs=1e-15)


def test_bending_energy_of_a_circle():
    theta = np.linspace(0, 2 * np.pi, 20, endpoint=False)
    radius = 0.7  # a wire shortened to 0.7 of its length
    tangent = radius * np.stack([-np.sin(theta), np.cos(theta), 0 * theta], axis=1)
    second = -radius * np.stack([np.cos(theta), np.sin(theta), 0 * theta], axis=1)
    bending, stretch = Rod(0.2, 5.0).energies(tangent, second, np.full(20, 2 * np.pi / 20))
    assert bending == pytest.approx(0.2 * 2 * np.pi / radius)
    assert stretch == pytest.approx(5.0 / 2 * 2 * np.pi * 0.3**2)


@pytest.mark.parametrize("space", SPACES)
def test_membrane_integrals_are_exact(space):
    """Twice as many points change nothing for the flat disc plus a polynomial."""
    fine, coarse = disc_basis(11, space), disc_basis(5, space)
    position = {unknown: k for k, unknown in enumerate(fine.unknowns)}
    rng = np.random.default_rng(5)
    q = rng.normal(0, 0.1, coarse.size)
    q_fine = np.zeros(fine.size)
    q_fine[[position[unknown] for unknown in coarse.unknowns]] = q
    membrane = Membrane(0.3, 0.4, 0.2)
    assert membrane.energy(coarse.gradient @ q, coarse.area) == pytest.approx(
        membrane.energy(fine.gradient @ q_fine, fine.area), rel=1e-12
    )
