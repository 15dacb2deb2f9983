"""The centreline of the wire as path data of SVG: lines and arcs, as exact as it is."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi

import numpy as np

from patterns.path import Arc, Piece, WirePath
from sesame_cad.files.sheet import Sheet
from sesame_cad.files.svg_page import number


def wire_path(sheet: Sheet, path: WirePath) -> str:
    """Path data of a stage of the wire, on a page."""
    (start,), _ = path.pieces[0].at(np.zeros(1))
    x, y = sheet.on_page(start[None])[0]
    return f"M {number(x)},{number(y)}" + "".join(
        part for piece in path.pieces for part in _piece(sheet, piece)
    )


def _piece(sheet: Sheet, piece: Piece) -> Iterator[str]:
    """Path data from the end of the piece before; no arc is more than half a circle."""
    parts = 1
    if isinstance(piece, Arc):
        parts = max(1, int(np.ceil(abs(piece.sweep_rad) / pi - 1e-9)))
    ends, _ = piece.at(np.arange(1, parts + 1) * piece.length_mm / parts)
    for x, y in sheet.on_page(ends).tolist():
        if isinstance(piece, Arc):
            radius, sweep = number(piece.radius_mm), int(piece.sweep_rad < 0)  # y is down there
            yield f" A {radius},{radius} 0 0,{sweep} {number(x)},{number(y)}"
        else:
            yield f" L {number(x)},{number(y)}"
