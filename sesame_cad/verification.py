"""Reading a design back from disk: is every file what it claims to be."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from patterns.errors import PatternError
from sesame_cad.coupon_checks import coupon_faults
from sesame_cad.design_data import FORMAT_VERSION, design_data
from sesame_cad.differences import differences
from sesame_cad.errors import DesignFileError, InputError
from sesame_cad.package_checks import (
    MOST_FAULTS,
    Verification,
    fabric_faults,
    file_faults,
    limited,
    sewn_faults,
)
from sesame_cad.pipeline import Design, design
from sesame_cad.reading import Reading
from sesame_cad.report.page import REPORT_FILE
from sesame_cad.report_checks import report_faults
from sesame_cad.shape_files import shape_paths
from sesame_cad.sleeve.design import sleeve_design
from sesame_cad.sleeve.verification import checked_sleeves
from sesame_cad.solid_checks import shape_faults, shape_sizes_mm
from sesame_cad.specification import Specification, specification_from
from sesame_cad.specification.layout import SLEEVE
from sesame_cad.staging import DESIGN_FILE
from solver.errors import NotConvergedError

Faults = Iterator[str]
Data = dict[str, Any]


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
            return Verification(tuple(limited(coupon_faults(folder, data), MOST_FAULTS)))
        return _checked(folder, data, _specification(data))
    except DesignFileError as error:
        return Verification((f"{DESIGN_FILE}: {error}",))
    except InputError as error:
        return Verification((f"{DESIGN_FILE}: {'; '.join(error.faults)}",))
    except NotConvergedError as error:
        return Verification((f"{DESIGN_FILE}: {error}",))


def _checked(folder: Path, data: Data, spec: Specification) -> Verification:
    """Make the design again and compare."""
    if spec.layout.kind == SLEEVE:
        return checked_sleeves(folder, data, sleeve_design(spec))
    reading = Reading(folder, data, design(spec))
    faults = tuple(fault for part in CHECKS for fault in limited(part(reading), MOST_FAULTS))
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


def _specification(data: Data) -> Specification:
    specification = data.get("specification")
    if not isinstance(specification, dict):
        raise DesignFileError('no "specification" in it')
    return specification_from(specification, str(data.get("name")), "specification")


def _check_files(reading: Reading) -> Faults:
    """Listed files are there with their size and hash, and no others."""
    yield from file_faults(reading, _expected_files(reading.made))


def _expected_files(made: Design) -> Iterator[str]:
    name = made.spec.name
    yield from (f"stitch/{name}.{kind}" for kind in (*made.spec.output.formats, "blocks.csv"))
    yield f"plan/{name}.svg"
    yield f"worksheet/{name}.pdf"
    yield REPORT_FILE
    yield from (f"cut/{name}.{kind}" for kind in ("svg", "dxf"))
    if made.spec.output.pictures:
        yield "pictures/plan.png"
    if made.states:
        yield from shape_paths(made)
        if made.spec.output.pictures:
            yield "pictures/shapes.png"


def _check_numbers(reading: Reading) -> Faults:
    """Numbers in `design.json` are those that follow from its specification."""
    expected = design_data(reading.made, reading.records, reading.data["files"])
    yield from differences(reading.data, expected, DESIGN_FILE)


def _check_shapes(reading: Reading) -> Faults:
    """Files of shapes have the predicted size; STL files are watertight solids."""
    sizes = shape_sizes_mm(reading.made)
    for path in shape_paths(reading.made):
        content = reading.content(path)
        if content is not None:
            faults = shape_faults(content, Path(path).suffix, sizes[path])
            yield from (f"{path}: {fault}" for fault in faults)


def _check_report(reading: Reading) -> Faults:
    """The page shows the stitches of the DST file."""
    content = reading.content(REPORT_FILE)
    try:
        records = reading.dst
    except DesignFileError:
        return  # which is told of that file
    if content is not None and records is not None:
        yield from (f"{REPORT_FILE}: {fault}" for fault in report_faults(content, records))


CHECKS: tuple[Callable[[Reading], Faults], ...] = (
    _check_files,
    _check_numbers,
    sewn_faults,
    fabric_faults,
    _check_shapes,
    _check_report,
)
