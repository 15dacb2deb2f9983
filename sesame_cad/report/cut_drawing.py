"""The cut sheet: outlines on a mat with their sizes, as the fabric lies stretched in the hoop."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from sesame_cad.files.sheet import Sheet, lay_out
from sesame_cad.files.svg_page import line_path, number
from sesame_cad.pipeline import Pattern
from sesame_cad.report.inline_svg import dimension, drawing, path

GRID_MM = 10


def plan_sheet(laid: Pattern) -> Sheet:
    """Give the sheet of the cut files, with room for dimensions above and to the left."""
    sheet = lay_out(laid.outline, laid.marks)
    room = text_size(sheet) * 2.5
    return replace(
        sheet,
        left_mm=sheet.left_mm - room,
        top_mm=sheet.top_mm + room,
        width_mm=sheet.width_mm + room,
        height_mm=sheet.height_mm + room,
    )


def text_size(sheet: Sheet) -> float:
    """Height of letters that can be read when the sheet fills a page's width."""
    return max(sheet.width_mm, sheet.height_mm) / 45


def cut_drawing(laid: Pattern) -> str:
    """Draw cut lines and marks with their sizes in mm, on a mat ruled in centimetres."""
    sheet = plan_sheet(laid)
    left, bottom, right, top = laid.outline.bounds_mm
    label = f"cut lines, {right - left:.1f} mm wide and {top - bottom:.1f} mm high"
    return drawing(sheet.width_mm, sheet.height_mm, label, _parts(laid, sheet))


def fabric_path(laid: Pattern, sheet: Sheet) -> str:
    """Path data of all fabric that is kept."""
    return " ".join(line_path(sheet, ring, closed=True) for ring in laid.outline.rings)


def _parts(laid: Pattern, sheet: Sheet) -> Iterator[str]:
    yield path(mat_grid(sheet), "mat")
    yield path(fabric_path(laid, sheet), "fabric", fill_rule="evenodd")
    for kind, rings in (("cut", laid.outline.outsides), ("hole", laid.outline.openings)):
        yield path(" ".join(line_path(sheet, ring, closed=True) for ring in rings) or "M0,0", kind)
    strokes = [stroke for mark in laid.marks for stroke in mark.strokes]
    if strokes:
        yield path(" ".join(line_path(sheet, one, closed=False) for one in strokes), "mark")
    yield from _dimensions(laid, sheet)


def mat_grid(sheet: Sheet) -> str:
    """Lines every centimetre of the page."""
    width, height = number(sheet.width_mm), number(sheet.height_mm)
    upright = (f"M{x},0V{height}" for x in range(0, int(sheet.width_mm) + 1, GRID_MM))
    level = (f"M0,{y}H{width}" for y in range(0, int(sheet.height_mm) + 1, GRID_MM))
    return "".join([*upright, *level])


def _dimensions(laid: Pattern, sheet: Sheet) -> Iterator[str]:
    """Size of all fabric, and of the last loop, which no tail comes near in most layouts."""
    size = text_size(sheet)
    left, bottom, right, top = laid.outline.bounds_mm
    corners = sheet.on_page(np.array([(left, top), (right, bottom)]))
    (x1, y1), (x2, y2) = corners.tolist()
    above, aside = 1.2 * size, 1.6 * size
    yield from dimension((x1, above), (x2, above), size, f"{right - left:.1f} mm")
    yield from dimension((aside, y1), (aside, y2), size, f"{top - bottom:.1f} mm")
    loop = laid.circuit.layout.loops[-1]
    ((x, y),) = sheet.on_page(np.array([(loop.x_mm, loop.y_mm)])).tolist()
    half = loop.width_mm / 2
    small = min(size, loop.width_mm / 11)
    yield from dimension((x - half, y), (x + half, y), small, f"loop {loop.width_mm:.1f} mm wide")
