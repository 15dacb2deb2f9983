"""What holds for every answer whatever solved it, worked out without the solver."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from solver.mesh.equilibrium import MeshEquilibrium
from solver.threshold import line_tension

LIMIT = re.compile(r"beta|strain|tolerance|axial_stiffness|axis_ratio|poisson|must be from")
"""A refusal names what to change, or the range that a number must keep."""

_POLYGON = 2e-3
"""Energy and length of a polygon of 80 edges differ from those of its circle by less."""


class Facts:
    """Checks of answers for single loops."""

    @staticmethod
    def names_a_limit(refusal):
        assert LIMIT.search(str(refusal)), refusal
        assert "nan" not in str(refusal).lower()

    @staticmethod
    def flat_energy(scene):
        """Energy of the loop as it was sewn, flat and with its wire unstretched."""
        e = ((1 + scene.strain) ** 2 - 1) / 2
        c, m = (2, 1) if scene.reading == "plane-stress" else (1, 2)
        a = 1 / (c * (1 + scene.poisson))
        b = a * scene.poisson / (1 - m * scene.poisson)
        r, n = scene.modulus_ratio, 4096
        mixed = 2 * math.sqrt(r) / (1 + r)
        half, angle = scene.semi_axes, np.arange(n) * 2 * np.pi / n
        speed = np.hypot(half[0] * np.sin(angle), half[1] * np.cos(angle))
        own = scene.natural_curvature
        bending = np.mean((half[0] * half[1] / speed**3 - own) ** 2 * speed) * 2 * np.pi
        fabric = 2 * (a + b + b * mixed) * e**2 * half[0] * half[1] / (1 + scene.strain) ** 2
        return math.pi * fabric + scene.beta * bending

    @classmethod
    def hold(cls, scene, answer):
        """Finite, no higher than a wire allows, and no worse than to stay flat."""
        found = answer.equilibrium
        assert math.isfinite(answer.height_over_perimeter)
        assert 0 <= answer.height_over_perimeter < 0.25 * (1 + _POLYGON) + _softness(scene)
        assert answer.height_error >= 0
        assert (answer.height_over_perimeter > 1e-6) == answer.buckled
        if found is None:
            return
        assert found.status == "converged"
        assert all(math.isfinite(value) for value in found.energy_terms.values())
        assert all(math.isfinite(left.value) for left in answer.omitted)
        wire, length = _wire(found)
        assert np.isfinite(wire).all()
        assert length == pytest.approx(2 * math.pi, rel=_POLYGON + _softness(scene))
        flat = cls.flat_energy(scene)
        assert found.energy <= flat * (1 + _POLYGON)
        if scene.natural_curvature == 0:  # a closed curve turns by a full turn at least
            least = 4 * math.pi**2 * scene.beta / length
            assert found.energy_terms["wire bending"] >= least * (1 - _POLYGON)
        if not answer.buckled and scene.axis_ratio == 1 and scene.modulus_ratio == 1:
            assert found.energy == pytest.approx(flat, rel=_POLYGON + _softness(scene))

    @classmethod
    def hold_in_array(cls, scene, answer):
        """Finite, free of itself, wires as long as they were, no worse than to stay flat."""
        found, loop = answer.equilibrium, scene.loop
        assert math.isfinite(answer.height_over_perimeter)
        assert found.status == "converged"
        assert np.isfinite(found.positions).all()
        assert found.distances.crossings == 0
        for wire in found.mesh.wires:
            chain = found.positions[wire.vertices]
            assert _length(chain) == pytest.approx(2 * math.pi, rel=10 * _POLYGON + _softness(loop))
        flat = scene.rows * scene.columns * cls.flat_energy(loop)
        if scene.gaps_kept:
            bare = replace(loop, beta=1e-300, axial_stiffness=1.0)
            gaps = (scene.rows - 1) * (scene.columns - 1)
            flat += gaps * (4 / math.pi - 1) * cls.flat_energy(bare)
        assert found.energy <= flat * (1 + 10 * _POLYGON)

    @staticmethod
    def flat_when_it_must_be(scene, answer):
        """T = 12 β parts flat circles from others, at every α; a soft wire blurs it."""
        tension = line_tension(scene.strain, scene.poisson, scene.reading)
        beyond, blur = tension / (12 * scene.beta) - 1, 2 * _softness(scene)
        if beyond < -blur:
            assert not answer.buckled
        if beyond > blur:
            assert answer.buckled


def _softness(scene):
    """Several times what the wire may stretch."""
    tension = line_tension(scene.strain, scene.poisson, scene.reading)
    return 4 * (tension + 12 * scene.beta) / scene.axial_stiffness


def _wire(found):
    if isinstance(found, MeshEquilibrium):
        chain = found.positions[found.mesh.wires[0].vertices]
    else:
        chain = found.shape.edge(512)
    return chain, _length(chain)


def _length(chain):
    steps = np.diff(chain, axis=0, append=chain[:1])
    return float(np.linalg.norm(steps, axis=1).sum())


@pytest.fixture(scope="session")
def facts():
    return Facts
