"""Rules of pieces on a mat."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from shapely import STRtree, box

from patterns.cut_piece import CutPiece
from patterns.kerf import compensated
from patterns.mat import Mat
from patterns.violation import Violation

_ROUNDOFF_MM = 1e-9


@dataclass(frozen=True, slots=True)
class NestedMat:
    """A mat and the pieces on it, in its coordinates."""

    mat: Mat
    pieces: tuple[CutPiece, ...]


def fits(room_mm: tuple[float, float], width_mm: float, height_mm: float) -> bool:
    """Tell whether a box has room as it stands."""
    return width_mm <= room_mm[0] + _ROUNDOFF_MM and height_mm <= room_mm[1] + _ROUNDOFF_MM


def check_mat(pieces: Sequence[CutPiece], mat: Mat) -> tuple[Violation, ...]:
    """Find the pieces that do not fit between a mat's margins, turned or not."""
    width, height = mat.room_mm
    return tuple(
        Violation(
            "mat-size",
            f"{piece.name}: {across:.2f} x {up:.2f} mm do not fit on {width:.2f} x {height:.2f} mm "
            "of the sheet between its margins; the sheet's centre is",
            mat.width_mm / 2,
            mat.height_mm / 2,
        )
        for piece in pieces
        for across, up in [piece.size_mm]
        if not fits(mat.room_mm, across, up) and not fits(mat.room_mm, up, across)
    )


def check_nest(nested: NestedMat, kerf_mm: float) -> tuple[Violation, ...]:
    """Find cuts of different pieces that meet, and cuts beyond the mat."""
    lines = [compensated(piece, kerf_mm).polygon() for piece in nested.pieces]
    mat = box(0.0, 0.0, nested.mat.width_mm, nested.mat.height_mm)
    faults = [
        Violation("mat-edge", f"{piece.name}: it is cut beyond the mat, ends", x, y)
        for piece, line in zip(nested.pieces, lines, strict=True)
        if not mat.covers(line)
        for x, y in [line.difference(mat).representative_point().coords[0]]
    ]
    first, second = STRtree(lines).query(lines, predicate="intersects")
    for i, j in sorted(zip(first.tolist(), second.tolist(), strict=True)):
        if i < j:
            x, y = lines[i].intersection(lines[j]).representative_point().coords[0]
            names = f"{nested.pieces[i].name} and {nested.pieces[j].name}"
            faults.append(Violation("mat-overlap", f"the cuts of {names} meet", x, y))
    return tuple(faults)
