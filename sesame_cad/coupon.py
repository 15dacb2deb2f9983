"""The folder of a calibration coupon."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from patterns.coupon import Cell, Coupon, coupon
from patterns.errors import PatternError
from patterns.records import Records, plan_records
from patterns.rules import check_plan
from sesame_cad.design_data import machine_data, stitch_data
from sesame_cad.errors import InputError
from sesame_cad.files.block_list import block_list_csv
from sesame_cad.files.dst import write_dst
from sesame_cad.files.stitch_formats import write_embroidery
from sesame_cad.package_files import file_data
from sesame_cad.pictures.coupon import coupon_picture
from sesame_cad.specification import Specification
from sesame_cad.staging import DESIGN_FILE, staged_directory
from sesame_cad.threads import threads_of

Data = dict[str, Any]


@dataclass(frozen=True)
class CouponFiles:
    """A coupon as it is written.

    Attributes
    ----------
    spec : Specification
    records : Records
        What its stitch files hold.
    contents : dict
        Bytes by path in the folder.
    data : dict
        What its `design.json` holds.
    """

    spec: Specification
    records: Records
    contents: dict[str, bytes]
    data: Data


def write_coupon(spec: Specification, target: Path) -> Data:
    """Plan, check and write a coupon; the folder is made aside and moved into place.

    Parameters
    ----------
    spec
        Whose wire, machine and stitching are meant.

    Returns
    -------
    dict
        What the folder's `design.json` holds.

    Raises
    ------
    InputError
        When the coupon cannot be sewn, or the folder cannot be made.
    """
    made = coupon_files(spec)
    with staged_directory(target) as folder:
        for path, content in made.contents.items():
            (folder / path).parent.mkdir(exist_ok=True)
            (folder / path).write_bytes(content)
        text = json.dumps(made.data, indent=2, ensure_ascii=False, allow_nan=False)
        (folder / DESIGN_FILE).write_text(f"{text}\n", encoding="utf-8")
    return made.data


def coupon_files(spec: Specification) -> CouponFiles:
    """Plan and check a coupon, and make every file of it.

    Raises
    ------
    InputError
        When the coupon cannot be sewn.
    """
    made = _checked(spec)
    records = plan_records(made.plan, spec.patterns_machine())
    threads = threads_of(made.plan, spec.machine)
    wire, needle = spec.wire.diameter_mm, spec.machine.needle_diameter_mm
    contents = {
        f"stitch/{spec.name}.dst": write_dst(records, spec.name, spec.dst_switches()),
        f"stitch/{spec.name}.blocks.csv": block_list_csv(made.plan, threads).encode(),
        "pictures/coupon.png": coupon_picture(made, wire, needle),
    }
    for kind in spec.output.formats:
        if kind != "dst":
            contents[f"stitch/{spec.name}.{kind}"] = write_embroidery(records, kind, threads)
    data = {
        "coupon": spec.name,
        "wire_diameter_mm": wire,
        "wire_length_mm": made.circuit.wire_length_mm,
        "machine": spec.machine.model_dump(mode="json"),
        "cells": [_cell_data(cell, wire + needle) for cell in made.cells],
        "stitch": stitch_data(made.plan, records) | machine_data(spec.machine, made.plan),
        "specification": spec.model_dump(mode="json"),
        "files": {path: file_data(content) for path, content in sorted(contents.items())},
    }
    return CouponFiles(spec, records, contents, data)


def _checked(spec: Specification) -> Coupon:
    machine, wire_mm = spec.patterns_machine(), spec.wire.diameter_mm
    try:
        made = coupon(machine, spec.patterns_stitching(), wire_mm)
    except PatternError as error:
        raise InputError(f"{spec.name}: {error}") from None
    faults = check_plan(made.circuit, made.plan, machine, made.stitching, wire_mm)
    if faults:
        raise InputError(*(f"{spec.name}: {fault}" for fault in faults))
    return made


def _cell_data(cell: Cell, least_mm: float) -> Data:
    """What one cell tries, as the key of a specification that would bring it about."""
    keys = {
        "width": ("stitching.needle_margin_mm", cell.margin_mm),
        "interval": ("stitching.couching_interval_mm", cell.interval_mm),
        "cover": ("stitching.cover_margin_mm", cell.margin_mm),
    }
    key, value = keys[cell.row]
    width = None if cell.row == "interval" else round(least_mm + 2 * cell.margin_mm, 4)
    return {
        "row": cell.row,
        "number": cell.number,
        "key": key,
        "value": value,
        "width_mm": width,
        "usual": cell.usual,
        "x_mm": round(cell.x_mm, 3),
        "y_mm": round(cell.y_mm, 3),
    }
