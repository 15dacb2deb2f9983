"""Shapes of a disc sorted by symmetry: which functions may stand in x, y and z.

A symmetry is a space of displacements. Each of its unknowns moves one or more components of the
position by a disc function.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from solver.disc_functions import DiscFunction, Trig

Parity = Literal[0, 1]


@dataclass(frozen=True, slots=True)
class Term:
    """``weight`` times a disc function, added to component 0, 1 or 2 of the position."""

    component: int
    function: DiscFunction
    weight: float


Unknown = tuple[Term, ...]


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


def mirror_class(degree: int, odd_in_x: Parity, odd_in_y: Parity) -> tuple[Unknown, ...]:
    """Displacements that the mirrors x → −x and y → −y leave (0) or change in sign (1).

    The four classes together are all displacements; (0, 0) holds the saddle itself.
    """

    def functions(x: int, y: int) -> list[DiscFunction]:
        # cos mθ is even in y and has the parity of m in x; sin mθ is odd in y, and the other in x
        return _functions(degree + 1, (x + y) % 2, 2, "sin" if y else "cos")

    x, y = odd_in_x, odd_in_y
    components = (functions(1 - x, y), functions(x, 1 - y), functions(x, y))
    return tuple(
        (Term(component, f, 1.0),) for component, chosen in enumerate(components) for f in chosen
    )
