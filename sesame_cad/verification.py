"""Reading a design back from disk: is every file what it claims to be."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np

from patterns.errors import PatternError
from patterns.plan import UNITS_PER_MM
from patterns.records import Records, plan_from_records, plan_records
from patterns.rules import check_plan
from patterns.rules.net import check_net
from patterns.violation import Violation
from sesame_cad.cut_checks import CUT_READERS, cut_faults
from sesame_cad.design_data import FORMAT_VERSION, design_data
from sesame_cad.differences import differences
from sesame_cad.errors import DesignFileError, InputError
from sesame_cad.files.block_list import block_list_csv
from sesame_cad.files.dst import decode_dst
from sesame_cad.files.stitch_formats import FORMATS
from sesame_cad.package import file_data
from sesame_cad.pipeline import Design, design, net_of_stitches
from sesame_cad.solid_checks import solid_faults, solid_sizes_mm
from sesame_cad.specification import specification_from
from sesame_cad.specification.output import StitchFormat
from sesame_cad.staging import DESIGN_FILE
from solver.errors import NotConvergedError

MOST_BYTES = 500_000_000
"""No file of a design is larger, and a larger one is not read."""

MOST_FAULTS = 100
MOST_OF_A_RULE = 5
"""More faults of a kind, or of one design rule, are only counted."""

Faults = Iterator[str]
Data = dict[str, Any]


@dataclass(frozen=True)
class Verification:
    """What was found in a folder.

    Attributes
    ----------
    faults : tuple of str
        One line each; empty when every file is as it should be.
    sewn : Design or None
        The design with the plan that the DST file holds; None when there is no such plan.
    violations : tuple of Violation
        Rules that this plan breaks.
    """

    faults: tuple[str, ...]
    sewn: Design | None = None
    violations: tuple[Violation, ...] = ()


def verify(folder: Path) -> tuple[str, ...]:
    """Give the faults that `verified` finds."""
    return verified(folder).faults


def verified(folder: Path) -> Verification:
    """Verify a design; the design is made again from its specification, and compared.

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
        return Verification((f"{DESIGN_FILE}: {error}",))
    reading = _Reading(folder, data, made)
    faults = tuple(fault for part in CHECKS for fault in _limited(part(reading), MOST_FAULTS))
    try:
        return Verification(faults, reading.sewn, reading.violations)
    except (DesignFileError, PatternError):
        return Verification(faults)  # which tell it


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
        """Bytes of a file; none when it is missing or too large, which `_check_files` reports."""
        file = self.folder / path
        good = file.is_file() and file.stat().st_size <= MOST_BYTES
        return file.read_bytes() if good else None

    @cached_property
    def dst(self) -> Records | None:
        """What the DST file holds, if there is one; raises `DesignFileError`."""
        content = self.content(f"stitch/{self.made.spec.name}.dst")
        return None if content is None else decode_dst(content).records

    @cached_property
    def sewn(self) -> Design | None:
        """The design with the DST file's plan; raises `PatternError` when it is none."""
        if self.dst is None:
            return None
        laid = self.made.pattern
        plan = plan_from_records(self.dst, laid.plan.blocks)
        return replace(self.made, pattern=replace(laid, plan=plan))

    @cached_property
    def violations(self) -> tuple[Violation, ...]:
        """Hold what the DST file says against the design rules, whatever the plan was."""
        if self.sewn is None:
            return ()
        spec, laid = self.sewn.spec, self.sewn.pattern
        machine, stitching = spec.patterns_machine(), spec.patterns_stitching()
        net = net_of_stitches(spec, laid.circuit, laid.plan)
        return (
            *check_plan(laid.circuit, laid.plan, machine, stitching, spec.diameters_mm),
            *check_net(laid.circuit, net),
        )


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
            there = (reading.folder / path).is_file()
            yield f"{path}: {f'more than {MOST_BYTES} bytes' if there else 'missing'}"
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
    yield from (f"stitch/{name}.{kind}" for kind in (*made.spec.output.formats, "blocks.csv"))
    yield f"plan/{name}.svg"
    yield f"worksheet/{name}.pdf"
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
    yield from differences(reading.data, expected, DESIGN_FILE)


def _check_stitches(reading: _Reading) -> Faults:
    """Stitch files hold every stitch and stop of the plan, and break no rule."""
    spec, plan = reading.made.spec, reading.made.pattern.plan
    for kind in spec.output.formats:
        path = f"stitch/{spec.name}.{kind}"
        yield from (f"{path}: {fault}" for fault in _format_faults(reading, kind, path))
    path = f"stitch/{spec.name}.blocks.csv"
    blocks = reading.content(path)
    if blocks is not None and blocks != block_list_csv(plan).encode():
        yield f"{path}: not the list of the plan's blocks"


def _format_faults(reading: _Reading, kind: StitchFormat, path: str) -> Faults:
    content = reading.content(path)
    if content is None:
        return
    try:
        if kind != "dst":
            known = FORMATS[kind]
            yield from _record_faults(known.read(content), known.carried(reading.records))
        elif reading.dst is not None:
            yield from _record_faults(reading.dst, reading.records)
            yield from _rule_faults(reading)
    except DesignFileError as error:
        yield str(error)


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


def _rule_faults(reading: _Reading) -> Faults:
    try:
        violations = reading.violations
    except PatternError as error:
        yield str(error)
        return
    for _, of_rule in groupby(violations, key=lambda violation: violation.rule):
        yield from _limited(map(str, of_rule), MOST_OF_A_RULE)


def _check_cut(reading: _Reading) -> Faults:
    """Cut files hold the outline, closed, in mm, clear of wire and needle."""
    for kind in CUT_READERS:
        path = f"cut/{reading.made.spec.name}.{kind}"
        content = reading.content(path)
        if content is not None:
            faults = cut_faults(content, kind, reading.made)
            yield from (f"{path}: {fault}" for fault in faults)


def _check_shapes(reading: _Reading) -> Faults:
    """STL files are watertight solids of the predicted size."""
    for name, size in solid_sizes_mm(reading.made).items():
        path = f"shape/{name}.stl"
        content = reading.content(path)
        if content is not None:
            yield from (f"{path}: {fault}" for fault in solid_faults(content, size))


CHECKS: tuple[Callable[[_Reading], Faults], ...] = (
    _check_files,
    _check_numbers,
    _check_stitches,
    _check_cut,
    _check_shapes,
)
