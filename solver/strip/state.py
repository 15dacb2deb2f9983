"""A shape of a strip in balance, in SI units."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from solver.strip.balance import Balance, Point
from solver.strip.basis import Piece, StripBasis
from solver.strip.scene import StripScene

Vectors = NDArray[np.float64]

_SAMPLES = 129
"""Points of a shape, equally spaced along it; with an odd number one is the middle."""
_CURVATURE_SAMPLES = 1025
_NO_CURVATURE = 1e-7
"""Of the largest curvature: below it a sign is rounding."""


class Side(StrEnum):
    """Side to which a beam is arched: ``+`` up, ``-`` down, or ``between``, in no stable state."""

    UP = "+"
    DOWN = "-"
    BETWEEN = "between"


@dataclass(frozen=True)
class StripState:
    """A strip in balance at a couple; its first rivet lies at 0, its second on the x-axis.

    Attributes
    ----------
    side : Side
    couple_N_m : float
        Sum of both sleeves' couples.
    bending_J : float
        ½ ∫ EI κ² ds, with what the sleeves add to EI.
    energy_J : float
        Bending energy, less the couple's work: couple × turn of the covered part.
    force_N : float
        Pull of the beam on the shorter strip; less than 0 where it pushes it apart.
    points_m : array (n, 2)
        Equally spaced along the beam.
    headings_rad : array (n,)
    curvatures_per_m : array (n,)
    height_m : float
        y halfway along the beam.
    inflections_m : tuple of float
        Places along the beam, between its ends, at which the curvature changes sign.
    eigenvalue_J : float
        Lowest eigenvalue of the energy's second variation per mean square of the change of heading;
        greater than 0 at a minimum.
    gradient_norm : float
        Largest component of what is missing to balance, in units of EI/L.
    truncation : float
        Share of the curvature in the last two polynomials of a piece.
    steps : int
        Newton steps from the closed form of the state without couple.
    status : str
    """

    side: Side
    couple_N_m: float  # noqa: N815 - the units' own names
    bending_J: float  # noqa: N815
    energy_J: float  # noqa: N815
    force_N: float  # noqa: N815
    points_m: Vectors
    headings_rad: Vectors
    curvatures_per_m: Vectors
    height_m: float
    inflections_m: tuple[float, ...]
    eigenvalue_J: float  # noqa: N815
    gradient_norm: float
    truncation: float
    steps: int
    status: str = "converged"


def _cumulated(piece: Piece, values: Vectors, arc: Vectors) -> tuple[Vectors, float]:
    """Integral of values at Gauss points, from a piece's start to points on it and to its end."""
    points, weights = legendre.leggauss(len(values))
    degree = len(values) - 1
    scale = (2 * np.arange(degree + 1) + 1) / 2
    series = legendre.legint(scale * ((weights * values) @ legendre.legvander(points, degree)))
    base = legendre.legval(-1.0, series)
    at = np.asarray(legendre.legval(piece.within(arc), series)) - base
    half = piece.length / 2
    return half * at, half * float(legendre.legval(1.0, series) - base)


def positions(basis: StripBasis, x: Vectors, arc: Vectors) -> Vectors:
    """Points (n, 2) of a strip of length 1, from its first rivet."""
    heading, where = basis.heading @ x, basis.piece_of(arc)
    per_piece = len(basis.arc) // len(basis.pieces)
    out = np.zeros((len(arc), 2))
    for i, piece in enumerate(basis.pieces):
        here = heading[i * per_piece : (i + 1) * per_piece]
        for axis, of_heading in enumerate((np.cos, np.sin)):
            along, whole = _cumulated(piece, of_heading(here), arc[where == i])
            out[where == i, axis] += along
            out[where > i, axis] += whole
    return out


def inflections(basis: StripBasis, x: Vectors) -> tuple[float, ...]:
    """Places in 0 to 1, ends left out, at which the curvature changes sign."""
    arc = np.linspace(0, 1, _CURVATURE_SAMPLES)
    curvature = basis.curvature_at(arc) @ x
    told = np.flatnonzero(np.abs(curvature) > _NO_CURVATURE * np.abs(curvature).max())
    arc, curvature = arc[told], curvature[told]
    before = np.flatnonzero(curvature[:-1] * curvature[1:] < 0)
    a, b = curvature[before], curvature[before + 1]
    return tuple(float(s) for s in arc[before] + (arc[before + 1] - arc[before]) * a / (a - b))


def strip_state(scene: StripScene, balance: Balance, point: Point, side: Side) -> StripState:
    """Read a shape in the scene's units."""
    basis, x, length = balance.basis, point.x, scene.length_m
    arc, unit = np.linspace(0, 1, _SAMPLES), scene.energy_unit_J
    points = length * positions(basis, x, arc)
    return StripState(
        side=side,
        couple_N_m=point.couple * unit,
        bending_J=balance.energy(x, 0.0) * unit,
        energy_J=balance.energy(x, point.couple) * unit,
        force_N=float(point.force[0]) * unit / length,
        points_m=points,
        headings_rad=basis.headings_at(arc) @ x,
        curvatures_per_m=basis.curvature_at(arc) @ x / length,
        height_m=float(points[_SAMPLES // 2, 1]),
        inflections_m=tuple(length * s for s in inflections(basis, x)),
        eigenvalue_J=balance.lowest_eigenvalue(point) * unit,
        gradient_norm=balance.gradient_norm(point),
        truncation=basis.tail(x),
        steps=point.iterations,
    )
