"""Where the solve of a held loop starts: at a saddle that fits, pressed into place softly."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.disc_basis import DiscBasis, disc_basis, transfer
from solver.first_guess import GUESS_DEGREE, saddle_family, scene_weights
from solver.free_motions import drift
from solver.loop_energy import LoopEnergy
from solver.newton import Minimum, minimise
from solver.plates import Pitch, PlateAxis, Plates
from solver.saddle_rows import crest_distance
from solver.scene import LoopScene
from solver.symmetry import ALIGNED
from solver.touching import Touches, held_points, plate_touches

Vectors = NDArray[np.float64]

_SPRING = 30.0
"""Of a soft plate or bond, in units of E_f t."""
_ROUGHLY = 1e-3
_MOST_STEPS = 200


def touches_of(
    basis: DiscBasis, hold: Plates | Pitch, q: Vectors, *, sampled: bool = False
) -> Touches:
    """What touches, or is held, at a shape q (n,)."""
    if isinstance(hold, Plates):
        return plate_touches(basis, hold, q, sampled=sampled)
    return held_points(basis, hold, q)


def fitting_saddle(scene: LoopScene, hold: Plates | Pitch) -> tuple[DiscBasis, Vectors]:
    """Give the saddle nearest to the free one that fits, of a family solved once before."""
    family = saddle_family()
    small = disc_basis(GUESS_DEGREE, "saddle")
    guess = family.nearest(scene_weights(scene))
    reaches = family.coefficients @ crest_distance(small)
    if isinstance(hold, Pitch):
        guess = family.coefficients[int(np.argmin(np.abs(reaches[1:] - hold.pitch / 2))) + 1]
    elif hold.axis is PlateAxis.HEIGHT:
        own = float(np.interp(hold.wire_reach, family.heights / 2, np.arange(len(reaches))))
        if family.coefficients[1:].size and plate_excess(small, guess, hold) > 0:
            guess = family.coefficients[max(1, int(own))]
    elif plate_excess(small, guess, hold) > 0:
        fitting = np.flatnonzero(reaches[1:] <= hold.wire_reach)
        guess = family.coefficients[1 + (fitting[0] if fitting.size else len(reaches) - 2)]
    basis = disc_basis(GUESS_DEGREE, ALIGNED)
    return basis, transfer(small, basis) @ guess


def plate_excess(small: DiscBasis, q: Vectors, plates: Plates) -> float:
    """How far a saddle's shape is beyond the plates."""
    basis = disc_basis(small.degree, ALIGNED)
    return float(plate_touches(basis, plates, transfer(small, basis) @ q).excess.max())


def pressed(energy: LoopEnergy, hold: Plates | Pitch, start: Vectors) -> Minimum:
    """Go downhill between soft plates, or with soft bonds, to near the minimum between rigid ones.

    Springs of the hold are added to the energy; the steps never end on a saddle point.
    """
    back = drift(energy.basis)

    def derivatives(q: Vectors) -> tuple[float, Vectors, Vectors]:
        touches = touches_of(energy.basis, hold, q, sampled=True)
        beyond = touches.excess
        if isinstance(hold, Plates):
            touches = touches.chosen(beyond > 0)
            beyond = touches.excess
        value, slope, hessian = energy.derivatives(q)
        value += _SPRING / 2 * float(beyond @ beyond)
        pull = _SPRING * touches.rows.T
        return value, slope + pull @ beyond, hessian + pull @ touches.rows + back

    return minimise(derivatives, start, tolerance=_ROUGHLY, radius=0.1, most_steps=_MOST_STEPS)
