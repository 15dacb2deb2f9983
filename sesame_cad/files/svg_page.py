"""SVG pages whose user unit is one millimetre, with layers as Inkscape knows them."""

from __future__ import annotations

import re
from collections.abc import Iterable
from xml.etree import ElementTree

from patterns.loop_ring import Ring
from sesame_cad.files.sheet import CHECK_BAR_MM, Sheet

SVG = "http://www.w3.org/2000/svg"
INKSCAPE = "http://www.inkscape.org/namespaces/inkscape"
CORNER = "data-upper-left-mm"

_MINUS_ZERO = re.compile(r"-0\.000\b")
_REFERENCE = "fill:none;stroke-width:0.1;stroke:#808080"


def svg_page(sheet: Sheet, name: str) -> ElementTree.Element:
    """Make an empty page with a title."""
    ElementTree.register_namespace("", SVG)
    ElementTree.register_namespace("inkscape", INKSCAPE)
    width, height = number(sheet.width_mm), number(sheet.height_mm)
    size = {"width": f"{width}mm", "height": f"{height}mm", "viewBox": f"0 0 {width} {height}"}
    corner = {CORNER: f"{number(sheet.left_mm)},{number(sheet.top_mm)}"}
    root = ElementTree.Element(f"{{{SVG}}}svg", {"version": "1.1", **size, **corner})
    title = ElementTree.SubElement(root, f"{{{SVG}}}title")
    title.text = "".join(c if c.isprintable() else " " for c in name)
    return root


def add_layer(
    root: ElementTree.Element, label: str, style: str, paths: Iterable[str] = ()
) -> ElementTree.Element:
    """Add a layer with a path for each of some path data."""
    group = ElementTree.SubElement(
        root,
        f"{{{SVG}}}g",
        {
            "id": label,
            f"{{{INKSCAPE}}}groupmode": "layer",
            f"{{{INKSCAPE}}}label": label,
            "style": style,
        },
    )
    for path in paths:
        ElementTree.SubElement(group, f"{{{SVG}}}path", {"d": path})
    return group


def add_text(
    group: ElementTree.Element, text: str, place: tuple[float, float], style: str
) -> ElementTree.Element:
    """Write a line at a place of the page."""
    where = {"x": number(place[0]), "y": number(place[1]), "style": style}
    element = ElementTree.SubElement(group, f"{{{SVG}}}text", where)
    element.text = "".join(c if c.isprintable() else " " for c in text)
    return element


def add_reference(root: ElementTree.Element, sheet: Sheet) -> None:
    """Add the layer REFERENCE: the bar by which the scale is checked after import."""
    bar = line_path(sheet, sheet.check_bar, closed=False)
    group = add_layer(root, "REFERENCE", _REFERENCE, [bar])
    group[0].set("style", "stroke-dasharray:2,1")
    x, y = sheet.on_page(sheet.check_bar)[0]
    style = "font:3px sans-serif;stroke:none;fill:#808080"
    add_text(group, f"{CHECK_BAR_MM:g} mm - do not cut", (float(x), float(y) - 1.5), style)


def line_path(sheet: Sheet, line: Ring, *, closed: bool) -> str:
    """Path data of straight edges."""
    place = sheet.on_page(line)
    # As `number` makes them, all at once.
    corners = " L ".join(["%.3f,%.3f"] * len(place)) % tuple(place.ravel().tolist())
    return "M " + _MINUS_ZERO.sub("0.000", corners) + (" Z" if closed else "")


def number(value_mm: float) -> str:
    """Millimetres to 0.001, without -0."""
    return f"{round(value_mm, 3) + 0.0:.3f}"


def svg_text(root: ElementTree.Element) -> str:
    """Write the page, indented."""
    ElementTree.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ElementTree.tostring(root, "unicode") + "\n"
