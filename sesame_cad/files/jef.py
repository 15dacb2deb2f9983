"""Janome JEF: pairs of signed bytes after a header with a date, a hoop and the colours."""

from __future__ import annotations

import io
import struct
from collections.abc import Iterator, Sequence

from pyembroidery import JefWriter

from patterns.records import Command, Records
from sesame_cad.errors import DesignFileError
from sesame_cad.files.byte_pairs import byte_pair_moves
from sesame_cad.files.embroidery import coloured_pattern, records_of_moves
from sesame_cad.threads import Thread

LOSSES = (
    "every stop is a colour change",
    "colours are the nearest of Janome's own threads",
    "the header names one of Janome's hoops even when the design is larger",
    "the header's date is 1 January 2000",
)

_DATE = "20000101000000"
_END = b"\x80\x10"


def write_jef(records: Records, threads: Sequence[Thread]) -> bytes:
    """Encode a design; the same bytes on every day."""
    whole = io.BytesIO()
    JefWriter.write(coloured_pattern(records, threads), whole, {"date": _DATE})
    return whole.getvalue()


def read_jef(data: bytes) -> Records:
    """Decode a design.

    Raises
    ------
    DesignFileError
        When the data breaks off or holds a record of an unknown kind.
    """
    return records_of_moves(_moves(_body(data)))


def _body(data: bytes) -> bytes:
    """Byte pairs between the header, whose length it tells itself, and the end."""
    start = struct.unpack_from("<I", data)[0] if len(data) >= 4 else 0
    body = data[start:]
    if start < 0x74 or len(body) % 2 or not body.endswith(_END):
        raise DesignFileError("the JEF file breaks off: it does not end with its end record")
    return body[: -len(_END)]


def _moves(body: bytes) -> Iterator[tuple[Command, int, int]]:
    kinds = {0x01: Command.STOP, 0x02: Command.JUMP}
    return byte_pair_moves(body, kinds, "JEF")
