"""Laying pieces on as few mats as shelves allow."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite

from patterns.cut_piece import CutPiece
from patterns.errors import PatternError
from patterns.mat import Mat
from patterns.nest_rules import NestedMat, check_mat, fits

_ROUNDOFF_MM = 1e-9


@dataclass(frozen=True, slots=True)
class _Spot:
    """Where a piece's box goes: the mat, its lower left corner, and whether it lies along x."""

    mat: int
    x_mm: float
    y_mm: float
    lies: bool


@dataclass(slots=True)
class _Shelf:
    """A row that is being filled from the left."""

    mat: int
    y_mm: float
    height_mm: float
    filled_mm: float


@dataclass(frozen=True, slots=True)
class _Packing:
    """A spot for each piece, and how many mats they take; of the last one, the share used."""

    spots: tuple[_Spot, ...]
    mats: float


def nest(pieces: Sequence[CutPiece], mat: Mat, spacing_mm: float) -> tuple[NestedMat, ...]:
    """Lay pieces in rows, the longest way along the rows, and start further mats as needed.

    Boxes go by falling height into the first row with room (first fit, decreasing height: Coffman,
    Garey, Johnson and Tarjan, SIAM J. Comput. 9, 1980). Rows along both sides of the mat are
    tried; the way that takes less is kept.

    Parameters
    ----------
    pieces : sequence of CutPiece
        Anywhere; pieces on the mats keep their order.
    mat : Mat
        As many of these as are needed.
    spacing_mm : float
        Between the boxes of neighbouring pieces; more than the kerf.

    Raises
    ------
    PatternError
        When the spacing is negative, or a piece does not fit: one line a piece.
    """
    if not (isfinite(spacing_mm) and spacing_mm >= 0):
        raise PatternError(f"the spacing is {spacing_mm:g} mm; it must not be negative")
    faults = check_mat(pieces, mat)
    if faults:
        raise PatternError("\n".join(str(fault) for fault in faults))
    boxes = [(max(piece.size_mm), min(piece.size_mm)) for piece in pieces]
    lying = _packed(boxes, mat.room_mm, spacing_mm)
    across, up = mat.room_mm
    standing = _transposed(_packed(boxes, (up, across), spacing_mm))
    spots = min(lying, standing, key=lambda packing: packing.mats).spots
    placed = [(spot.mat, _put(p, spot, mat)) for p, spot in zip(pieces, spots, strict=True)]
    return tuple(
        NestedMat(mat, tuple(piece for on, piece in placed if on == k))
        for k in range(1 + max((on for on, _ in placed), default=-1))
    )


def _packed(
    boxes: list[tuple[float, float]], room_mm: tuple[float, float], spacing_mm: float
) -> _Packing:
    """Fill rows along x; boxes are (longer side, shorter side)."""
    lies = [fits(room_mm, *box) for box in boxes]
    sizes = [box if flat else box[::-1] for box, flat in zip(boxes, lies, strict=True)]
    order = sorted(range(len(boxes)), key=lambda k: (-sizes[k][1], -sizes[k][0], k))
    shelves: list[_Shelf] = []
    spots: dict[int, _Spot] = {}
    for k in order:
        width, height = sizes[k]
        shelf = _shelf(shelves, (width, height), room_mm, spacing_mm)
        spots[k] = _Spot(shelf.mat, shelf.filled_mm, shelf.y_mm, lies[k])
        shelf.filled_mm += width + spacing_mm
    return _Packing(tuple(spots[k] for k in range(len(boxes))), _mats(shelves, room_mm))


def _shelf(
    shelves: list[_Shelf],
    size_mm: tuple[float, float],
    room_mm: tuple[float, float],
    spacing_mm: float,
) -> _Shelf:
    """Find the first shelf with room, or begin one: on a mat with room, or on a new mat."""
    width, height = size_mm
    for shelf in shelves:
        # heights fall, so that no shelf is too low
        if shelf.filled_mm + width <= room_mm[0] + _ROUNDOFF_MM:
            return shelf
    tops = {shelf.mat: shelf.y_mm + shelf.height_mm + spacing_mm for shelf in shelves}
    fitting = [on for on, top in tops.items() if top + height <= room_mm[1] + _ROUNDOFF_MM]
    on = fitting[0] if fitting else len(tops)
    shelves.append(_Shelf(on, tops[on] if fitting else 0.0, height, 0.0))
    return shelves[-1]


def _mats(shelves: list[_Shelf], room_mm: tuple[float, float]) -> float:
    last = max((shelf.mat for shelf in shelves), default=0)
    tops = [shelf.y_mm + shelf.height_mm for shelf in shelves if shelf.mat == last]
    return last + max(tops, default=0.0) / room_mm[1]


def _transposed(packing: _Packing) -> _Packing:
    spots = (_Spot(s.mat, s.y_mm, s.x_mm, not s.lies) for s in packing.spots)
    return _Packing(tuple(spots), packing.mats)


def _put(piece: CutPiece, spot: _Spot, mat: Mat) -> CutPiece:
    width, height = piece.size_mm
    turned = piece if (width >= height) == spot.lies else piece.quarter_turned()
    left, bottom, _, _ = turned.bounds_mm
    x_mm, y_mm = mat.margin_mm + spot.x_mm, mat.margin_mm + spot.y_mm
    return turned.moved(x_mm - left, y_mm - bottom)
