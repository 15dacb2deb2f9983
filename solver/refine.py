"""Solve in one basis after the other until the height stands still.

The bases are nested, so that each solve starts from the one before it. The height's change from
basis to basis is the estimate of the error.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from solver.disc_basis import DiscBasis, Space, disc_basis, tangent_map, transfer
from solver.loop_energy import LoopEnergy, loop_energy
from solver.newton import Minimum, minimise
from solver.saddle_rows import crest_less_valley
from solver.scene import LoopScene
from solver.shape import LoopShape
from solver.stiff_newton import stiff_minimum

Vectors = NDArray[np.float64]

DEGREES = (5, 7, 9, 11, 13, 17, 21, 25)
"""Degrees of the successive bases: of the saddle's, 10 to 140 unknowns."""

_GRADIENT_TOLERANCE = 1e-8
_ROUGHLY = 1e-6
_SOFTER = 1e4
_MOST_STEPS = 120
_FIRST_BASIS_STEP = 0.01
"""Length of the last step in the first basis, which is never the last, over √tolerance.

What Newton's method lacks after a step goes with its square (some 5 times it, as measured), so that
this is less than a thousandth of the tolerance.
"""

_LARGE = 50
_MOST_STEPS_OF_LARGE = 20
"""Where a large basis does not follow from a smaller one at once, the shape has no smooth limit."""


@dataclass(frozen=True)
class Refined:
    """A stationary shape in the last of a sequence of nested bases, and what all of them took.

    ``height_change`` is relative; ``steps`` and ``factorizations`` are those of all bases.
    """

    space: Space
    energy: LoopEnergy
    minimum: Minimum
    height: float
    height_change: float
    steps: int
    factorizations: int

    @property
    def basis(self) -> DiscBasis:
        """The last basis."""
        return self.energy.basis

    @property
    def unknowns(self) -> Vectors:
        """Coefficients of the shape."""
        return self.minimum.unknowns

    def with_unknowns(self, q: Vectors, height: float) -> Refined:
        """Give the same with the coefficients of its mirror image."""
        return replace(self, minimum=replace(self.minimum, unknowns=q), height=height)


def gradient_tolerance(scene: LoopScene) -> float:
    """Smallest gradient that can be told from the rounding of the wire's stiff terms."""
    return max(_GRADIENT_TOLERANCE, 1e-11 * max(scene.beta, scene.axial_stiffness))


def height_of(space: Space, basis: DiscBasis, q: Vectors) -> float:
    """Height of a shape; negative for a saddle whose crests lie on the y axis."""
    if space == "saddle":
        return float(crest_less_valley(basis) @ q)
    return LoopShape(basis.unknowns, q).height


_CREDIBLE_TENSION = 2.0
"""In units of E_f t R; a coarse shape's stretch may give a stiff wire any tension beyond that."""


def settle(
    scene: LoopScene,
    energy: LoopEnergy,
    start: Vectors,
    solved: tuple[DiscBasis, Vectors] | None = None,
    *,
    roughly: float = 0.0,
) -> Minimum:
    """Find the minimum near a first guess: quickly if the guess is good, and safely if not.

    ``solved`` is what the guess was made of: a shape that was solved in another basis, or for a
    neighbouring scene. Its wire's tension is near to the one sought. That of the guess itself is
    not: what a basis lacks of a shape stretches a stiff wire by more than its tension does.
    ``roughly`` is how long the last step may be where the guess is good.
    """
    none = np.zeros_like(energy.basis.arc)
    tensions = [none]
    if solved is not None:
        tension = _tension_at(energy, *solved)
        if np.abs(tension).max() < _CREDIBLE_TENSION:
            tensions = [tension, none]
    for tension in tensions:
        found = stiff_minimum(energy, start, tension, roughly=roughly)
        if found is not None:
            return found
    most_steps = _MOST_STEPS if len(start) <= _LARGE else _MOST_STEPS_OF_LARGE
    if scene.axial_stiffness > _SOFTER:
        # the valley of a stiff wire is too narrow for steps of the energy: near it by a softer one
        softer = replace(energy, rod=replace(energy.rod, axial_stiffness=_SOFTER))
        rough = minimise(
            softer.derivatives, start, tolerance=_ROUGHLY, radius=0.1, most_steps=most_steps
        )
        found = stiff_minimum(energy, rough.unknowns, none)
        if found is not None:
            return found.after(rough)
    return minimise(
        energy.derivatives,
        start,
        tolerance=gradient_tolerance(scene),
        radius=0.1,
        most_steps=most_steps,
    )


def _tension_at(energy: LoopEnergy, basis: DiscBasis, q: Vectors) -> Vectors:
    """Tension (Q,) of a shape of any basis, at the points of the energy's own."""
    tangent = tangent_map(basis, energy.basis) @ q
    return energy.rod.force_ahead(tangent, np.zeros_like(tangent), energy.speed)


def carried(
    guess: tuple[DiscBasis, Vectors], last: tuple[DiscBasis, Vectors] | None, into: DiscBasis
) -> Vectors:
    """Coefficients (n,) of the last shape, which the first guess completes where it knew more."""
    out = transfer(guess[0], into) @ guess[1]
    if last is None:
        return out
    known = transfer(last[0], into)
    return out + known @ (last[1] - known.T @ out)


def refine(
    scene: LoopScene,
    space: Space,
    start: tuple[DiscBasis, Vectors],
    tolerance: float,
    degrees: Sequence[int] = DEGREES,
    *,
    solved: bool = False,
) -> Refined:
    """Solve in one basis after the other, at least two, until the height stands still.

    Parameters
    ----------
    start : DiscBasis and array (n,)
        A first guess in any space.
    tolerance : float
        Of the height's relative change.
    degrees : sequence of int
        Of the bases.
    solved : bool
        Whether the first guess is the solution of a neighbouring scene.
    """
    last: tuple[DiscBasis, Vectors] | None = None
    height = 0.0
    steps = factorizations = 0
    refined: list[Refined] = []
    for degree in degrees:
        energy = loop_energy(scene, disc_basis(degree, space))
        minimum = settle(
            scene,
            energy,
            carried(start, last, energy.basis),
            last or (start if solved else None),
            roughly=0.0 if refined else _FIRST_BASIS_STEP * math.sqrt(tolerance),
        )
        basis, q = last = energy.basis, minimum.unknowns
        steps += minimum.steps
        factorizations += minimum.factorizations
        before, height = height, height_of(space, basis, q)
        change = abs(height - before) / max(abs(height), 1e-300)
        refined.append(Refined(space, energy, minimum, height, change, steps, factorizations))
        if not minimum.converged or (len(refined) > 1 and change <= tolerance):
            break
    return refined[-1]
