"""The curve of a chain as a drawing 1:1, in layers."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from sesame_cad.drawing_colours import STAGES
from sesame_cad.files.sheet import Sheet, lay_out_points
from sesame_cad.files.svg_page import (
    add_layer,
    add_reference,
    add_text,
    line_path,
    number,
    svg_page,
    svg_text,
)
from sesame_cad.sleeve_prediction.chain import ChainCurve

Vectors = NDArray[np.float64]

_LINE = "fill:none;stroke-width:0.8;stroke-linejoin:round;stroke:"
_RIVET_MM = 1.5
_TEXT = "font:5px sans-serif;stroke:none;fill:#333333;text-anchor:middle"
_AWAY_MM = 6.0
"""From a segment's middle to the sign of its state."""


def chain_svg(curve: ChainCurve, title: str) -> str:
    """Draw the segments, a colour a state, their rivets and the signs of their states."""
    points = curve.segments_mm.reshape(-1, 2)
    corners = np.array([points.min(axis=0) - 2 * _AWAY_MM, points.max(axis=0) + 2 * _AWAY_MM])
    sheet = lay_out_points(corners)
    root = svg_page(sheet, title)
    for label, state, colour in (("PLUS", "+", STAGES[0]), ("MINUS", "-", STAGES[1])):
        own = [line for line, s in zip(curve.segments_mm, curve.states, strict=True) if s == state]
        paths = (line_path(sheet, line, closed=False) for line in own)
        add_layer(root, label, f"{_LINE}{colour}", paths)
    add_layer(root, "RIVETS", "stroke:none;fill:#333333", _rivets(sheet, curve))
    signs = add_layer(root, "STATES", _TEXT)
    for line, state in zip(curve.segments_mm, curve.states, strict=True):
        x, y = sheet.on_page(_beside(line, state)[None, :])[0].tolist()
        add_text(signs, state, (x, y), "")
    add_reference(root, sheet)
    return svg_text(root)


def _beside(line: Vectors, state: str) -> Vectors:
    """Give a place on the convex side of a segment's middle."""
    middle, along = line[len(line) // 2], line[-1] - line[0]
    left = np.array([-along[1], along[0]]) / np.linalg.norm(along)
    return middle + _AWAY_MM * (left if state == "+" else -left)


def _rivets(sheet: Sheet, curve: ChainCurve) -> Iterator[str]:
    for x, y in sheet.on_page(curve.rivets_mm).tolist():
        r, across = number(_RIVET_MM), number(2 * _RIVET_MM)
        halves = f"a {r},{r} 0 1 0 {across},0 a {r},{r} 0 1 0 -{across},0"
        yield f"M {number(x - _RIVET_MM)},{number(y)} {halves} Z"
