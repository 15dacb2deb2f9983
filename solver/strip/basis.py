"""Headings of a strip as polynomials between the places where its couple jumps.

On each piece the curvature is a sum of Legendre polynomials, orthonormal over the piece; the
heading is its integral and so continuous. Between jumps the solution is analytic: the error falls
exponentially with the degree.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray
from scipy.linalg import null_space

from solver.strip.ends import Ends

Vectors = NDArray[np.float64]
Indices = NDArray[np.intp]

_MORE_POINTS = 12
"""Gauss points beyond the degree, for sines of polynomials."""


@dataclass(frozen=True)
class Piece:
    """A part of the strip, from ``start`` over ``length``, with polynomials up to ``degree``."""

    start: float
    length: float
    degree: int

    def within(self, arc: Vectors) -> Vectors:
        """Map arc lengths to −1 to 1."""
        return 2 * (arc - self.start) / self.length - 1

    def curvature(self, arc: Vectors) -> Vectors:
        """Orthonormal polynomials (n, degree + 1) at points of the piece."""
        scale = np.sqrt((2 * np.arange(self.degree + 1) + 1) / self.length)
        return np.asarray(scale * legendre.legvander(self.within(arc), self.degree), np.float64)

    def heading(self, arc: Vectors) -> Vectors:
        """Their integrals from the piece's start: ∫ P_j = (P_{j+1} − P_{j−1})/(2j + 1)."""
        p = legendre.legvander(self.within(arc), self.degree + 1)
        before = np.column_stack([-np.ones(len(arc)), p[:, : self.degree]])
        scale = np.sqrt(self.length / (2 * np.arange(self.degree + 1) + 1)) / 2
        return scale * (p[:, 1:] - before)

    @property
    def turn(self) -> Vectors:
        """What each polynomial adds to the heading over the whole piece (degree + 1,)."""
        out = np.zeros(self.degree + 1)
        out[0] = np.sqrt(self.length)
        return out


@dataclass(frozen=True)
class StripBasis:
    """Headings with n unknowns, tabulated at Q Gauss points.

    Attributes
    ----------
    pieces : tuple of Piece
    free : array (N, n)
        Heading at the start and coefficients of the curvature, from the unknowns.
    arc, weight : array (Q,)
    heading : array (Q, n)
    stiffness, mass : array (n, n)
        ∫ (1 + stiffening where covered) κ κ ds and ∫ θ θ ds.
    covering : array (n, n)
        ∫ κ κ ds over the part that the sleeves cover.
    turn : array (n,)
        Turn ∫ κ ds of that part.
    stiffening : float
        Bending stiffness that the sleeves add there, in units of the strip's.
    """

    pieces: tuple[Piece, ...]
    free: Vectors
    arc: Vectors
    weight: Vectors
    heading: Vectors
    stiffness: Vectors
    mass: Vectors
    covering: Vectors
    turn: Vectors
    stiffening: float = 0.0

    @property
    def size(self) -> int:
        """Number n of unknowns."""
        return self.free.shape[1]

    def stiffened(self, stiffening: float) -> StripBasis:
        """Give the basis of the same headings with another stiffness of the covered part."""
        more = stiffening - self.stiffening
        return replace(self, stiffness=self.stiffness + more * self.covering, stiffening=stiffening)

    def piece_of(self, arc: Vectors) -> Indices:
        """Index of the piece on which each point lies."""
        starts = [piece.start for piece in self.pieces]
        return np.clip(np.searchsorted(starts, arc, side="right") - 1, 0, None)

    def coefficients(self, unknowns: Vectors) -> list[Vectors]:
        """Coefficients of the curvature, piece by piece."""
        cuts = np.cumsum([piece.degree + 1 for piece in self.pieces])[:-1]
        return np.split((self.free @ unknowns)[1:], cuts)

    def headings_at(self, arc: Vectors) -> Vectors:
        """Headings (len(arc), n) at any points."""
        return _heading_table(self.pieces, arc, self.piece_of(arc)) @ self.free

    def curvature_at(self, arc: Vectors) -> Vectors:
        """Curvatures (len(arc), n) at any points; at a jump, that after it."""
        table = np.zeros((len(arc), len(self.free)))
        where, column = self.piece_of(arc), 1
        for i, piece in enumerate(self.pieces):
            here = np.flatnonzero(where == i)
            table[here, column : column + piece.degree + 1] = piece.curvature(arc[here])
            column += piece.degree + 1
        return table @ self.free

    def tail(self, unknowns: Vectors) -> float:
        """Share of the curvature in the last two polynomials of a piece: the truncation's size."""
        parts = self.coefficients(unknowns)
        whole = np.sqrt(sum(float(part @ part) for part in parts))
        return max(float(np.linalg.norm(part[-2:])) for part in parts) / whole


def _heading_table(pieces: tuple[Piece, ...], arc: Vectors, where: Indices) -> Vectors:
    """Headings from (θ(0), coefficients of all pieces), at points that lie on pieces ``where``."""
    size = 1 + sum(piece.degree + 1 for piece in pieces)
    table = np.zeros((len(arc), size))
    table[:, 0] = 1
    column = 1
    for i, piece in enumerate(pieces):
        columns = slice(column, column + piece.degree + 1)
        here = np.flatnonzero(where == i)
        table[here, columns] = piece.heading(arc[here])
        table[where > i, columns] = piece.turn
        column = columns.stop
    return table


def _pieces(covered: tuple[float, float], degree: int) -> tuple[Piece, ...]:
    knots = sorted({0.0, *covered, 1.0})
    return tuple(Piece(a, b - a, degree) for a, b in pairwise(knots))


def _free_of(pieces: tuple[Piece, ...], ends: Ends) -> Vectors:
    """Orthonormal basis of the headings that the ends allow."""
    turns = np.concatenate([piece.turn for piece in pieces])
    if ends is Ends.PINNED:
        return np.eye(1 + len(turns))
    first = np.zeros(1 + len(turns))
    first[0] = 1
    return np.asarray(null_space(np.array([first, np.append(0.0, turns)])))


@lru_cache(maxsize=64)
def strip_basis(covered: tuple[float, float], ends: Ends, degree: int) -> StripBasis:
    """Tabulate the basis of a strip whose couple acts from ``covered[0]`` to ``covered[1]``.

    Parameters
    ----------
    covered : tuple of float
        In 0 to 1, as shares of the strip's length.
    degree : int
        Of the curvature's polynomials on each piece.
    """
    pieces = _pieces(covered, degree)
    free = _free_of(pieces, ends)
    points, weights = legendre.leggauss(degree + _MORE_POINTS)
    arc = np.concatenate([p.start + p.length * (points + 1) / 2 for p in pieces])
    weight = np.concatenate([p.length * weights / 2 for p in pieces])
    where = np.repeat(np.arange(len(pieces)), len(points))
    heading = _heading_table(pieces, arc, where) @ free
    at_ends = _heading_table(pieces, np.array(covered), _ends_of(pieces, covered))
    turn = at_ends[1] - at_ends[0]
    inside = [covered[0] <= p.start < covered[1] for p in pieces for _ in range(degree + 1)]
    bent = free[1:][inside]
    return StripBasis(
        pieces,
        free,
        arc,
        weight,
        heading,
        free[1:].T @ free[1:],
        heading.T @ (weight[:, None] * heading),
        bent.T @ bent,
        turn @ free,
    )


def _ends_of(pieces: tuple[Piece, ...], covered: tuple[float, float]) -> Indices:
    """Pieces in which the covered part begins and ends."""
    starts = [piece.start for piece in pieces]
    begin = starts.index(covered[0])
    end = starts.index(covered[1]) - 1 if covered[1] in starts else len(pieces) - 1
    return np.array([begin, end], dtype=np.intp)
