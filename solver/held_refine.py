"""Solve a held loop in one basis after the other until force and height stand still."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from solver.contact_newton import HeldMinimum, held_minimum
from solver.disc_basis import DiscBasis, disc_basis
from solver.errors import NotConvergedError
from solver.flat import flat_shape
from solver.held_start import pressed, touches_of
from solver.loop_energy import LoopEnergy, loop_energy
from solver.newton import Minimum
from solver.plates import Contact, Pitch, Plates
from solver.refine import carried
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

_ROUGHLY = 1e-4
"""Length of the last step in all bases but the last."""

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


@dataclass(frozen=True, eq=False)
class _Guess:
    """A shape q (n,) near a minimum, with its wire's tension and its contacts."""

    q: Vectors
    tension: Vectors
    contacts: Sequence[Contact]

    def solved(
        self, energy: LoopEnergy, hold: Plates | Pitch, roughly: float, *, sampled: bool = False
    ) -> HeldMinimum | None:
        """Follow Newton's steps from here."""
        return held_minimum(
            energy,
            self.q,
            lambda q: touches_of(energy.basis, hold, q, sampled=sampled),
            tension=self.tension,
            before=self.contacts,
            unilateral=isinstance(hold, Plates),
            roughly=roughly,
        )


def _guess(energy: LoopEnergy, q: Vectors, contacts: Sequence[Contact]) -> _Guess:
    tension = tension_of(energy, q)
    credible = np.abs(tension).max() < _CREDIBLE_TENSION
    return _Guess(q, tension if credible else np.zeros_like(tension), contacts)


def _next_guess(found: HeldMinimum) -> _Guess:
    contacts = found.touches.contacts(found.force)
    return _Guess(found.minimum.unknowns, found.tension, contacts)


def _after(found: HeldMinimum, earlier: Minimum) -> HeldMinimum:
    return replace(found, minimum=found.minimum.after(earlier))


def _tries(
    energy: LoopEnergy, hold: Plates | Pitch, guess: _Guess, roughly: float
) -> Iterator[HeldMinimum | None]:
    """Ways to the minimum near a shape, the quickest first."""
    clear = [contact.bend > _CLEAR_BEND for contact in guess.contacts]
    if isinstance(hold, Pitch) or (clear and all(clear)):
        yield guess.solved(energy, hold, roughly)
    if isinstance(hold, Pitch):
        return
    rough = guess.solved(energy, hold, _NEAR_ENOUGH, sampled=True)
    if rough is not None:
        found = _next_guess(rough).solved(energy, hold, roughly)
        yield found and _after(found, rough.minimum)
    yield guess.solved(energy, hold, roughly)
    yield guess.solved(energy, hold, 0.0, sampled=True)


def _minimum_near(
    energy: LoopEnergy, hold: Plates | Pitch, guess: _Guess, roughly: float
) -> HeldMinimum | None:
    """Find the minimum near a shape; from soft plates, if rigid ones give no way."""
    for found in _tries(energy, hold, guess, roughly):
        if found is not None:
            return found
    soft = pressed(energy, hold, guess.q)
    for found in _tries(energy, hold, _guess(energy, soft.unknowns, ()), roughly):
        if found is not None:
            return _after(found, soft)
    return None


def _finished(energy: LoopEnergy, hold: Plates | Pitch, found: HeldMinimum) -> HeldMinimum | None:
    """Follow the steps to the end."""
    if found.minimum.converged:
        return found
    last = _minimum_near(energy, hold, _next_guess(found), 0.0)
    return last and _after(last, found.minimum)


def refine_held(
    scene: LoopScene,
    hold: Plates | Pitch,
    start: tuple[DiscBasis, Vectors],
    *,
    tolerance: float,
    known: Sequence[Contact] = (),
    degrees: Sequence[int] = HELD_DEGREES,
) -> HeldSolved:
    """Solve in one basis after the other, at least two, until force and height stand still.

    Parameters
    ----------
    start : DiscBasis and array (n,)
        A first guess in any space.
    tolerance : float
        Of the relative change.
    known : sequence of Contact
        Those of the first guess, with the Lagrangian's forces.
    degrees : sequence of int
        Of the bases.

    Raises
    ------
    NotConvergedError
        When a basis has no minimum near that of the one before.
    """
    solved: list[HeldSolved] = []
    for degree in degrees:
        energy = loop_energy(scene, disc_basis(degree, ALIGNED))
        last = (solved[-1].basis, solved[-1].unknowns) if solved else None
        q = carried(start, last, energy.basis)
        contacts = solved[-1].contacts if solved else known
        found = _minimum_near(energy, hold, _guess(energy, q, contacts), _ROUGHLY)
        now = HeldSolved(hold, energy, found or _refused(energy))
        if solved:
            now = replace(now, found=_after(now.found, solved[-1].found.minimum))
            now = replace(now, change=now.changed(solved[-1]))
        solved.append(now)
        if len(solved) > 1 and now.change <= tolerance:
            break
    energy = solved[-1].energy
    return replace(solved[-1], found=_finished(energy, hold, solved[-1].found) or _refused(energy))


def _refused(energy: LoopEnergy) -> NoReturn:
    raise NotConvergedError(
        f"not converged: no minimum was reached with {energy.basis.size} unknowns; change gap, "
        "pitch or beta in smaller steps, each from the solution before, or take a wider gap"
    )
