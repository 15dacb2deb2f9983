"""Barudan U01: three bytes a record after a header."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence

import numpy as np
from pyembroidery import U01Writer

from patterns.records import Command, Records
from sesame_cad.errors import DesignFileError
from sesame_cad.files.embroidery import embroidery_pattern, records_of_moves
from sesame_cad.threads import Thread

_HEADER_BYTES = 256
_END = b"\xf8\x00\x00"


def write_u01(records: Records, _: Sequence[Thread]) -> bytes:
    """Encode a design; the format has no room for colours."""
    whole = io.BytesIO()
    U01Writer.write(embroidery_pattern(records), whole)
    return whole.getvalue()


def read_u01(data: bytes) -> Records:
    """Decode a design.

    Raises
    ------
    DesignFileError
        When the data breaks off or holds a record of an unknown kind.
    """
    return records_of_moves(_moves(data))


def _moves(data: bytes) -> Iterator[tuple[Command, int, int]]:
    """Three bytes a record after a header of 256: kind and signs, then |y| and |x|."""
    kinds = {0x00: Command.STITCH, 0x01: Command.JUMP, 0x08: Command.STOP}
    body = data[_HEADER_BYTES:]
    if len(body) % 3 or not body.endswith(_END):
        raise DesignFileError("the U01 file breaks off: it does not end with its end record")
    for kind, y, x in np.frombuffer(body[:-3], dtype=np.uint8).reshape(-1, 3).tolist():
        if kind & 0x1F not in kinds or not kind & 0x80:
            raise DesignFileError(f"the U01 file holds an unknown record {kind:02X}")
        if kinds[kind & 0x1F] is Command.STOP and (x or y):
            raise DesignFileError("the U01 file stops and moves at once")
        yield kinds[kind & 0x1F], -x if kind & 0x20 else x, -y if kind & 0x40 else y
