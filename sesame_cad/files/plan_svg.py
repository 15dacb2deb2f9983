"""The whole plan as one drawing in layers, 1:1, for Inkscape or a browser."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree import ElementTree

import numpy as np

from patterns.circuit import Circuit, Diameters
from patterns.loop_order import loops_in_order
from patterns.plan import UNITS_PER_MM, Block, Points
from sesame_cad.drawing_colours import MARK, block_colour, stage_colour
from sesame_cad.files.sheet import Sheet, lay_out
from sesame_cad.files.svg_page import (
    add_layer,
    add_reference,
    add_text,
    line_path,
    number,
    svg_page,
    svg_text,
)
from sesame_cad.files.wire_path import wire_path
from sesame_cad.pipeline import Pattern

_LINE = "fill:none;stroke-linejoin:round;stroke-width:"
_LABEL = "stroke:none;font-family:sans-serif;text-anchor:middle;"
_NEEDLE_MM, _STITCH_MM, _CUT_MM = 0.2, 0.12, 0.1
_CUT = "#ff0000"
_ASIDE_MM = 6.0


def plan_svg(laid: Pattern, wire_diameter_mm: Diameters, name: str) -> str:
    """Draw everything that is laid, sewn and cut.

    Layers, from the bottom: OUTLINE; MARKS; WIRE-k, the centreline of stage k in lines and arcs, as
    wide as the wire; STITCHES-k and NEEDLES-k of each block k; LABELS; REFERENCE, a 100 mm bar.
    A layer of stitches has a path with a line for each run, one of needle points a path with a dot
    for each, so a drawing has few elements however many stitches there are.
    """
    sheet = lay_out(laid.outline, laid.marks)
    root = svg_page(sheet, name)
    draw_plan(root, sheet, laid, wire_diameter_mm)
    add_reference(root, sheet)
    return svg_text(root)


def draw_plan(
    root: ElementTree.Element,
    sheet: Sheet,
    laid: Pattern,
    wire_diameter_mm: Diameters,
    prefix: str = "",
) -> None:
    """Add the layers of `plan_svg` but the last to a page; their names begin with a prefix."""
    rings = [line_path(sheet, ring, closed=True) for ring in laid.outline.rings]
    add_layer(root, f"{prefix}OUTLINE", f"{_LINE}{_CUT_MM};stroke:{_CUT}", rings)
    strokes = [
        line_path(sheet, stroke, closed=False) for mark in laid.marks for stroke in mark.strokes
    ]
    add_layer(root, f"{prefix}MARKS", f"{_LINE}{_CUT_MM};stroke:{MARK}", strokes)
    diameters_mm = laid.circuit.of_stages(wire_diameter_mm)
    for k, stage in enumerate(laid.circuit.stages):
        style = f"{_LINE}{number(diameters_mm[k])};stroke-opacity:0.5;stroke:{stage_colour(k)}"
        add_layer(root, f"{prefix}WIRE-{k + 1}", style, [wire_path(sheet, stage)])
    for k, block in enumerate(laid.plan.blocks, start=1):
        colour = block_colour(block)
        style = f"{_LINE}{_STITCH_MM};stroke:{colour}"
        add_layer(root, f"{prefix}STITCHES-{k}", style, [_stitches(sheet, block)])
        dots = f"{_LINE}{_NEEDLE_MM};stroke-linecap:round;stroke:{colour}"
        add_layer(root, f"{prefix}NEEDLES-{k}", dots, [_needles(sheet, block)])
    _add_labels(root, sheet, laid.circuit, f"{prefix}LABELS")


def _stitches(sheet: Sheet, block: Block) -> str:
    """Give each run as a line from its first needle point to its last."""
    return "".join(
        f"M{_place(sheet, run.needles)}l{' '.join(_steps(run.needles))}" for run in block.runs
    )


def _needles(sheet: Sheet, block: Block) -> str:
    """Give each needle point as a line of no length, which round ends make a dot."""
    needles = np.concatenate([run.needles for run in block.runs])
    return "m".join([f"M{_place(sheet, needles)}h0", *(f"{step}h0" for step in _steps(needles))])


def _place(sheet: Sheet, needles: Points) -> str:
    x, y = sheet.on_page(needles[:1] / UNITS_PER_MM)[0]
    return f"{x:g},{y:g}"


def _steps(needles: Points) -> list[str]:
    """Displacements in mm, exact to the last figure: they are whole tenths."""
    step = np.diff(needles, axis=0) * (1, -1)
    if not len(step):
        return []
    low, width = step.min(axis=0), int(np.ptp(step[:, 1])) + 1
    code = (step[:, 0] - low[0]) * width + step[:, 1] - low[1]
    kinds, which = np.unique(code, return_inverse=True)
    tenths = np.stack(np.divmod(kinds, width), axis=1) + low
    texts = [f"{x / UNITS_PER_MM:g},{y / UNITS_PER_MM:g}" for x, y in tenths.tolist()]
    return [texts[k] for k in which.tolist()]


def _add_labels(root: ElementTree.Element, sheet: Sheet, circuit: Circuit, layer: str) -> None:
    loops = circuit.layout.loops
    group = add_layer(root, layer, _LABEL)
    for order, k in enumerate(loops_in_order(circuit), start=1):
        size = min(8.0, loops[k].width_mm / 5)
        style = f"font-size:{number(size)}px;fill:#333333"
        (place,) = sheet.on_page(np.array([[loops[k].x_mm, loops[k].y_mm]]))
        add_text(group, str(order), (float(place[0]), float(place[1]) + size / 3), style)
    for text, place, colour in _ends(circuit):
        (x, y), style = sheet.on_page(place)[0], f"font-size:4px;fill:{colour}"
        add_text(group, text, (float(x), float(y)), style)


def _ends(circuit: Circuit) -> Iterator[tuple[str, np.ndarray, str]]:
    """Labels of the terminals, beyond the wire, and of the stages, beside their first points."""
    for k, stage in enumerate(circuit.stages):
        begins = circuit.begins_wire(k)
        place, along = stage.at(0.0)
        away = -along if begins else along[:, ::-1] * (1, -1)
        yield "start" if begins else circuit.own_name(k), place + _ASIDE_MM * away, stage_colour(k)
        if circuit.ends_wire(k):
            place, along = stage.at(stage.length_mm)
            yield "end", place + _ASIDE_MM * along, stage_colour(k)
