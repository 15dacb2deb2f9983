"""How large loops must be for the needle to find room beside the wire."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import ceil

from patterns.circuit import Circuit
from patterns.path import Line, Piece, WirePath

LARGEST_GROWTH = 3.0
STEP = 1.03
"""Sizes that are tried grow by this factor."""

MOST_PIECES = 1000
"""Of larger circuits every try would take too long."""


def roomy_diameter_mm(circuit: Circuit, has_room: Callable[[Circuit], bool]) -> float | None:
    """Find by trying how large the smallest loop must be, in whole 0.1 mm.

    The circuit is tried at growing sizes, tails and all, until it has room.

    Returns
    -------
    float or None
        Diameter of the smallest loop when there is room; none when no size would do, or the
        circuit is too large to try.
    """
    smallest = min(loop.diameter_mm for loop in circuit.layout.loops)
    pieces = sum(len(stage.pieces) for stage in circuit.stages)
    growth = STEP
    while pieces <= MOST_PIECES and growth <= LARGEST_GROWTH:
        diameter = ceil(10 * smallest * growth) / 10
        if has_room(_scaled(circuit, diameter / smallest)):
            return diameter
        growth *= STEP
    return None


def _scaled(circuit: Circuit, factor: float) -> Circuit:
    stages = tuple(
        WirePath(tuple(_scaled_piece(piece, factor) for piece in stage.pieces))
        for stage in circuit.stages
    )
    crossings = tuple(
        replace(
            crossing,
            x_mm=factor * crossing.x_mm,
            y_mm=factor * crossing.y_mm,
            first_mm=factor * crossing.first_mm,
            second_mm=factor * crossing.second_mm,
        )
        for crossing in circuit.crossings
    )
    return replace(circuit, stages=stages, crossings=crossings)


def _scaled_piece(piece: Piece, factor: float) -> Piece:
    if isinstance(piece, Line):
        x0, y0, x1, y1 = piece.x0_mm, piece.y0_mm, piece.x1_mm, piece.y1_mm
        return Line(factor * x0, factor * y0, factor * x1, factor * y1)
    x, y, radius = piece.centre_x_mm, piece.centre_y_mm, piece.radius_mm
    return replace(piece, centre_x_mm=factor * x, centre_y_mm=factor * y, radius_mm=factor * radius)
