"""Shapes of a disc sorted by symmetry: which functions may stand in x, y and z.

A symmetry is a space of displacements. Each of its unknowns moves one or more components of the
position by a disc function.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from solver.disc_functions import DiscFunction, Trig

Parity = Literal[0, 1]
Mirrors = tuple[Parity, Parity]
"""Whether the mirrors x → −x and y → −y leave a displacement (0) or change its sign (1)."""


@dataclass(frozen=True, slots=True)
class Term:
    """``weight`` times a disc function, added to component 0, 1 or 2 of the position."""

    component: int
    function: DiscFunction
    weight: float


Unknown = tuple[Term, ...]


@dataclass(frozen=True, slots=True)
class Symmetry:
    """Displacements whose x and y are of some mirror classes, and whose z of the same or others."""

    in_plane: tuple[Mirrors, ...]
    rise: tuple[Mirrors, ...]


FLAT = Symmetry(((0, 0),), ())
"""Shapes in the plane z = 0 with two mirrors."""

ALIGNED = Symmetry(((0, 0),), ((0, 0),))
"""Saddles along x and y: two mirrors."""

DIAGONAL = Symmetry(((0, 0),), ((1, 1),))
"""Saddles at 45° to x and y: half-turns about all three axes."""

HALF_TURN = Symmetry(((0, 0), (1, 1)), ((0, 0), (1, 1)))
"""Saddles along any direction: a half-turn about z."""


def _functions(degree: int, start: int, step: int, trig: Trig) -> list[DiscFunction]:
    """Functions with m = start, start + step, … up to a polynomial degree."""
    return [
        DiscFunction(m, k, trig)
        for m in range(start, degree + 1, step)
        for k in range((degree - m) // 2 + 1)
        if m > 0 or trig == "cos"
    ]


def saddle(degree: int) -> tuple[Unknown, ...]:
    """Unknowns of the saddle: mirrors in x and in y, and a quarter turn that changes z into −z.

    ``degree`` (odd) bounds the polynomials in x and y; z goes one further.
    """
    half = 0.5**0.5  # so that each unknown moves the disc by 1 in the mean square
    in_plane = tuple(
        (
            Term(0, f, half),
            Term(1, DiscFunction(f.m, f.k, "sin"), half if f.m % 4 == 1 else -half),
        )
        for f in _functions(degree, 1, 2, "cos")
    )
    return in_plane + tuple((Term(2, f, 1.0),) for f in _functions(degree + 1, 2, 4, "cos"))


def _class_functions(degree: int, x: int, y: int) -> list[DiscFunction]:
    # cos mθ is even in y and has the parity of m in x; sin mθ is odd in y, and the other in x
    return _functions(degree + 1, (x + y) % 2, 2, "sin" if y else "cos")


def displacements(degree: int, symmetry: Symmetry) -> tuple[Unknown, ...]:
    """All displacements of a symmetry, of polynomials up to ``degree + 1``, ``degree`` odd."""
    along_x = ((0, f) for x, y in symmetry.in_plane for f in _class_functions(degree, 1 - x, y))
    along_y = ((1, f) for x, y in symmetry.in_plane for f in _class_functions(degree, x, 1 - y))
    along_z = ((2, f) for x, y in symmetry.rise for f in _class_functions(degree, x, y))
    return tuple(
        (Term(component, f, 1.0),)
        for chosen in (along_x, along_y, along_z)
        for component, f in chosen
    )


def oblique(degree: int) -> tuple[Unknown, ...]:
    """Unknowns of saddles along any direction: a half-turn about z, and no turn about it.

    The turn of the loop as a whole, which costs nothing, is kept out by moving x along y as much as
    y along x.
    """
    half = 0.5**0.5
    along_x, along_y = DiscFunction(1, 0, "sin"), DiscFunction(1, 0, "cos")
    tied = (Term(0, along_x, half), Term(1, along_y, half))
    single = ((Term(0, along_x, 1.0),), (Term(1, along_y, 1.0),))
    return (tied, *(u for u in displacements(degree, HALF_TURN) if u not in single))


def mirror_symmetry(odd_in_x: Parity, odd_in_y: Parity) -> Symmetry:
    """Give the symmetry of displacements of one mirror class."""
    return Symmetry(((odd_in_x, odd_in_y),), ((odd_in_x, odd_in_y),))


def mirror_class(degree: int, odd_in_x: Parity, odd_in_y: Parity) -> tuple[Unknown, ...]:
    """Displacements that the mirrors x → −x and y → −y leave (0) or change in sign (1).

    The four classes together are all displacements; (0, 0) holds the saddle itself.
    """
    return displacements(degree, mirror_symmetry(odd_in_x, odd_in_y))
