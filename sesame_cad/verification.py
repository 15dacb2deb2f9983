"""Reading a design back from disk: is every file what it claims to be."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Any

from patterns.errors import PatternError
from patterns.violation import Violation
from sesame_cad.coupon_checks import coupon_faults
from sesame_cad.cut_checks import CUT_READERS, cut_faults
from sesame_cad.design_data import FORMAT_VERSION, design_data
from sesame_cad.differences import differences
from sesame_cad.errors import DesignFileError, InputError
from sesame_cad.package import file_data
from sesame_cad.pipeline import Design, design
from sesame_cad.reading import Reading
from sesame_cad.solid_checks import solid_faults, solid_sizes_mm
from sesame_cad.specification import specification_from
from sesame_cad.staging import DESIGN_FILE
from sesame_cad.stitch_checks import stitch_faults
from solver.errors import NotConvergedError

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
        if "coupon" in data:
            return Verification(tuple(_limited(coupon_faults(folder, data), MOST_FAULTS)))
        made = _made_again(data)
    except DesignFileError as error:
        return Verification((f"{DESIGN_FILE}: {error}",))
    reading = Reading(folder, data, made)
    faults = tuple(fault for part in CHECKS for fault in _limited(part(reading), MOST_FAULTS))
    try:
        return Verification(faults, reading.sewn, reading.violations)
    except (DesignFileError, PatternError):
        return Verification(faults)  # which tell it


def _read_data(file: Path) -> Data:
    try:
        data = json.loads(file.read_bytes())
    except FileNotFoundError:
        raise DesignFileError("missing") from None
    except (OSError, ValueError, RecursionError) as error:
        raise DesignFileError(f"cannot be read: {error}") from None
    if not isinstance(data, dict) or not isinstance(data.get("files"), dict):
        raise DesignFileError('not a design: no "files" in it')
    if "coupon" not in data and data.get("format") != FORMAT_VERSION:
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


def _check_files(reading: Reading) -> Faults:
    """Listed files are there with their size and hash, and no others."""
    listed = reading.data["files"]
    for path, said in listed.items():
        content = reading.content(path)
        if content is None:
            yield f"{path}: {reading.lack(path)}"
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


def _check_numbers(reading: Reading) -> Faults:
    """Numbers in `design.json` are those that follow from its specification."""
    expected = design_data(reading.made, reading.records, reading.data["files"])
    yield from differences(reading.data, expected, DESIGN_FILE)


def _check_stitches(reading: Reading) -> Faults:
    """Stitch files hold every stitch and stop of the plan, and break no rule."""
    yield from stitch_faults(reading)
    path = f"stitch/{reading.made.spec.name}.dst"
    yield from (f"{path}: {fault}" for fault in _rule_faults(reading))


def _rule_faults(reading: Reading) -> Faults:
    try:
        violations = reading.violations
    except DesignFileError:
        return  # which is told of the file
    except PatternError as error:
        yield str(error)
        return
    for _, of_rule in groupby(violations, key=lambda violation: violation.rule):
        yield from _limited(map(str, of_rule), MOST_OF_A_RULE)


def _check_cut(reading: Reading) -> Faults:
    """Cut files hold the outline, closed, in mm, clear of wire and needle."""
    for kind in CUT_READERS:
        path = f"cut/{reading.made.spec.name}.{kind}"
        content = reading.content(path)
        if content is not None:
            faults = cut_faults(content, kind, reading.made)
            yield from (f"{path}: {fault}" for fault in faults)


def _check_shapes(reading: Reading) -> Faults:
    """STL files are watertight solids of the predicted size."""
    for name, size in solid_sizes_mm(reading.made).items():
        path = f"shape/{name}.stl"
        content = reading.content(path)
        if content is not None:
            yield from (f"{path}: {fault}" for fault in solid_faults(content, size))


CHECKS: tuple[Callable[[Reading], Faults], ...] = (
    _check_files,
    _check_numbers,
    _check_stitches,
    _check_cut,
    _check_shapes,
)
