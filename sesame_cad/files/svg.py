"""Cut files for laser and knife plotters: SVG whose user unit is one millimetre."""

from __future__ import annotations

import re
from collections.abc import Iterable
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from patterns.outline import Outline, Ring
from patterns.registration import Mark
from sesame_cad.errors import DesignFileError
from sesame_cad.files.sheet import CHECK_BAR_MM, Sheet, lay_out

Strokes = tuple[NDArray[np.float64], ...]

_SVG = "http://www.w3.org/2000/svg"
_INKSCAPE = "http://www.inkscape.org/namespaces/inkscape"
_CORNER = "data-upper-left-mm"
_HAIRLINE = "fill:none;stroke-width:0.1;stroke:"
_COLOURS = {"HOLE": "#0000ff", "CUT": "#ff0000", "MARK": "#000000", "REFERENCE": "#808080"}
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
    root = _page(sheet, name)
    _layer(root, "HOLE", [_path(sheet, ring, closed=True) for ring in outline.openings])
    _layer(root, "CUT", [_path(sheet, ring, closed=True) for ring in outline.outsides])
    strokes = [_path(sheet, stroke, closed=False) for mark in marks for stroke in mark.strokes]
    _layer(root, "MARK", strokes)
    _reference(root, sheet)
    ElementTree.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ElementTree.tostring(root, "unicode") + "\n"


def read_outline_svg(data: bytes) -> tuple[Outline, Strokes]:
    """Read the cut lines and strokes back, in the design's coordinates.

    Raises
    ------
    DesignFileError
        When the page is not in millimetres, a cut line is open, or a layer is missing.
    """
    root = _parse(data)
    sheet = _read_sheet(root)
    layers = {
        group.get(f"{{{_INKSCAPE}}}label"): [
            _points(path, sheet) for path in group.iter(f"{{{_SVG}}}path")
        ]
        for group in root.iter(f"{{{_SVG}}}g")
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


def _page(sheet: Sheet, name: str) -> ElementTree.Element:
    ElementTree.register_namespace("", _SVG)
    ElementTree.register_namespace("inkscape", _INKSCAPE)
    width, height = _number(sheet.width_mm), _number(sheet.height_mm)
    size = {"width": f"{width}mm", "height": f"{height}mm", "viewBox": f"0 0 {width} {height}"}
    corner = {_CORNER: f"{_number(sheet.left_mm)},{_number(sheet.top_mm)}"}
    root = ElementTree.Element(f"{{{_SVG}}}svg", {"version": "1.1", **size, **corner})
    title = ElementTree.SubElement(root, f"{{{_SVG}}}title")
    title.text = "".join(c if c.isprintable() else " " for c in name)
    return root


def _layer(root: ElementTree.Element, label: str, paths: Iterable[str]) -> ElementTree.Element:
    group = ElementTree.SubElement(
        root,
        f"{{{_SVG}}}g",
        {
            "id": label,
            f"{{{_INKSCAPE}}}groupmode": "layer",
            f"{{{_INKSCAPE}}}label": label,
            "style": _HAIRLINE + _COLOURS[label],
        },
    )
    for path in paths:
        ElementTree.SubElement(group, f"{{{_SVG}}}path", {"d": path})
    return group


def _reference(root: ElementTree.Element, sheet: Sheet) -> None:
    bar = _path(sheet, sheet.check_bar, closed=False)
    group = _layer(root, "REFERENCE", [bar])
    group[0].set("style", "stroke-dasharray:2,1")
    x, y = sheet.on_page(sheet.check_bar)[0]
    style = "font:3px sans-serif;stroke:none;fill:#808080"
    place = {"x": _number(x), "y": _number(y - 1.5), "style": style}
    text = ElementTree.SubElement(group, f"{{{_SVG}}}text", place)
    text.text = f"{CHECK_BAR_MM:g} mm - do not cut"


def _path(sheet: Sheet, line: Ring, *, closed: bool) -> str:
    corners = (f"{_number(x)},{_number(y)}" for x, y in sheet.on_page(line))
    return "M " + " L ".join(corners) + (" Z" if closed else "")


def _number(value_mm: float) -> str:
    """Millimetres to 0.001, without -0."""
    return f"{round(value_mm, 3) + 0.0:.3f}"


def _parse(data: bytes) -> ElementTree.Element:
    try:
        text = data.decode("utf-8")
        if "<!DOCTYPE" in text or "<!ENTITY" in text:
            raise DesignFileError("the SVG declares entities; these cut files have none")
        return ElementTree.fromstring(text.removeprefix('<?xml version="1.0" encoding="UTF-8"?>'))
    except (ElementTree.ParseError, UnicodeDecodeError) as error:
        raise DesignFileError(f"this is no SVG: {error}") from error


def _read_sheet(root: ElementTree.Element) -> Sheet:
    width, height = root.get("width", ""), root.get("height", "")
    if not (re.fullmatch(_LENGTH, width) and re.fullmatch(_LENGTH, height)):
        raise DesignFileError(f"the SVG's page is not in mm: width {width!r}, height {height!r}")
    wanted = f"0 0 {width[:-2]} {height[:-2]}"
    if root.get("viewBox") != wanted:
        raise DesignFileError(f"the SVG's viewBox is {root.get('viewBox')!r} instead of {wanted!r}")
    if any(element.get("transform") for element in root.iter()):
        raise DesignFileError("the SVG moves or scales its parts; these cut files do not")
    corner = root.get(_CORNER, "")
    if not re.fullmatch(_POINT, corner):
        raise DesignFileError(f"the SVG does not say where its page lies: no {_CORNER}")
    left, top = (float(part) for part in corner.split(","))
    return Sheet(left, top, float(width[:-2]), float(height[:-2]), np.empty((0, 2)))


def _points(path: ElementTree.Element, sheet: Sheet) -> tuple[Ring, bool]:
    found = _PATH.fullmatch(path.get("d", ""))
    if not found:
        raise DesignFileError("a path of the SVG is no plain line: M x,y L x,y ... Z")
    pairs = [pair.split(",") for pair in found[1].split(" L ")]
    return sheet.off_page(np.array(pairs, dtype=np.float64)), bool(found[2])
