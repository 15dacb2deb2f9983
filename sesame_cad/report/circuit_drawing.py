"""The circuit: the wire in its stages, its terminals, and the resistance between them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from patterns.circuit import CrossingKind
from sesame_cad.drawing_colours import stage_colour
from sesame_cad.files.sheet import Sheet
from sesame_cad.files.svg_page import number
from sesame_cad.files.wire_path import wire_path
from sesame_cad.pipeline import Pattern
from sesame_cad.report.cut_drawing import fabric_path, plan_sheet, text_size
from sesame_cad.report.inline_svg import dot, drawing, path, words

Data = dict[str, Any]


def circuit_drawing(laid: Pattern, circuits: list[Data], diameters_mm: tuple[float, ...]) -> str:
    """Draw the wire of every stage in its colour.

    Parameters
    ----------
    circuits : list of dict
        What `design.json` says of each.
    diameters_mm : tuple of float
        Of the wire of each stage.
    """
    sheet = plan_sheet(laid)
    label = f"{len(laid.circuit.stages)} stages of the wire, with their terminals"
    parts = _parts(laid, sheet, circuits, diameters_mm)
    return drawing(sheet.width_mm, sheet.height_mm, label, parts)


def _parts(
    laid: Pattern, sheet: Sheet, circuits: list[Data], diameters_mm: tuple[float, ...]
) -> Iterator[str]:
    yield path(fabric_path(laid, sheet), "fabric", fill_rule="evenodd")
    for k, stage in enumerate(laid.circuit.stages):
        width = number(max(diameters_mm[k], sheet.width_mm / 500))
        yield path(wire_path(sheet, stage), "wire", stroke=stage_colour(k), stroke_width=width)
    size = text_size(sheet)
    for crossing in laid.circuit.crossings:
        ((x, y),) = sheet.on_page(np.array([(crossing.x_mm, crossing.y_mm)])).tolist()
        kind = "contact" if crossing.kind is CrossingKind.CONTACT else "terminal crossing"
        yield dot((x, y), size / 4, "crossing", kind)
    for circuit in circuits:
        yield from _terminals(sheet, circuit, size, several=len(circuits) > 1)


def _terminals(sheet: Sheet, circuit: Data, size: float, *, several: bool) -> Iterator[str]:
    ends = sheet.on_page(np.array(circuit["terminals_mm"])).tolist()
    middle = sheet.width_mm / 2
    for (x, y), letter in zip(ends, "AB", strict=True):
        yield dot((x, y), size / 3, "terminal", f"terminal {letter} of circuit {circuit['name']}")
        anchor, aside = ("start", 0.6 * size) if x < middle else ("end", -0.6 * size)
        name = f"{circuit['name']} {letter}" if several else letter
        yield words((x + aside, y + 0.35 * size), size, name, anchor=anchor)
