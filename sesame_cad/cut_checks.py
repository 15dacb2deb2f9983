"""Cut files read back: is the outline in them the one that was designed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from types import MappingProxyType
from typing import Any

import numpy as np

from patterns.outline import Outline
from patterns.rules import check_outline
from sesame_cad.errors import DesignFileError
from sesame_cad.files.dxf import read_outline_dxf
from sesame_cad.files.svg import read_outline_svg
from sesame_cad.pipeline import Design

OUTLINE_TOLERANCE_MM = 0.002
"""Cut files hold three decimals."""

CUT_READERS = MappingProxyType[str, Callable[[bytes], tuple[Outline, Any]]](
    {"svg": read_outline_svg, "dxf": read_outline_dxf}
)


def cut_faults(content: bytes, kind: str, made: Design) -> Iterator[str]:
    """Compare a cut file with the design, and hold what it says against the design rules."""
    spec, laid = made.spec, made.pattern
    try:
        outline, strokes = CUT_READERS[kind](content)
    except DesignFileError as error:
        yield str(error)
        return
    faults = [*_outline_faults(outline, laid.outline)]
    yield from faults
    expected = [stroke for mark in laid.marks for stroke in mark.strokes]
    if not _same_lines(strokes, expected):
        yield "the registration marks are not those of the stitch file"
    if faults:  # the designed outline keeps every rule, and so does one that is the same
        margin = spec.outline.margin_mm - OUTLINE_TOLERANCE_MM
        violations = check_outline(outline, laid.circuit, spec.diameters_mm, margin, laid.plan)
        yield from map(str, violations)


def _outline_faults(outline: Outline, expected: Outline) -> Iterator[str]:
    if not _same_lines(outline.outsides, expected.outsides):
        yield "the outside is not the one that was designed"
    if not _same_lines(outline.openings, expected.openings):
        yield "the openings are not the ones that were designed"


def _same_lines(lines: Any, expected: Any) -> bool:
    return len(lines) == len(expected) and all(
        a.shape == b.shape and float(np.abs(a - b).max()) <= OUTLINE_TOLERANCE_MM
        for a, b in zip(lines, expected, strict=True)
    )
