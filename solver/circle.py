"""The stationary shape of a circular loop on isotropic fabric: flat, or the saddle."""

from __future__ import annotations

import math

import numpy as np

from solver.disc_basis import disc_basis
from solver.equilibrium import Equilibrium, Kind
from solver.first_guess import GUESS_DEGREE, saddle_family, scene_weights
from solver.flat import flat_shape, rising_stiffness
from solver.loop_energy import loop_energy
from solver.newton import Minimum
from solver.refine import DEGREES, Refined, refine
from solver.scene import LoopScene
from solver.threshold import line_tension

_FLATNESS = 1e-9
_WAVES = np.arange(2.0, 40.0)


def stays_flat(scene: LoopScene) -> bool:
    """Whether the flat loop resists every motion out of its plane.

    The fabric's bending adds nothing here: the motions that decide are harmonic, and have no mean
    curvature to first order.
    """
    floor = -_FLATNESS * max(1.0, scene.beta)
    return bool(rising_stiffness(scene, _WAVES).min() >= floor)


def flat_circle(scene: LoopScene) -> Refined:
    """Give the flat state, which is known in closed form."""
    basis = disc_basis(GUESS_DEGREE, "saddle")
    energy = loop_energy(scene, basis)
    q = flat_shape(scene, GUESS_DEGREE).coefficients
    value, slope, hessian = energy.derivatives(q)
    minimum = Minimum(q, value, float(np.linalg.norm(slope)), hessian, 0, 0, True)
    return Refined("saddle", energy, minimum, 0.0, 0.0, 0, 0)


def _upright(refined: Refined) -> Refined:
    """Mirror the saddle in z = 0, if need be, so that its crests lie on the x axis."""
    if refined.height >= 0:
        return refined
    basis = refined.basis
    sign = np.array([-1.0 if unknown[0].component == 2 else 1.0 for unknown in basis.unknowns])
    return refined.with_unknowns(sign * refined.unknowns, -refined.height)


def saddle_circle(
    scene: LoopScene,
    tolerance: float,
    start: Equilibrium | None,
    highest_degree: int = DEGREES[-1],
) -> Refined:
    """Solve for the saddle, from a neighbouring one if there is one."""
    degrees = tuple(degree for degree in DEGREES if degree <= highest_degree)
    if start is not None and start.kind is Kind.SADDLE:
        guess = disc_basis(start.degree, "saddle"), start.shape.coefficients
        first = max(0, min(DEGREES.index(start.degree), len(degrees) - 1) - 1)
        refined = refine(scene, "saddle", guess, tolerance, degrees[first:], solved=True)
        return _upright(refined)
    guess = saddle_family().nearest(scene_weights(scene))
    first_guess = disc_basis(GUESS_DEGREE, "saddle"), guess
    return _upright(refine(scene, "saddle", first_guess, tolerance, degrees))


def telling_degree(scene: LoopScene, stress: float, degree: int) -> int:
    """Degree of the motions among which a saddle's stability is decided.

    Where fabric is in tension everywhere it resists every motion, and only the wire can give way:
    not with more than n waves, n (n + 1) = T/2β, which even the flat loop would resist, although
    all of the fabric's tension T presses its wire. Where fabric is slack, or resists bending,
    motions of all degrees count that the shape's own basis holds.
    """
    if stress <= 0 or scene.alpha > 0:
        return degree + 1
    resistance = 2 * scene.beta * max(1 - scene.natural_curvature, 1e-9)
    tension = line_tension(scene.strain, scene.poisson, scene.reading)
    waves = math.ceil(math.sqrt(tension / resistance))
    return min(degree + 1, max(GUESS_DEGREE + 1, waves))
