"""Compensation for what the blade or beam takes away."""

from __future__ import annotations

from dataclasses import replace
from math import isfinite

from patterns.cut_piece import CutPiece
from patterns.errors import PatternError


def compensated(piece: CutPiece, kerf_mm: float) -> CutPiece:
    """Move all lines away from the material by half the kerf: outsides grow, holes shrink.

    Arcs stay arcs about the same centres.

    Parameters
    ----------
    piece : CutPiece
        The piece as it shall come out. A kerf of its own goes before the sheet's.
    kerf_mm : float
        Width of the cut; 0 leaves the lines where they are.

    Raises
    ------
    PatternError
        When the kerf is negative, or as wide as a hole or as an inner corner is round.
    """
    kerf = kerf_mm if piece.kerf_mm is None else piece.kerf_mm
    if not (isfinite(kerf) and kerf >= 0):
        raise PatternError(f"{piece.name}: the kerf is {kerf:g} mm; it must not be negative")
    lost = [hole for hole in piece.holes if hole.diameter_mm <= kerf]
    if lost:
        raise PatternError(
            f"{piece.name}: a hole of {lost[0].diameter_mm:g} mm cannot be cut with a kerf of "
            f"{kerf:g} mm: it must be wider"
        )
    return replace(
        piece,
        outside=piece.outside.offset(kerf / 2),
        holes=tuple(replace(hole, diameter_mm=hole.diameter_mm - kerf) for hole in piece.holes),
        openings=tuple(one.offset(kerf / 2) for one in piece.openings),
    )
