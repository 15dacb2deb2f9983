"""Sheets to cut as SVG: exact arcs and circles, true millimetres, inner lines first."""

from __future__ import annotations

import re
from math import asin, copysign, hypot, tan
from xml.etree import ElementTree

import numpy as np

from patterns.mat import Mat
from sesame_cad.errors import DesignFileError
from sesame_cad.files.cut_line import CUT, HOLE, CutLine
from sesame_cad.files.sheet import CHECK_BAR_MM, Sheet
from sesame_cad.files.svg import parse_svg, read_sheet
from sesame_cad.files.svg_page import (
    INKSCAPE,
    SVG,
    add_layer,
    add_reference,
    number,
    svg_page,
    svg_text,
)

_HAIRLINE = "fill:none;stroke-width:0.1;stroke:"
_COLOURS = {HOLE: "#0000ff", CUT: "#ff0000"}
_BELOW_MM = 8.0
"""Room under the mat for the check bar."""

_NUMBER = r"-?\d+(?:\.\d+)?"
_POINT = rf"({_NUMBER}),({_NUMBER})"
_STEP = re.compile(rf" L {_POINT}| A ({_NUMBER}),{_NUMBER} 0 0,([01]) {_POINT}")
_START = re.compile(rf"M {_POINT}")


def cut_svg(lines: tuple[CutLine, ...], mat: Mat, name: str) -> str:
    """Draw a sheet; the page is the mat, with the check bar below it.

    Layers: HOLE (inside pieces), CUT (outsides), REFERENCE (a 100 mm bar; not cut).
    """
    sheet = mat_sheet(mat)
    root = svg_page(sheet, name)
    for layer in (HOLE, CUT):
        own = [line for line in lines if line.layer == layer]
        group = add_layer(root, layer, _HAIRLINE + _COLOURS[layer])
        for line in own:
            add_cut_line(group, sheet, line)
    add_reference(root, sheet)
    return svg_text(root)


def mat_sheet(mat: Mat) -> Sheet:
    """Give the page of a mat; its lower left corner is the origin."""
    bar = np.array([(5.0, -_BELOW_MM / 2), (5.0 + CHECK_BAR_MM, -_BELOW_MM / 2)])
    width = max(mat.width_mm, CHECK_BAR_MM + 10.0)
    return Sheet(0.0, mat.height_mm, width, mat.height_mm + _BELOW_MM, bar)


def add_cut_line(group: ElementTree.Element, sheet: Sheet, line: CutLine) -> None:
    """Draw a line on a page."""
    if line.is_circle:
        x, y, diameter = line.vertices[0].tolist()
        (centre,) = sheet.on_page(np.array([(x, y)])).tolist()
        place = {"cx": number(centre[0]), "cy": number(centre[1]), "r": f"{diameter / 2:.4f}"}
        ElementTree.SubElement(group, f"{{{SVG}}}circle", place)
    else:
        ElementTree.SubElement(group, f"{{{SVG}}}path", {"d": cut_line_path(sheet, line)})


def cut_line_path(sheet: Sheet, line: CutLine) -> str:
    """Path data of a line, its arcs exact."""
    places = sheet.on_page(line.vertices[:, :2]).tolist()
    bulges = line.vertices[:, 2].tolist()
    parts = [f"M {_place(places[0])}"]
    # the last straight side is drawn by Z
    following = [*places[1:], *(places[:1] if line.closed and bulges[-1] else [])]
    for start, end, bulge in zip(places, following, bulges, strict=False):
        if bulge:
            chord = hypot(end[0] - start[0], end[1] - start[1])
            radius = chord * (1 + bulge**2) / (4 * abs(bulge))
            sweep = int(bulge < 0)  # y is down there
            parts.append(f"A {radius:.4f},{radius:.4f} 0 0,{sweep} {_place(end)}")
        else:
            parts.append(f"L {_place(end)}")
    return " ".join(parts) + (" Z" if line.closed else "")


def _place(point: list[float]) -> str:
    return f"{number(point[0])},{number(point[1])}"


def read_cut_svg(data: bytes) -> tuple[CutLine, ...]:
    """Read the lines of a sheet back, inner lines first.

    Raises
    ------
    DesignFileError
        When the page is not in millimetres, a layer is missing, or a line is not of this form.
    """
    root = parse_svg(data)
    sheet = read_sheet(root)
    groups = {group.get(f"{{{INKSCAPE}}}label"): group for group in root.iter(f"{{{SVG}}}g")}
    missing = {HOLE, CUT} - set(groups)
    if missing:
        raise DesignFileError(f"the SVG has no layer {', '.join(sorted(missing))}")
    return tuple(
        _read_line(element, layer, sheet) for layer in (HOLE, CUT) for element in groups[layer]
    )


def _read_line(element: ElementTree.Element, layer: str, sheet: Sheet) -> CutLine:
    if element.tag == f"{{{SVG}}}circle":
        try:
            x, y, radius = (float(element.get(key, "")) for key in ("cx", "cy", "r"))
        except ValueError:
            raise DesignFileError("a circle of the SVG has no centre or radius") from None
        (centre,) = sheet.off_page(np.array([(x, y)])).tolist()
        return CutLine(layer, True, np.array([[*centre, 2 * radius]]))
    text = element.get("d", "")
    closed = text.endswith(" Z")
    found, text = _START.match(text), text.removesuffix(" Z")
    if element.tag != f"{{{SVG}}}path" or not found:
        raise DesignFileError(f"layer {layer} of the SVG holds more than lines, arcs and circles")
    places, bulges = [(float(found[1]), float(found[2]))], list[float]()
    at = found.end()
    while at < len(text):
        step = _STEP.match(text, at)
        if not step:
            raise DesignFileError("a path of the SVG is not made of M, L, A and Z")
        places.append(_end(step))
        bulges.append(_bulge(places[-2], step))
        at = step.end()
    points = sheet.off_page(np.array(places))
    if closed and bulges and bulges[-1] and np.hypot(*(points[-1] - points[0])) < 1e-9:
        points = points[:-1]
    bulges += [0.0] * (len(points) - len(bulges))
    return CutLine(layer, closed, np.column_stack([points, bulges]))


def _end(step: re.Match[str]) -> tuple[float, float]:
    if step[3] is None:
        return float(step[1]), float(step[2])
    return float(step[5]), float(step[6])


def _bulge(start: tuple[float, float], step: re.Match[str]) -> float:
    """Bulge of an arc of at most half a turn; 0 of a straight side."""
    if step[3] is None:
        return 0.0
    x, y = _end(step)
    half = min(1.0, hypot(x - start[0], y - start[1]) / 2 / float(step[3]))
    return copysign(tan(asin(half) / 2), -1.0 if step[4] == "1" else 1.0)
