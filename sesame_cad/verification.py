"""Reading a design back from disk: is every file what it claims to be."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np

from patterns.errors import PatternError
from patterns.layout import Layout
from patterns.outline import Outline
from patterns.plan import UNITS_PER_MM, StitchPlan
from patterns.records import Records, plan_from_records, plan_records
from patterns.rules import check_plan
from patterns.rules.outline import check_outline
from sesame_cad.design_data import FORMAT_VERSION, design_data
from sesame_cad.errors import DesignFileError, InputError
from sesame_cad.files.dst import decode_dst
from sesame_cad.files.dxf import read_outline_dxf
from sesame_cad.files.embroidery import read_embroidery
from sesame_cad.files.stl import read_stl
from sesame_cad.files.svg import read_outline_svg
from sesame_cad.package import file_data
from sesame_cad.pipeline import Design, design
from sesame_cad.specification import specification_from
from sesame_cad.staging import DESIGN_FILE
from solver.errors import NotConvergedError

HEIGHT_TOLERANCE_MM = 0.01
FOOTPRINT_TOLERANCE_MM = 0.1
OUTLINE_TOLERANCE_MM = 0.002
"""Cut files hold three decimals."""

RELATIVE_TOLERANCE = 1e-6
"""Numbers are made again on another machine at most this far off."""

MOST_FAULTS = 100
MOST_OF_A_RULE = 5
"""More faults of a kind, or of one design rule, are only counted."""

Faults = Iterator[str]
Data = dict[str, Any]


def verify(folder: Path) -> tuple[str, ...]:
    """Verify a design; the design is made again from its specification, and compared.

    Returns
    -------
    tuple of str
        One line per fault; empty when every file is as it should be.

    Raises
    ------
    InputError
        When ``folder`` is not a folder that can be read.
    """
    if not folder.is_dir():
        raise InputError(f"{folder}: not a folder; name the folder of a design")
    try:
        data = _read_data(folder / DESIGN_FILE)
        made = _made_again(data)
    except DesignFileError as error:
        return (f"{DESIGN_FILE}: {error}",)
    reading = _Reading(folder, data, made)
    return tuple(fault for part in CHECKS for fault in _limited(part(reading), MOST_FAULTS))


@dataclass(frozen=True)
class _Reading:
    """A folder under verification, and the design that it should hold."""

    folder: Path
    data: Data
    made: Design

    @cached_property
    def records(self) -> Records:
        """What the stitch files should hold."""
        return plan_records(self.made.pattern.plan, self.made.spec.patterns_machine())

    def content(self, path: str) -> bytes | None:
        """Bytes of a file; none when it is missing, which `_check_files` reports."""
        file = self.folder / path
        return file.read_bytes() if file.is_file() else None


def _read_data(file: Path) -> Data:
    try:
        data = json.loads(file.read_bytes())
    except FileNotFoundError:
        raise DesignFileError("missing") from None
    except (OSError, ValueError, RecursionError) as error:
        raise DesignFileError(f"cannot be read: {error}") from None
    if not isinstance(data, dict) or not isinstance(data.get("files"), dict):
        raise DesignFileError('not a design: no "files" in it')
    if data.get("format") != FORMAT_VERSION:
        raise DesignFileError(
            f"format {data.get('format')!r}: this program reads format {FORMAT_VERSION}"
        )
    return data


def _made_again(data: Data) -> Design:
    specification = data.get("specification")
    if not isinstance(specification, dict):
        raise DesignFileError('no "specification" in it')
    try:
        return design(specification_from(specification, str(data.get("name")), "specification"))
    except InputError as error:
        raise DesignFileError("; ".join(error.faults)) from None
    except NotConvergedError as error:
        raise DesignFileError(str(error)) from None


def _limited(faults: Iterator[str], most: int) -> Faults:
    more = 0
    for count, fault in enumerate(faults):
        if count < most:
            yield fault
        else:
            more += 1
    if more:
        yield f"... and {more} more of this kind"


def _check_files(reading: _Reading) -> Faults:
    """Listed files are there with their size and hash, and no others."""
    listed = reading.data["files"]
    for path, said in listed.items():
        content = reading.content(path)
        if content is None:
            yield f"{path}: missing"
        elif file_data(content) != said:
            yield f"{path}: changed since it was written (its size or hash is another)"
    for file in sorted(reading.folder.rglob("*")):
        path = file.relative_to(reading.folder).as_posix()
        if file.is_file() and path != DESIGN_FILE and path not in listed:
            yield f"{path}: not listed in {DESIGN_FILE}"
    for path in _expected_files(reading.made):
        if path not in listed:
            yield f"{path}: not listed in {DESIGN_FILE}, though the design needs it"


def _expected_files(made: Design) -> Iterator[str]:
    name = made.spec.name
    yield from (f"stitch/{name}.{kind}" for kind in made.spec.output.formats)
    yield from (f"cut/{name}.{kind}" for kind in ("svg", "dxf"))
    if made.spec.output.pictures:
        yield "pictures/plan.png"
    if made.states:
        yield from (f"shape/{kind}.stl" for kind in ("flat", "cold", "hot"))
        if made.spec.output.pictures:
            yield "pictures/shapes.png"


def _check_numbers(reading: _Reading) -> Faults:
    """Numbers in `design.json` are those that follow from its specification."""
    expected = design_data(reading.made, reading.records, reading.data["files"])
    yield from _differences(reading.data, expected, DESIGN_FILE)


ACCOUNT = frozenset({"seconds", "steps", "factorizations", "gradient_norm", "height_change"})
"""Keys that tell how a number was found; they may differ where the number does not."""


def _differences(said: object, expected: object, where: str) -> Faults:
    if isinstance(expected, dict) and isinstance(said, dict):
        for key in expected.keys() | said.keys():
            if key in ACCOUNT:
                continue
            if key not in said or key not in expected:
                yield f"{where}: {key} {'is missing' if key not in said else 'does not belong'}"
            else:
                yield from _differences(said[key], expected[key], f"{where}: {key}")
    elif isinstance(expected, list) and isinstance(said, list) and len(said) == len(expected):
        for k, (one, other) in enumerate(zip(said, expected, strict=True)):
            yield from _differences(one, other, f"{where}[{k}]")
    elif not _same(said, expected):
        yield f"{where} = {said!r}: should be {expected!r}"


def _same(said: object, expected: object) -> bool:
    if isinstance(expected, float) and isinstance(said, int | float):
        return math.isclose(said, expected, rel_tol=RELATIVE_TOLERANCE, abs_tol=1e-7)
    return said == expected


def _check_stitches(reading: _Reading) -> Faults:
    """Stitch files hold every stitch and stop of the plan, and break no rule."""
    name = reading.made.spec.name
    for kind in reading.made.spec.output.formats:
        path = f"stitch/{name}.{kind}"
        content = reading.content(path)
        if content is None:
            continue
        try:
            records = (
                decode_dst(content, reading.made.spec.dst_switches()).records
                if kind == "dst"
                else read_embroidery(content, kind)
            )
        except DesignFileError as error:
            yield f"{path}: {error}"
            continue
        yield from (f"{path}: {fault}" for fault in _record_faults(records, reading.records))
        if kind == "dst":
            yield from (f"{path}: {fault}" for fault in _rule_faults(records, reading.made))


def _record_faults(records: Records, expected: Records) -> Faults:
    if len(records.command) != len(expected.command):
        yield f"{len(records.command)} records; the plan has {len(expected.command)}"
        return
    other = np.flatnonzero(
        (records.command != expected.command) | np.any(records.xy != expected.xy, axis=1)
    )
    for k in other:
        x, y = records.xy[k] / UNITS_PER_MM
        right_x, right_y = expected.xy[k] / UNITS_PER_MM
        yield (
            f"record {k + 1}: {records.command[k]} to ({x:.1f}, {y:.1f}) mm; the plan has "
            f"{expected.command[k]} to ({right_x:.1f}, {right_y:.1f}) mm"
        )


def _rule_faults(records: Records, made: Design) -> Faults:
    """Hold what the file says against the design rules, whatever the plan was."""
    spec, blocks = made.spec, made.pattern.plan.blocks
    try:
        plan: StitchPlan = plan_from_records(records, blocks)
    except PatternError as error:
        yield str(error)
        return
    violations = check_plan(
        made.pattern.circuit,
        plan,
        spec.patterns_machine(),
        spec.patterns_stitching(),
        spec.wire.diameter_mm,
    )
    for _, of_rule in groupby(violations, key=lambda violation: violation.rule):
        yield from _limited(map(str, of_rule), MOST_OF_A_RULE)


def _check_cut(reading: _Reading) -> Faults:
    """Cut files hold the outline, closed, in mm, clear of wire and needle."""
    spec, laid = reading.made.spec, reading.made.pattern
    readers: dict[str, Callable[[bytes], tuple[Outline, Any]]] = {
        "svg": read_outline_svg,
        "dxf": read_outline_dxf,
    }
    for kind, read in readers.items():
        path = f"cut/{spec.name}.{kind}"
        content = reading.content(path)
        if content is None:
            continue
        try:
            outline, strokes = read(content)
        except DesignFileError as error:
            yield f"{path}: {error}"
            continue
        yield from (f"{path}: {fault}" for fault in _outline_faults(outline, laid.outline))
        expected = [stroke for mark in laid.marks for stroke in mark.strokes]
        if not _same_lines(strokes, expected):
            yield f"{path}: the registration marks are not those of the stitch file"
        margin = spec.outline.margin_mm - OUTLINE_TOLERANCE_MM
        for fault in check_outline(outline, laid.circuit, spec.wire.diameter_mm, margin, laid.plan):
            yield f"{path}: {fault}"


def _outline_faults(outline: Outline, expected: Outline) -> Faults:
    if not _same_lines([outline.outside], [expected.outside]):
        yield "the outside is not the one that was designed"
    if not _same_lines(outline.openings, expected.openings):
        yield "the openings are not the ones that were designed"


def _same_lines(lines: Any, expected: Any) -> bool:
    return len(lines) == len(expected) and all(
        a.shape == b.shape and float(np.abs(a - b).max()) <= OUTLINE_TOLERANCE_MM
        for a, b in zip(lines, expected, strict=True)
    )


def _check_shapes(reading: _Reading) -> Faults:
    """STL files are watertight solids of the predicted size."""
    made = reading.made
    wire = made.spec.wire.diameter_mm
    sizes: dict[str, tuple[float, float, float]] = {}
    for state in made.states:
        width, depth = _laid_size_mm(made.pattern.circuit.layout)
        sizes["flat"] = (width + wire, depth + wire, wire)
        width, depth = state.footprint_mm
        sizes[state.name] = (width + wire, depth + wire, state.height_mm + wire)
    for name, size in sizes.items():
        path = f"shape/{name}.stl"
        content = reading.content(path)
        if content is None:
            continue
        try:
            yield from (f"{path}: {fault}" for fault in _solid_faults(content, size))
        except DesignFileError as error:
            yield f"{path}: {error}"


def _laid_size_mm(layout: Layout) -> tuple[float, float]:
    """Width and depth over the outer wires' centrelines in the hoop."""
    place = np.array([(loop.x_mm, loop.y_mm, loop.radius_mm) for loop in layout.loops])
    centre, radius = place[:, :2], place[:, 2:]
    width, depth = (centre + radius).max(axis=0) - (centre - radius).min(axis=0)
    return float(width), float(depth)


def _solid_faults(content: bytes, size: tuple[float, float, float]) -> Faults:
    solid = read_stl(content)
    if not solid.is_watertight:
        yield "not watertight"
    if solid.volume <= 0:
        yield "inside out: its volume is not positive"
    tolerances = (FOOTPRINT_TOLERANCE_MM, FOOTPRINT_TOLERANCE_MM, HEIGHT_TOLERANCE_MM)
    measured = solid.extents
    for axis, found, predicted, tolerance in zip(
        ("width", "depth", "height"), measured, size, tolerances, strict=True
    ):
        if abs(found - predicted) > tolerance:
            yield f"{axis} {found:.3f} mm; predicted {predicted:.3f} mm with the wire"


CHECKS: tuple[Callable[[_Reading], Faults], ...] = (
    _check_files,
    _check_numbers,
    _check_stitches,
    _check_cut,
    _check_shapes,
)
