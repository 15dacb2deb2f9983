"""The phase of a strip's shape: it leads from one stable state to the other and back.

A strip that is nearly straight has the heading A1 θ1 + A2 θ2 of its first two buckling modes, with
(A1² + A2²)/2 = δ: a circle. The phase φ = atan2(A2, A1) is 0 in state +, π in state −, and near
±π/2 in the unstable shapes between them; on the circle U = δ (P1 cos² φ + P2 sin² φ) without a
couple. Prescribing φ of a strip bent at will, and letting all else come to rest, gives the energy's
landscape; where it is level the strip is in balance, and where it is lowest stable.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh, null_space

from solver.errors import NotConvergedError
from solver.strip.balance import Balance, Point, at_couple
from solver.strip.basis import StripBasis
from solver.strip.elastica import Elastica
from solver.strip.ends import Ends, buckling_headings

Vectors = NDArray[np.float64]

_STEPS_TO_SADDLE = 12
_SHORTEST_TURN = 1e-4
_LONGEST_WAY = 0.4
"""Of a shape at once, relative to it; shapes whose ends have crossed lie further away."""
_NOTHING_HELD = 0
_LEAST_MASS = 1e-14
_STIFFENING_STEP = 0.25
"""Of the logarithm of the covered part's stiffness."""


def amplitudes(basis: StripBasis, ends: Ends) -> Vectors:
    """Rows (2, n) that read A1 and A2 off the unknowns."""
    plain = np.array(buckling_headings(ends, basis.arc))
    rows = (basis.weight * plain) @ basis.heading
    if basis.stiffening == 0:
        return rows
    # modes of the stepped strip: stationary ½∫(1 + s)κ² at a given ∫θ², its ends level
    level = null_space((basis.weight @ basis.heading)[None, :])
    stiffness, mass = (level.T @ m @ level for m in (basis.stiffness, basis.mass))
    # a heading that no unknown bends is no mode
    mass = mass + _LEAST_MASS * np.trace(mass) * np.eye(len(mass))
    modes = level @ eigh(stiffness, mass, subset_by_index=[0, 1])[1]
    read = modes.T @ basis.mass
    signs = np.sign(np.sum(read * np.linalg.lstsq(basis.mass, rows.T, rcond=None)[0].T, axis=1))
    return signs[:, None] * read


def phase_of(modes: Vectors, x: Vectors) -> float:
    """φ in −π to π, of rows ``modes`` (2, n) and unknowns (n,)."""
    a1, a2 = modes @ x
    return float(np.arctan2(a2, a1))


def at_rest(basis: StripBasis, shortening: float) -> Balance:
    """Give the balance of a strip that only its ends hold."""
    return Balance(basis, shortening, np.zeros((_NOTHING_HELD, basis.size)))


def holding_phase(balance: Balance, modes: Vectors, phase: float) -> Balance:
    """Give the balance of a strip that is also kept at a phase."""
    row = np.cos(phase) * modes[1] - np.sin(phase) * modes[0]
    return Balance(balance.basis, balance.shortening, row[None, :])


def first_state(balance: Balance, ends: Ends) -> Point:
    """State + without couple, from its closed form, in steps where sleeves stiffen it."""
    basis = balance.basis
    mode = Elastica(balance.shortening, 1 if ends is Ends.PINNED else 2)
    heading = mode.heading(basis.arc, ends)
    root = np.sqrt(basis.weight)
    x = np.linalg.lstsq(root[:, None] * basis.heading, root * heading, rcond=None)[0]
    shape = np.asarray(x, dtype=np.float64)
    point = Point(shape, np.array([mode.force, 0.0]), 0.0)
    steps = math.ceil(math.log1p(basis.stiffening) / _STIFFENING_STEP)
    for step in range(steps + 1):
        part = math.expm1(step * math.log1p(basis.stiffening) / max(steps, 1))
        point = at_couple(replace(balance, basis=basis.stiffened(part)), point, 0.0)
    return point


def turned(balance: Balance, modes: Vectors, start: Point, phase: float) -> Point:
    """Take a shape to another phase at the same couple, in as many steps as it takes."""
    turn = float(np.remainder(phase - phase_of(modes, start.x) + np.pi, 2 * np.pi) - np.pi)
    reached, point, part = phase - turn, start, turn
    if turn == 0:
        return _turned_at_once(balance, modes, start, phase, 0.0)
    while abs(phase - reached) > 0:
        towards = phase if abs(phase - reached) <= abs(part) else reached + part
        try:
            point = _turned_at_once(balance, modes, point, towards, towards - reached)
            reached = towards
        except NotConvergedError:
            part /= 2
            if abs(part) < _SHORTEST_TURN:
                raise
    return point


def _turned_at_once(
    balance: Balance, modes: Vectors, start: Point, phase: float, turn: float
) -> Point:
    held = holding_phase(balance, modes, phase)
    a1, a2 = modes @ start.x
    # along the circle of the two modes, which the conditions then correct
    away = np.linalg.lstsq(modes, np.array([-a2, a1]) * turn, rcond=None)[0]
    force = np.append(start.force, np.zeros(3 - len(start.force)))
    guess = Point(start.x + away, force, start.couple, start.iterations)
    end = at_couple(held, guess, start.couple)
    moved = end.x - start.x
    way = float(np.sqrt(moved @ balance.basis.mass @ moved))
    if way > _LONGEST_WAY * np.hypot(a1, a2):
        raise NotConvergedError(f"the shape was lost at a phase of {phase:g} rad")
    return end


def saddles(balance: Balance, ends: Ends, state: Point) -> tuple[Point, Point]:
    """Find the unstable shapes at φ near π/2 and −π/2, without couple."""
    modes = amplitudes(balance.basis, ends)
    found: list[Point] = []
    for side in (1, -1):
        point = state
        for phase in np.linspace(0, side * np.pi / 2, _STEPS_TO_SADDLE + 1)[1:]:
            point = turned(balance, modes, point, float(phase))
        free = Point(point.x, point.force[:2], 0.0, point.iterations)
        found.append(at_couple(balance, free, 0.0))
    return found[0], found[1]
