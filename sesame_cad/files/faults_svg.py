"""The plan as a drawing in layers, with broken rules on top."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from textwrap import wrap
from xml.etree import ElementTree

import numpy as np

from patterns.circuit import Diameters
from patterns.numbered_faults import NumberedFaults, numbered_faults
from patterns.violation import Violation
from sesame_cad.files.plan_svg import draw_plan
from sesame_cad.files.sheet import MARGIN_MM, Sheet, lay_out
from sesame_cad.files.svg_page import add_layer, add_reference, add_text, number, svg_page, svg_text
from sesame_cad.pipeline import Pattern

RED = "#e00000"

_CIRCLE_MM = 2.0
_TEXT = f"stroke:none;fill:{RED};font-family:sans-serif;font-size:"
_TEXT_MM, _LINE_MM = 3.0, 4.2
_CHARACTER_MM = 0.6 * _TEXT_MM
"""Room for a character of a sans-serif font."""


def faults_svg(
    laid: Pattern, violations: tuple[Violation, ...], wire_diameter_mm: Diameters, name: str
) -> str:
    """Draw the layers of `plan_svg`, and VIOLATIONS-rule for each broken rule.

    A violation is a circle around its place; numbers lead to the lines of the layer LEGEND.
    """
    sheet = lay_out(laid.outline, laid.marks)
    rules = numbered_faults(violations)
    width = int((sheet.width_mm - 2 * MARGIN_MM) / _CHARACTER_MM)
    lines = [part for rule in rules for line in rule.legend() for part in wrap(line, width)]
    below = sheet.height_mm
    longer = replace(sheet, height_mm=below + _LINE_MM * len(lines) + MARGIN_MM)
    root = svg_page(longer, f"{name}: broken rules")
    draw_plan(root, sheet, laid, wire_diameter_mm)
    add_reference(root, sheet)
    for rule in rules:
        _add_rule(root, sheet, rule)
    legend = add_layer(root, "LEGEND", f"{_TEXT}{_TEXT_MM}px")
    for k, line in enumerate(lines, start=1):
        add_text(legend, line, (MARGIN_MM, below + _LINE_MM * k), "")
    return svg_text(root)


def _add_rule(root: ElementTree.Element, sheet: Sheet, rule: NumberedFaults) -> None:
    style = f"fill:none;stroke-width:0.4;stroke:{RED}"
    places = [violation for _, violation in rule.numbered]
    circles = "".join(_circles(sheet, [*places, *rule.others]))
    group = add_layer(root, f"VIOLATIONS-{rule.rule}", style, [circles])
    for place, text in rule.labels().items():
        x, y = _on_page(sheet, *place)
        style = f"{_TEXT}{_TEXT_MM}px;font-weight:bold"
        add_text(group, text, (x + _CIRCLE_MM, y - _CIRCLE_MM), style)


def _circles(sheet: Sheet, violations: list[Violation]) -> Iterator[str]:
    """Path data of a circle in two halves for each violation."""
    radius = number(_CIRCLE_MM)
    for violation in violations:
        x, y = _on_page(sheet, violation.x_mm, violation.y_mm)
        left, right, level = number(x - _CIRCLE_MM), number(x + _CIRCLE_MM), number(y)
        half = f"A {radius},{radius} 0 0,1"
        yield f"M {left},{level} {half} {right},{level} {half} {left},{level} Z "


def _on_page(sheet: Sheet, x_mm: float, y_mm: float) -> tuple[float, float]:
    x, y = sheet.on_page(np.array([[x_mm, y_mm]]))[0]
    return float(x), float(y)
