"""Solve one loop that is held: between two rigid plates, or at a prescribed pitch.

The loop keeps the mirrors of its hold, x → −x and y → −y. Whether it would rather tilt, wrinkle or
fold is told by the second variation among all shapes. Where a plate touches, its force has a point
to act on, so that the shape is no longer smooth there: the basis' error falls with a power of its
degree, and not exponentially as that of a free loop.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from solver.circle import stays_flat
from solver.disc_basis import disc_basis
from solver.errors import NotConvergedError, SceneError
from solver.flat import flat_radius
from solver.held_account import held_equilibrium, plates_share
from solver.held_equilibrium import HeldEquilibrium
from solver.held_refine import HELD_DEGREES, HeldSolved, flat_between, refine_held
from solver.held_start import fitting_saddle
from solver.plates import Contact, Pitch, PlateAxis, Plates
from solver.scene import LoopScene
from solver.symmetry import ALIGNED

_PLENTY = 4
"""How much better than asked a basis must have been for the next solve to end in a smaller one."""

__all__ = ["HeldEquilibrium", "Pitch", "PlateAxis", "Plates"]
__all__ += ["held_path", "solve_at_pitch", "solve_between_plates"]


def solve_between_plates(
    scene: LoopScene,
    plates: Plates,
    *,
    tolerance: float = 5e-3,
    start: HeldEquilibrium | None = None,
    allow_unreliable: bool = False,
) -> HeldEquilibrium:
    """Find the shape of a loop between two plates, and its force on them.

    Parameters
    ----------
    tolerance : float
        The basis grows until force and height change by less than this fraction.
    start : HeldEquilibrium, optional
        That of a neighbouring scene or gap, from which the solve takes less time.
    allow_unreliable : bool
        Give the shape, with a ``status`` that says what is wrong, where this would raise.

    Raises
    ------
    SceneError
        When the loop is no circle.
    NotConvergedError
        When no basis meets the tolerance, when the shape is not a minimum among all that the plates
        allow and that are not turned as a whole, or when the wire meets itself.
    """
    return _hold(scene, plates, tolerance, start, allow_unreliable=allow_unreliable)


def solve_at_pitch(
    scene: LoopScene,
    pitch: Pitch,
    *,
    tolerance: float = 5e-3,
    start: HeldEquilibrium | None = None,
    allow_unreliable: bool = False,
) -> HeldEquilibrium:
    """Find the shape of a loop whose opposite crests are bonded at a distance, and their force.

    Arguments and errors are those of `solve_between_plates`.
    """
    return _hold(scene, pitch, tolerance, start, allow_unreliable=allow_unreliable)


def held_path(
    states: Iterable[tuple[LoopScene, Plates | Pitch]],
    *,
    tolerance: float = 5e-3,
    start: HeldEquilibrium | None = None,
    allow_unreliable: bool = False,
) -> Iterator[HeldEquilibrium]:
    """Solve one state after the other, each from the one before.

    A list of gaps gives the curve of force against gap; a list of β, a path from cold to hot.
    """
    for scene, hold in states:
        start = _hold(scene, hold, tolerance, start, allow_unreliable=allow_unreliable)
        yield start


def _hold(
    scene: LoopScene,
    hold: Plates | Pitch,
    tolerance: float,
    start: HeldEquilibrium | None,
    *,
    allow_unreliable: bool,
) -> HeldEquilibrium:
    if scene.axis_ratio != 1:
        raise SceneError(
            f"axis_ratio = {scene.axis_ratio:g}: held loops are modelled as circles, use 1"
        )
    if isinstance(hold, Plates) and _flat_fits(scene, hold):
        solved = flat_between(scene, hold)
    else:
        solved = _solved(scene, hold, tolerance, start)
    found = held_equilibrium(scene, solved, tolerance)
    if found.status != "converged" and not allow_unreliable:
        raise NotConvergedError(found.status)
    return found


def _flat_fits(scene: LoopScene, hold: Plates) -> bool:
    """Whether the flat loop is the answer: it resists buckling, and the plates leave it room."""
    if not (scene.isotropic_circle and stays_flat(scene)):
        return False
    return hold.axis is PlateAxis.HEIGHT or flat_radius(scene) <= hold.wire_reach


def _solved(
    scene: LoopScene, hold: Plates | Pitch, tolerance: float, start: HeldEquilibrium | None
) -> HeldSolved:
    if start is None or not start.height > 0:
        return refine_held(scene, hold, fitting_saddle(scene, hold), tolerance=tolerance)
    guess = disc_basis(start.degree, ALIGNED), start.shape.coefficients
    lower = 2 if start.change <= tolerance / _PLENTY else 1
    first = max(0, HELD_DEGREES.index(start.degree) - lower)
    return refine_held(
        scene,
        hold,
        guess,
        tolerance=tolerance,
        known=_known(start, hold),
        degrees=HELD_DEGREES[first:],
    )


def _known(start: HeldEquilibrium, hold: Plates | Pitch) -> tuple[Contact, ...]:
    """Contacts of a neighbouring solution, if it is held alike, with the Lagrangian's forces."""
    before = start.hold
    if not (isinstance(before, Plates) and isinstance(hold, Plates) and before.axis is hold.axis):
        return ()
    share = plates_share(before)
    return tuple(replace(contact, force=contact.force / share) for contact in start.contacts)
