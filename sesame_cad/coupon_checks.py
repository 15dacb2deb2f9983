"""The folder of a coupon read back: is every file what it claims to be."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from sesame_cad.coupon import CouponFiles, coupon_files
from sesame_cad.differences import differences
from sesame_cad.errors import DesignFileError, InputError
from sesame_cad.files.dst import decode_dst
from sesame_cad.files.stitch_formats import FORMATS
from sesame_cad.package_files import file_data
from sesame_cad.specification import specification_from
from sesame_cad.staging import DESIGN_FILE
from sesame_cad.stitch_checks import record_faults

Faults = Iterator[str]
Data = dict[str, Any]


def coupon_faults(folder: Path, data: Data) -> Faults:
    """Make the coupon again from its specification and compare it with the folder.

    The plan that is made again keeps the design rules, or it would not be made; so does a stitch
    file that holds the same records.

    Raises
    ------
    DesignFileError
        When there is no specification of a coupon that can be made.
    """
    made = _made_again(data)
    listed: Data = data["files"]
    for path in sorted(made.contents.keys() - listed.keys()):
        yield f"{path}: not listed in {DESIGN_FILE}, though the coupon needs it"
    for file in sorted(folder.rglob("*")):
        path = file.relative_to(folder).as_posix()
        if file.is_file() and path != DESIGN_FILE and path not in listed:
            yield f"{path}: not listed in {DESIGN_FILE}"
    for path, said in listed.items():
        file = folder / path
        if not file.is_file():
            yield f"{path}: missing"
            continue
        content = file.read_bytes()
        if file_data(content) != said:
            yield f"{path}: changed since it was written (its size or hash is another)"
        yield from (f"{path}: {fault}" for fault in _content_faults(path, content, made))
    yield from differences(data, made.data | {"files": listed}, DESIGN_FILE)


def _made_again(data: Data) -> CouponFiles:
    specification = data.get("specification")
    if not isinstance(specification, dict):
        raise DesignFileError('of a coupon, with no "specification" in it; make it again')
    try:
        return coupon_files(
            specification_from(specification, str(data.get("coupon")), "specification")
        )
    except InputError as error:
        raise DesignFileError("; ".join(error.faults)) from None


def _content_faults(path: str, content: bytes, made: CouponFiles) -> Faults:
    """Compare a stitch file record by record, and the list of blocks letter by letter."""
    kind = path.rpartition(".")[2]
    try:
        if kind == "dst":
            records = decode_dst(content, made.spec.dst_switches()).records
            yield from record_faults(records, made.records)
        for other in made.spec.output.formats:
            if other != "dst" and other == kind:
                known = FORMATS[other]
                yield from record_faults(known.read(content), known.carried(made.records))
        if kind == "csv" and content != made.contents.get(path):
            yield "not the list of the plan's blocks"
    except DesignFileError as error:
        yield str(error)
