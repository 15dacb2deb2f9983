"""Cut files for laser and knife plotters: SVG whose user unit is one millimetre."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from patterns.loop_ring import Ring
from patterns.outline import Outline
from patterns.registration import Mark
from sesame_cad.errors import DesignFileError
from sesame_cad.files.sheet import Sheet, lay_out
from sesame_cad.files.svg_page import (
    CORNER,
    INKSCAPE,
    SVG,
    add_layer,
    add_reference,
    line_path,
    svg_page,
    svg_text,
)

Strokes = tuple[NDArray[np.float64], ...]

_HAIRLINE = "fill:none;stroke-width:0.1;stroke:"
_COLOURS = {"HOLE": "#0000ff", "CUT": "#ff0000", "MARK": "#000000"}
_POINT = r"-?\d+(?:\.\d+)?,-?\d+(?:\.\d+)?"
_LENGTH = r"\d+(?:\.\d+)?mm"
_PATH = re.compile(rf"M ({_POINT}(?: L {_POINT})*)( Z)?")


def outline_svg(outline: Outline, marks: tuple[Mark, ...], name: str) -> str:
    """Draw cut lines and marks, 1:1, inner lines first.

    Layers: HOLE (openings), CUT (outside), MARK (registration), REFERENCE (a 100 mm bar to check
    the scale after import; not cut).

    Parameters
    ----------
    name : str
        Title of the drawing.
    """
    sheet = lay_out(outline, marks)
    root = svg_page(sheet, name)
    holes = [line_path(sheet, ring, closed=True) for ring in outline.openings]
    strokes = [line_path(sheet, stroke, closed=False) for mark in marks for stroke in mark.strokes]
    for layer, paths in (
        ("HOLE", holes),
        ("CUT", [line_path(sheet, ring, closed=True) for ring in outline.outsides]),
        ("MARK", strokes),
    ):
        add_layer(root, layer, _HAIRLINE + _COLOURS[layer], paths)
    add_reference(root, sheet)
    return svg_text(root)


def read_outline_svg(data: bytes) -> tuple[Outline, Strokes]:
    """Read the cut lines and strokes back, in the design's coordinates.

    Raises
    ------
    DesignFileError
        When the page is not in millimetres, a cut line is open, or a layer is missing.
    """
    root = parse_svg(data)
    sheet = read_sheet(root)
    layers = {
        group.get(f"{{{INKSCAPE}}}label"): [
            _points(path, sheet) for path in group.iter(f"{{{SVG}}}path")
        ]
        for group in root.iter(f"{{{SVG}}}g")
    }
    missing = {"CUT", "HOLE", "MARK"} - set(layers)
    if missing:
        raise DesignFileError(f"the SVG has no layer {', '.join(sorted(missing))}")
    for layer in ("CUT", "HOLE"):
        if not all(closed for _, closed in layers[layer]):
            raise DesignFileError(f"a line on layer {layer} of the SVG is not closed")
    if not layers["CUT"]:
        raise DesignFileError("0 lines on the SVG's layer CUT instead of one or more")
    (outside, _), *further = layers["CUT"]
    openings = tuple(ring for ring, _ in layers["HOLE"])
    outline = Outline(outside, openings, tuple(ring for ring, _ in further))
    return outline, tuple(stroke for stroke, _ in layers["MARK"])


def parse_svg(data: bytes) -> ElementTree.Element:
    """Read a drawing without entities; raises `DesignFileError` when it is none."""
    try:
        text = data.decode("utf-8")
        if "<!DOCTYPE" in text or "<!ENTITY" in text:
            raise DesignFileError("the SVG declares entities; these cut files have none")
        return ElementTree.fromstring(text.removeprefix('<?xml version="1.0" encoding="UTF-8"?>'))
    except (ElementTree.ParseError, UnicodeDecodeError) as error:
        raise DesignFileError(f"this is no SVG: {error}") from error


def read_sheet(root: ElementTree.Element) -> Sheet:
    """Find where a page lies; raises `DesignFileError` when it is not in true millimetres."""
    width, height = root.get("width", ""), root.get("height", "")
    if not (re.fullmatch(_LENGTH, width) and re.fullmatch(_LENGTH, height)):
        raise DesignFileError(f"the SVG's page is not in mm: width {width!r}, height {height!r}")
    wanted = f"0 0 {width[:-2]} {height[:-2]}"
    if root.get("viewBox") != wanted:
        raise DesignFileError(f"the SVG's viewBox is {root.get('viewBox')!r} instead of {wanted!r}")
    if any(element.get("transform") for element in root.iter()):
        raise DesignFileError("the SVG moves or scales its parts; these cut files do not")
    corner = root.get(CORNER, "")
    if not re.fullmatch(_POINT, corner):
        raise DesignFileError(f"the SVG does not say where its page lies: no {CORNER}")
    left, top = (float(part) for part in corner.split(","))
    return Sheet(left, top, float(width[:-2]), float(height[:-2]), np.empty((0, 2)))


def _points(path: ElementTree.Element, sheet: Sheet) -> tuple[Ring, bool]:
    found = _PATH.fullmatch(path.get("d", ""))
    if not found:
        raise DesignFileError("a path of the SVG is no plain line: M x,y L x,y ... Z")
    pairs = [pair.split(",") for pair in found[1].split(" L ")]
    return sheet.off_page(np.array(pairs, dtype=np.float64)), bool(found[2])
