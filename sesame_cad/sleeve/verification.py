"""Reading beams with sleeves back from disk: is every file what it claims to be."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import chain
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from patterns.errors import PatternError
from patterns.violation import Violation
from sesame_cad.cut_checks import CUT_READERS
from sesame_cad.differences import differences
from sesame_cad.errors import DesignFileError
from sesame_cad.files.cut_dxf import read_cut_dxf
from sesame_cad.files.cut_line import CUT, HOLE, CutLine, same_lines
from sesame_cad.files.cut_svg import read_cut_svg
from sesame_cad.package_checks import (
    MOST_FAULTS,
    MOST_OF_A_RULE,
    Faults,
    Verification,
    fabric_faults,
    file_faults,
    limited,
    sewn_faults,
)
from sesame_cad.pipeline import Design
from sesame_cad.reading import Reading
from sesame_cad.report.page import REPORT_FILE
from sesame_cad.report.stitch_view import STITCH_DATA, of_layer
from sesame_cad.report_checks import report_faults
from sesame_cad.sleeve.cutting import Sheet
from sesame_cad.sleeve.data import sleeve_design_data
from sesame_cad.sleeve.design import SleeveDesign
from sesame_cad.sleeve.package import FORCE_FILE, PREDICTED_PICTURES, sheet_lines
from sesame_cad.sleeve.pattern import LOWER, tie_violations
from sesame_cad.sleeve_prediction.solids import segment_solids
from sesame_cad.solid_checks import Size, shape_faults
from sesame_cad.staging import DESIGN_FILE

Data = dict[str, Any]

_READERS = MappingProxyType[str, Callable[[bytes], tuple[CutLine, ...]]](
    {"svg": read_cut_svg, "dxf": read_cut_dxf}
)


def checked_sleeves(folder: Path, data: Data, made: SleeveDesign) -> Verification:
    """Compare a folder with the design that it should hold."""
    readings = {name: Reading(folder, data, one) for name, one in made.hoopings.items()}
    lower, sizes = readings[LOWER], _solid_sizes_mm(made)
    parts: list[Faults] = [
        file_faults(lower, (*_expected_files(made), *sizes)),
        differences(data, sleeve_design_data(made, data["files"]), DESIGN_FILE),
        *(sewn_faults(reading) for reading in readings.values()),
        *(fabric_faults(reading) for reading in readings.values()),
        *(_report_faults(layer, reading) for layer, reading in readings.items()),
        _tie_faults(made, lower),
        *(_sheet_faults(lower, made, sheet) for sheet in made.pattern.cutting.sheets),
        *(_solid_faults(lower, path, size) for path, size in sizes.items()),
    ]
    faults = tuple(chain.from_iterable(limited(part, MOST_FAULTS) for part in parts))
    return _with_plan(made, faults, readings)


def _with_plan(
    made: SleeveDesign, faults: tuple[str, ...], readings: dict[str, Reading]
) -> Verification:
    """Add the first plan that breaks rules, for a picture."""
    try:
        broken: list[tuple[Design | None, tuple[Violation, ...]]] = [
            (one.sewn, one.violations) for one in readings.values() if one.violations
        ]
        ties = _tie_violations(made, readings[LOWER])
    except (DesignFileError, PatternError):
        return Verification(faults)  # which tell it
    broken += [(readings[LOWER].sewn, ties)] if ties else []
    return Verification(faults, *broken[0]) if broken else Verification(faults)


def _expected_files(made: SleeveDesign) -> Iterator[str]:
    spec = made.spec
    for layer, hooping in made.hoopings.items():
        name = hooping.spec.name
        yield from (f"stitch/{name}.{kind}" for kind in (*spec.output.formats, "blocks.csv"))
        yield f"worksheet/{name}.pdf"
        yield from (f"cut/{name}.{kind}" for kind in CUT_READERS)
        if spec.output.pictures:
            yield f"pictures/plan-{layer}.png"
    for sheet in made.pattern.cutting.sheets:
        yield from (f"cut/{spec.name}-{sheet.name}.{kind}" for kind in _READERS)
    yield f"plan/{spec.name}.svg"
    yield REPORT_FILE
    if made.prediction is not None:
        yield FORCE_FILE
        if spec.output.pictures:
            yield from (f"pictures/{one}.png" for one in PREDICTED_PICTURES)


def _tie_violations(made: SleeveDesign, lower: Reading) -> tuple[Violation, ...]:
    """Hold the ties of the DST file against beams and the upper array."""
    if lower.sewn is None:
        return ()
    return tie_violations(made.spec, replace(made.pattern, lower=lower.sewn.pattern))


def _tie_faults(made: SleeveDesign, lower: Reading) -> Faults:
    path = f"stitch/{lower.made.spec.name}.dst"
    try:
        found = _tie_violations(made, lower)
    except (DesignFileError, PatternError):
        return  # which is told of the file
    yield from limited((f"{path}: {fault}" for fault in found), MOST_OF_A_RULE)


def _report_faults(layer: str, reading: Reading) -> Faults:
    """The page shows the stitches of a layer's DST file."""
    content = reading.content(REPORT_FILE)
    if content is None:
        return
    try:
        records = reading.dst
    except DesignFileError:
        return  # which is told of that file
    if records is not None:
        faults = report_faults(content, records, of_layer(STITCH_DATA, layer))
        yield from (f"{REPORT_FILE}: {layer} array: {fault}" for fault in faults)


def _sheet_faults(reading: Reading, made: SleeveDesign, sheet: Sheet) -> Faults:
    """Cut files of a sheet hold its lines, in order."""
    lines = sheet_lines(sheet)
    layered = tuple(line for layer in (HOLE, CUT) for line in lines if line.layer == layer)
    for kind, expected in (("svg", layered), ("dxf", lines)):
        path = f"cut/{made.spec.name}-{sheet.name}.{kind}"
        content = reading.content(path)
        if content is None:
            continue
        try:
            found = _READERS[kind](content)
        except DesignFileError as error:
            yield f"{path}: {error}"
            continue
        if not same_lines(found, expected):
            yield f"{path}: the lines are not those of the sheet, in their order"


def _solid_sizes_mm(made: SleeveDesign) -> dict[str, Size]:
    """Give width, depth and height of each preview that there should be, by its path."""
    if made.prediction is None:
        return {}
    sizes: dict[str, Size] = {}
    for part, solid in segment_solids(made.spec, made.prediction):
        width, depth, height = np.asarray(solid.extents, dtype=float).tolist()
        sizes[f"shape/{part}.stl"] = width, depth, height
    return sizes


def _solid_faults(reading: Reading, path: str, size_mm: Size) -> Faults:
    content = reading.content(path)
    if content is not None:
        yield from (f"{path}: {fault}" for fault in shape_faults(content, ".stl", size_mm))
