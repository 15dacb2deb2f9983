"""Fallback formats, by way of pyembroidery: EXP and U01."""

from __future__ import annotations

import io
from enum import StrEnum

import numpy as np
import pyembroidery
from pyembroidery import EmbPattern, ExpWriter, U01Writer

from patterns.records import LARGEST_STEP, Command, Records
from sesame_cad.errors import InputError

_COMMANDS = {
    Command.STITCH: pyembroidery.STITCH,
    Command.JUMP: pyembroidery.JUMP,
    Command.STOP: pyembroidery.STOP,
    Command.END: pyembroidery.END,
}


class EmbroideryFormat(StrEnum):
    """Formats besides DST that the machine reads; the value is the file's suffix."""

    EXP = "exp"
    U01 = "u01"


def embroidery_pattern(records: Records) -> EmbPattern:
    """Give the records to pyembroidery as they are, with its y pointing to the operator."""
    pattern = EmbPattern()
    codes = np.zeros(len(records.command), dtype=np.int64)
    for command, code in _COMMANDS.items():
        codes[records.command == command] = code
    table = np.column_stack([records.xy * (1, -1), codes])
    # Straight into its list: every method that adds a stitch re-reads or normalises it.
    pattern.stitches.extend(table.tolist())
    return pattern


def write_embroidery(records: Records, file_format: EmbroideryFormat) -> bytes:
    """Encode a design in one of the fallback formats.

    Raises
    ------
    InputError
        When a record moves further than the format holds.
    """
    step = int(np.abs(np.diff(records.xy, axis=0, prepend=0)).max(initial=0))
    if step > LARGEST_STEP:
        raise InputError(f"a record moves {step / 10:.1f} mm; it can hold {LARGEST_STEP / 10} mm")
    whole = io.BytesIO()
    writer = ExpWriter if file_format is EmbroideryFormat.EXP else U01Writer
    writer.write(embroidery_pattern(records), whole)
    return whole.getvalue()
