"""Both layers of a sleeve and the beams between them as one drawing in layers, 1:1."""

from __future__ import annotations

import numpy as np

from patterns.contour import Contour
from patterns.cut_piece import CutPiece
from sesame_cad.files.cut_line import CUT, HOLE, CutLine
from sesame_cad.files.cut_svg import add_cut_line
from sesame_cad.files.plan_svg import draw_plan
from sesame_cad.files.sheet import Sheet, lay_out_points
from sesame_cad.files.svg_page import add_layer, add_reference, svg_page, svg_text
from sesame_cad.sleeve.design import SleeveDesign
from sesame_cad.sleeve.pattern import LOWER, UPPER

_BEAMS = "fill:none;stroke-width:0.3;stroke:#888888"


def sleeve_plan_svg(made: SleeveDesign) -> str:
    """Draw everything that is laid, sewn and cut.

    Layers, from the bottom: those of `sesame_cad.files.plan_svg` for the lower array, each named
    LOWER-...; BEAMS; the same for the upper array, named UPPER-...; REFERENCE, a 100 mm bar.
    """
    spec, pattern = made.spec, made.pattern
    sheet = _page(made)
    root = svg_page(sheet, spec.name)
    wire_mm = spec.wire.diameter_mm
    draw_plan(root, sheet, pattern.lower, wire_mm, f"{LOWER.upper()}-")
    group = add_layer(root, "BEAMS", _BEAMS)
    for piece in pattern.cutting.laid:
        for line in _lines(piece):
            add_cut_line(group, sheet, line)
    draw_plan(root, sheet, pattern.upper, wire_mm, f"{UPPER.upper()}-")
    add_reference(root, sheet)
    return svg_text(root)


def _page(made: SleeveDesign) -> Sheet:
    pattern = made.pattern
    layers = (pattern.lower, pattern.upper)
    rings = [ring for layer in layers for ring in layer.outline.outsides]
    strokes = [stroke for layer in layers for mark in layer.marks for stroke in mark.strokes]
    return lay_out_points(np.concatenate([*rings, *strokes]))


def _lines(piece: CutPiece) -> list[CutLine]:
    """Give the lines of a piece as it shall come out."""
    contours: tuple[Contour, ...] = (piece.outside, *piece.openings)
    circles = (np.array([[one.x_mm, one.y_mm, one.diameter_mm]]) for one in piece.holes)
    return [
        *(CutLine(CUT, True, one.vertices()) for one in contours),
        *(CutLine(HOLE, True, one) for one in circles),
    ]
