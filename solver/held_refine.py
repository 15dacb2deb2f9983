"""Solve a held loop in one basis after the other until force and height stand still."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from solver.contact_newton import HeldMinimum, held_minimum
from solver.disc_basis import DiscBasis, disc_basis, transfer
from solver.errors import NotConvergedError
from solver.flat import flat_shape
from solver.held_start import pressed, touches_of
from solver.loop_energy import LoopEnergy, loop_energy
from solver.newton import Minimum
from solver.plates import Contact, Pitch, Plates
from solver.scene import LoopScene
from solver.shape import from_expansion
from solver.stiff_newton import tension_of
from solver.symmetry import ALIGNED
from solver.touching import Touches, reach

Vectors = NDArray[np.float64]

HELD_DEGREES = (5, 7, 9, 11, 13, 17, 21)
"""Degrees of the successive bases, 22 to 210 unknowns."""

_NEAR_ENOUGH = 1e-2
"""Length of the step from which the touching points themselves are followed."""

_CLEAR_BEND = 0.05
"""Wire that leaves the plate less quickly lies nearly along it: its touching points jump."""

_CREDIBLE_TENSION = 5.0
_SMALL_FORCE = 0.01
"""In units of E_f t R; a force's change is taken relative to no less."""

_SMALL_HEIGHT = 0.01


@dataclass(frozen=True, eq=False)
class HeldSolved:
    """A held minimum in the last of a sequence of bases; ``change`` is that from the one before."""

    hold: Plates | Pitch
    energy: LoopEnergy
    found: HeldMinimum
    change: float = 0.0

    @property
    def basis(self) -> DiscBasis:
        """The last basis."""
        return self.energy.basis

    @property
    def unknowns(self) -> Vectors:
        """Coefficients of the shape."""
        return self.found.minimum.unknowns

    @property
    def contacts(self) -> tuple[Contact, ...]:
        """What touches, with the Lagrangian's forces: those of mirror images together."""
        return self.found.touches.contacts(self.found.force)

    @property
    def force(self) -> float:
        """−dU/dg: plates, and bonded crests, are at half the gap from the middle."""
        pushes = self.found.force
        return float((pushes if isinstance(self.hold, Plates) else pushes[:1]).sum()) / 2

    @property
    def height(self) -> float:
        """Extent of the wire along z."""
        return sum(reach(self.basis, 2, self.unknowns, side) for side in (1.0, -1.0))

    def changed(self, before: HeldSolved) -> float:
        """Relative change of force or height from another basis, the larger."""
        force = abs(self.force - before.force) / max(abs(self.force), _SMALL_FORCE)
        height = abs(self.height - before.height) / max(self.height, _SMALL_HEIGHT)
        return max(force, height)


def flat_between(scene: LoopScene, hold: Plates) -> HeldSolved:
    """Give the flat loop, which is known in closed form, and touches nothing."""
    energy = loop_energy(scene, disc_basis(HELD_DEGREES[0], ALIGNED))
    n = energy.basis.size
    flat = flat_shape(scene, HELD_DEGREES[0])
    q = from_expansion(energy.basis.unknowns, flat.expansion)
    value, slope, hessian = energy.derivatives(q)
    minimum = Minimum(q, value, float(np.linalg.norm(slope)), hessian, 0, 0, True)
    none = np.zeros(0)
    touches = Touches(none, np.zeros((0, n)), np.zeros((0, n)), none, none, none, none)
    return HeldSolved(hold, energy, HeldMinimum(minimum, tension_of(energy, q), touches, none))


def _tries(
    energy: LoopEnergy, hold: Plates | Pitch, start: Vectors, known: Sequence[Contact]
) -> Iterator[HeldMinimum | None]:
    """Ways to the minimum near a shape, the quickest first."""
    tension = tension_of(energy, start)
    if np.abs(tension).max() > _CREDIBLE_TENSION:
        tension = np.zeros_like(tension)

    def exactly(q: Vectors, force: Vectors, contacts: Sequence[Contact]) -> HeldMinimum | None:
        return held_minimum(
            energy,
            q,
            lambda at: touches_of(energy.basis, hold, at),
            tension=force,
            before=contacts,
            unilateral=isinstance(hold, Plates),
        )

    def by_samples(roughly: float) -> HeldMinimum | None:
        return held_minimum(
            energy,
            start,
            lambda at: touches_of(energy.basis, hold, at, sampled=True),
            tension=tension,
            before=known,
            roughly=roughly,
        )

    if isinstance(hold, Pitch) or (known and min(c.bend for c in known) > _CLEAR_BEND):
        yield exactly(start, tension, known)
    if isinstance(hold, Pitch):
        return
    rough = by_samples(_NEAR_ENOUGH)
    if rough is not None:
        contacts = rough.touches.contacts(rough.force)
        found = exactly(rough.minimum.unknowns, rough.tension, contacts)
        yield found and replace(found, minimum=found.minimum.after(rough.minimum))
    yield exactly(start, tension, known)
    yield by_samples(0.0)


def _minimum_near(
    energy: LoopEnergy, hold: Plates | Pitch, start: Vectors, known: Sequence[Contact]
) -> HeldMinimum | None:
    """Find the minimum near a shape; from soft plates, if rigid ones give no way."""
    for found in _tries(energy, hold, start, known):
        if found is not None:
            return found
    soft = pressed(energy, hold, start)
    for found in _tries(energy, hold, soft.unknowns, ()):
        if found is not None:
            return replace(found, minimum=found.minimum.after(soft))
    return None


def refine_held(
    scene: LoopScene,
    hold: Plates | Pitch,
    start: tuple[DiscBasis, Vectors],
    known: Sequence[Contact],
    tolerance: float,
    degrees: Sequence[int] = HELD_DEGREES,
) -> HeldSolved:
    """Solve in one basis after the other, at least two, until force and height stand still.

    Parameters
    ----------
    start : DiscBasis and array (n,)
        A first guess in any space.
    known : sequence of Contact
        Those of the first guess, with the Lagrangian's forces.
    tolerance : float
        Of the relative change.
    degrees : sequence of int
        Of the bases.

    Raises
    ------
    NotConvergedError
        When a basis has no minimum near that of the one before.
    """
    basis, q = start
    solved: list[HeldSolved] = []
    for degree in degrees:
        energy = loop_energy(scene, disc_basis(degree, ALIGNED))
        found = _minimum_near(energy, hold, transfer(basis, energy.basis) @ q, known)
        if found is None:
            raise NotConvergedError(
                f"not converged: no minimum was reached with {energy.basis.size} unknowns; "
                "change gap, pitch or beta in smaller steps, each from the solution before, "
                "or take a wider gap"
            )
        now = HeldSolved(hold, energy, found)
        if solved:
            total = replace(found, minimum=found.minimum.after(solved[-1].found.minimum))
            now = replace(now, found=total, change=now.changed(solved[-1]))
        solved.append(now)
        basis, q, known = now.basis, now.unknowns, now.contacts
        if len(solved) > 1 and now.change <= tolerance:
            break
    return solved[-1]
