"""Where a solve of the saddle starts: at the best of a family of saddles solved once before.

The shape of a saddle is mostly told by its height. So a family of increasing height, solved for one
fabric, passes near every scene's saddle; which member is nearest is told by their energies, and
these take one small product, for energies are linear in what makes a scene.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from solver.disc_basis import DiscBasis, disc_basis
from solver.disc_functions import DiscFunction
from solver.errors import NotConvergedError
from solver.flat import flat_radius, flat_shape
from solver.loop_energy import loop_energy
from solver.newton import Minimum, minimise
from solver.quartic import shape_table
from solver.reading import Reading, density_coefficients
from solver.saddle_rows import crest_less_valley
from solver.scene import LoopScene
from solver.shape import Expansion, from_expansion
from solver.stiff_newton import stiff_minimum
from solver.threshold import critical_beta

Vectors = NDArray[np.float64]

GUESS_DEGREE = 5
"""Of the family's shapes."""

_MEMBERS = 24
_FABRIC = (0.5, 0.3, Reading.PLANE_STRESS)
_LOWEST_BETA = 0.08
"""Of the family's last member, over the β at which the flat state buckles."""
_STIFF = 1e6
"""Axial stiffness: near the threshold even a little stretch would hide what the height changes."""

_LEAST_HEIGHT = 1e-3
"""Of a first guess, in units of R: Newton's steps never leave a guess that is flat."""

_START_HEIGHT = 0.25
_SOFT_WIRE = 30.0
_ROUGHLY = 1e-2


def inextensional_saddle(height: float, radius: float) -> Expansion:
    """Saddle of amplitude ``height`` whose edge keeps its length to second order.

    With z = c cos 2θ on the edge, a uniform contraction c² and a slip ¼ c² sin 4θ along the edge
    make up for the slope's lengthening 2 c² sin² 2θ.
    """
    edge = {1: radius - height**2, 3: -(height**2) / 8, 5: height**2 / 8}
    out: Expansion = {}
    for m, value in edge.items():
        along_x, along_y = DiscFunction(m, 0, "cos"), DiscFunction(m, 0, "sin")
        out[0, along_x] = value / along_x.edge_value
        out[1, along_y] = (value if m % 4 == 1 else -value) / along_y.edge_value
    rise = DiscFunction(2, 0, "cos")
    out[2, rise] = height / rise.edge_value
    return out


def soft_start(scene: LoopScene, basis: DiscBasis) -> Minimum:
    """Minimise roughly with a wire that may stretch a little.

    The curved valley along which a stiff wire keeps its length takes many steps to follow; across a
    soft one the way is short, and Newton's steps do the rest.
    """
    soft = replace(scene, axial_stiffness=min(scene.axial_stiffness, _SOFT_WIRE))
    start = inextensional_saddle(_START_HEIGHT, flat_radius(scene))
    return minimise(
        loop_energy(soft, basis).derivatives,
        from_expansion(basis.unknowns, start),
        tolerance=_ROUGHLY,
        radius=0.5,
    )


@dataclass(frozen=True, eq=False)
class SaddleFamily:
    """Saddles of increasing height.

    Attributes
    ----------
    coefficients : array (N, n)
    integrals : array (N, 6)
        ∫ Tr C² dA, ∫ (Tr C)² dA, ∫ Tr C dA, ∮ κ² dl, ∮ κ dl and ∮ dl of each.
    heights : array (N,)
        From 0 upwards.
    rising : array of bool (n,)
        Which unknowns move z.
    """

    coefficients: Vectors
    integrals: Vectors
    heights: Vectors
    rising: NDArray[np.bool_]

    def nearest(self, weights: Vectors) -> Vectors:
        """Coefficients (…, n) where the energy is least, between the members; weights (…, 6).

        A parabola in the square of the height, through the lowest member and its neighbours, tells
        where. Between members z goes with the height, x and y go with its square.
        """
        energy, square = weights @ self.integrals.T, self.heights**2
        middle = np.asarray(np.clip(np.argmin(energy, axis=-1), 1, len(square) - 2))
        first, at, last = (
            np.take_along_axis(energy, (middle + k)[..., None], -1)[..., 0] for k in (-1, 0, 1)
        )
        before = square[middle] - square[middle - 1]
        after = square[middle + 1] - square[middle]
        left, right = (at - first) / before, (last - at) / after
        bend = np.maximum((right - left) / (before + after), 1e-300)
        lowest = square[middle] - (left * after + right * before) / (2 * bend * (before + after))
        place = np.clip(lowest, _LEAST_HEIGHT**2, square[-1])
        low = np.clip(np.searchsorted(square, place, side="right") - 1, 0, len(square) - 2)
        by_height = (np.sqrt(place) - self.heights[low]) / np.diff(self.heights)[low]
        by_square = (place - square[low]) / np.diff(square)[low]
        part = np.where(self.rising, by_height[..., None], by_square[..., None])
        return (1 - part) * self.coefficients[low] + part * self.coefficients[low + 1]


def energy_weights(
    strain: float | Vectors,
    a: float | Vectors,
    b: float | Vectors,
    beta: float | Vectors,
    k0: float,
) -> Vectors:
    """Weights (…, 6) of the integrals of `SaddleFamily` in the energy, less a constant."""
    square = (1 + strain) ** 2 / 4
    listed = (square * a, square * b, -(a / 2 + b), beta, -2 * k0 * beta, k0**2 * beta)
    return np.stack(np.broadcast_arrays(*listed), axis=-1)


def scene_weights(scene: LoopScene) -> Vectors:
    """Weights (6,) of the integrals of `SaddleFamily` in a scene's energy."""
    a, b = density_coefficients(scene.poisson, scene.reading)
    return energy_weights(scene.strain, a, b, scene.beta, scene.natural_curvature)


def _integrals(basis: DiscBasis, q: Vectors) -> list[float]:
    table = shape_table(basis)
    one, none = np.ones(1), np.zeros(1)
    shear, swell = (q @ table.applied(q, *weights) @ q for weights in ((one, none), (none, one)))
    edge = basis.edge @ q
    bend = np.linalg.norm(np.cross(edge[:, :3], edge[:, 3:]), axis=1)
    speed = np.linalg.norm(edge[:, :3], axis=1)
    return [
        float(shear),
        float(swell),
        float(q @ table.metric @ q),
        float(basis.arc @ (bend**2 / speed**5)),
        float(basis.arc @ (bend / speed**2)),
        float(basis.arc @ speed),
    ]


@lru_cache(maxsize=1)
def saddle_family() -> SaddleFamily:
    """Solve the family; each member starts from the one before."""
    strain, poisson, reading = _FABRIC
    basis = disc_basis(GUESS_DEGREE, "saddle")
    critical = critical_beta(strain, poisson, reading)
    # the height grows with the square root of what β lacks, so that these are about equal steps
    lack = np.linspace(1.0, 0.0, _MEMBERS + 1)[:-1] ** 2 * (1 - _LOWEST_BETA)
    scenes = [
        LoopScene(strain, float(critical * (1 - part)), poisson, reading, _STIFF) for part in lack
    ]
    q = minimise(
        loop_energy(replace(scenes[0], axial_stiffness=1000.0), basis).derivatives,
        soft_start(scenes[0], basis).unknowns,
        tolerance=1e-8,
        radius=0.1,
    ).unknowns
    members: list[Vectors] = []
    for scene in scenes:
        found = stiff_minimum(loop_energy(scene, basis), q, np.zeros(len(basis.arc)))
        if found is None:
            raise NotConvergedError("the family of first guesses was not solved")
        q = found.unknowns
        members.insert(0, q)
    coefficients = np.array([flat_shape(scenes[-1], GUESS_DEGREE).coefficients, *members])
    rising = np.array([unknown[0].component == 2 for unknown in basis.unknowns])
    return SaddleFamily(
        coefficients,
        np.array([_integrals(basis, member) for member in coefficients]),
        coefficients @ crest_less_valley(basis),
        rising,
    )
