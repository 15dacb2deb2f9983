"""Where a loop touches plates: the humps of its wire and their derivatives, by differences."""

import numpy as np
import pytest

from solver.disc_basis import disc_basis
from solver.edge_rows import edge_rows
from solver.plates import PlateAxis, Plates
from solver.shape import LoopShape
from solver.symmetry import ALIGNED
from solver.touching import plate_touches, reach

BASIS = disc_basis(7, ALIGNED)


def _disc(*bumps):
    """The flat disc, with coefficients of (component, m, k) added."""
    added = {(0, 1, 0): 0.5, (1, 1, 0): 0.5} | dict(bumps)
    return np.array(
        [added.get((t.component, t.function.m, t.function.k), 0.0) for (t,) in BASIS.unknowns]
    )


def _some_shape(seed=1):
    """The disc with smooth dents."""
    degree = np.array([unknown[0].function.degree for unknown in BASIS.unknowns])
    noise = np.random.default_rng(seed).normal(size=BASIS.size) * 0.4**degree
    return np.where(degree == 1, 0.5, noise)


@pytest.mark.parametrize("component", [0, 1, 2])
def test_rows_are_those_of_the_curve(component):
    q, theta = _some_shape(), np.linspace(0, 2 * np.pi, 7)
    curve = LoopShape(BASIS.unknowns, q).curve
    for order, rows in enumerate(edge_rows(BASIS, component).at(theta)):
        expected = curve.position(theta, order)[:, component]
        assert rows @ q == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(
    ("axis", "q", "moves"),
    [
        (PlateAxis.LATERAL, _some_shape(), False),
        (PlateAxis.LATERAL, _disc(((0, 3, 0), -0.06)), True),
        (PlateAxis.ACROSS, _disc(((1, 3, 0), 0.06)), True),
        (PlateAxis.HEIGHT, _disc(((2, 2, 0), 0.05), ((2, 4, 0), -0.05)), True),
    ],
)
def test_highest_points_and_their_derivatives(axis, q, moves):
    plates, step = Plates(1.0, axis), 1e-5
    side = 1.0
    edge = LoopShape(BASIS.unknowns, q).edge(20_000)[:, axis.component]
    assert reach(BASIS, axis.component, q) == pytest.approx(edge.max(), abs=1e-7)
    touches = plate_touches(BASIS, plates, q)
    wire = (touches.radii == 1) & (touches.sides == side)
    top = np.flatnonzero(wire)[np.argmax(touches.excess[wire])]
    assert touches.excess[top] == pytest.approx(edge.max() - 0.5, abs=1e-7)
    direction = np.random.default_rng(2).normal(size=BASIS.size) * 0.1
    at, ahead, behind = (
        reach(BASIS, axis.component, q + t * direction) for t in (0.0, step, -step)
    )
    assert (ahead - behind) / (2 * step) == pytest.approx(touches.rows[top] @ direction, rel=1e-6)
    force = np.zeros(len(touches.excess))
    force[top] = 1.0
    curvature = direction @ touches.curvature(force) @ direction
    assert (curvature > 0.1) == moves
    assert (ahead - 2 * at + behind) / step**2 == pytest.approx(curvature, rel=1e-3, abs=1e-5)


def test_a_dented_crest_touches_beside_the_axis():
    touches = plate_touches(BASIS, Plates(1.0), _disc(((0, 3, 0), -0.06)))
    assert 0.2 < touches.angles[np.argmax(touches.excess)] < 1.0


def test_fabric_is_watched_as_well():
    """A sheet that bulges beyond its edge."""
    touches = plate_touches(BASIS, Plates(0.5, PlateAxis.HEIGHT), _disc(((2, 0, 1), -0.5)))
    above = touches.sides > 0
    assert touches.radii[above][np.argmax(touches.excess[above])] < 0.5
    assert touches.excess[above].max() > 0.5
