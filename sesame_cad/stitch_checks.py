"""Reading stitch files back: do they hold every stitch and stop of the plan."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from patterns.plan import UNITS_PER_MM
from patterns.records import Records
from sesame_cad.errors import DesignFileError
from sesame_cad.files.block_list import block_list_csv
from sesame_cad.files.stitch_formats import FORMATS
from sesame_cad.reading import Reading
from sesame_cad.specification.output import StitchFormat
from sesame_cad.threads import threads_of

Faults = Iterator[str]


def stitch_faults(reading: Reading) -> Faults:
    """Tell where stitch files and the list of blocks are not what the plan makes them."""
    spec, plan = reading.made.spec, reading.made.pattern.plan
    for kind in spec.output.formats:
        path = f"stitch/{spec.name}.{kind}"
        yield from (f"{path}: {fault}" for fault in _format_faults(reading, kind, path))
    path = f"stitch/{spec.name}.blocks.csv"
    blocks = reading.content(path)
    right = block_list_csv(plan, threads_of(plan, spec.machine)).encode()
    if blocks is not None and blocks != right:
        yield f"{path}: not the list of the plan's blocks"


def _format_faults(reading: Reading, kind: StitchFormat, path: str) -> Faults:
    content = reading.content(path)
    if content is None:
        return
    try:
        if kind != "dst":
            known = FORMATS[kind]
            yield from record_faults(known.read(content), known.carried(reading.records))
        elif reading.dst is not None:
            yield from record_faults(reading.dst, reading.records)
    except DesignFileError as error:
        yield str(error)


def record_faults(records: Records, expected: Records) -> Faults:
    """Tell where the records of a file are not those expected."""
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
