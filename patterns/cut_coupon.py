"""Pieces to try a sheet, a blade and its settings on before the beams are cut."""

from __future__ import annotations

from collections.abc import Sequence

from patterns.cut_piece import CutPiece, Hole
from patterns.errors import PatternError
from patterns.positive import check_positive
from patterns.rounding import Corner, rounded

_NOTCH_DEPTH_MM = 1.0
_NOTCH_HALF_MM = 1.0
_NOTCH_PITCH_MM = 2.5
_RADIUS_MM = 0.3
"""Notches are as small as can be counted by eye; their corners are a little rounder than the
sharpest that `patterns.cut_rules.CutLimits` allows."""


def hole_coupon(diameters_mm: Sequence[float], hole_edge_diameters: float) -> CutPiece:
    """Give a strip with a hole of each diameter, to see in which the rivet snap holds.

    Below the first hole is one notch, below the second are two, and so on.

    Parameters
    ----------
    diameters_mm : sequence of float
        From left to right.
    hole_edge_diameters : float
        Least distance of a hole's edge from others and from the notches, in its diameters.

    Raises
    ------
    PatternError
        When there is no hole, or a diameter is not positive.
    """
    if not diameters_mm:
        raise PatternError("no coupon without a hole")
    check_positive("coupon", smallest_hole_mm=min(diameters_mm), hole_edge=hole_edge_diameters)
    largest = max(diameters_mm)
    beside = hole_edge_diameters * largest
    pitch = max(largest + 2 * beside, _notches_mm(len(diameters_mm)))
    below = largest / 2 + beside + _NOTCH_DEPTH_MM
    middles = [(k + 0.5) * pitch for k in range(len(diameters_mm))]
    edge = [corner for k, x in enumerate(middles) for corner in _notches(x, k + 1)]
    width, height = pitch * len(diameters_mm), below + largest / 2 + beside
    holes = (Hole(x, below, d) for x, d in zip(middles, diameters_mm, strict=True))
    outside = rounded(_box(width, height, edge))
    return CutPiece("hole coupon", outside, tuple(holes))


def kerf_coupons(kerfs_mm: Sequence[float], side_mm: float) -> tuple[CutPiece, ...]:
    """Give a square for each kerf: the one that measures ``side_mm`` shows the right one.

    The first square has one notch, the second has two, and so on.

    Parameters
    ----------
    kerfs_mm : sequence of float
        Each square is compensated for its own.
    side_mm : float
        Of every square, once cut with the right kerf.

    Raises
    ------
    PatternError
        When the notches have no room on a side.
    """
    check_positive("coupon", side_mm=side_mm)
    needed = _notches_mm(len(kerfs_mm))
    if side_mm < needed:
        raise PatternError(
            f"no coupon of {len(kerfs_mm)} squares of {side_mm:g} mm: their notches need sides of "
            f"{needed:g} mm"
        )
    squares: list[CutPiece] = []
    for number, kerf in enumerate(kerfs_mm, start=1):
        outside = rounded(_box(side_mm, side_mm, _notches(side_mm / 2, number)))
        squares.append(CutPiece(f"kerf coupon {number}", outside, kerf_mm=kerf))
    return tuple(squares)


def _notches_mm(count: int) -> float:
    """Length of an edge that holds so many notches."""
    return (count + 1) * _NOTCH_PITCH_MM


def _notches(middle_mm: float, count: int) -> list[Corner]:
    """Notches into a lower edge at height 0, from left to right."""
    corners: list[Corner] = []
    for k in range(count):
        x = middle_mm + (k - (count - 1) / 2) * _NOTCH_PITCH_MM
        corners += [
            Corner(x - _NOTCH_HALF_MM, 0.0, _RADIUS_MM),
            Corner(x, _NOTCH_DEPTH_MM, _RADIUS_MM),
            Corner(x + _NOTCH_HALF_MM, 0.0, _RADIUS_MM),
        ]
    return corners


def _box(width_mm: float, height_mm: float, lower_edge: list[Corner]) -> list[Corner]:
    return [
        Corner(0.0, 0.0, _RADIUS_MM),
        *lower_edge,
        Corner(width_mm, 0.0, _RADIUS_MM),
        Corner(width_mm, height_mm, _RADIUS_MM),
        Corner(0.0, height_mm, _RADIUS_MM),
    ]
