"""Fallback formats: EXP and U01, written by pyembroidery."""

from __future__ import annotations

import io
from collections.abc import Iterator
from typing import Literal

import numpy as np
import pyembroidery
from pyembroidery import EmbPattern, ExpWriter, U01Writer

from patterns.records import LARGEST_STEP, Command, Records
from sesame_cad.errors import DesignFileError, InputError

_COMMANDS = {
    Command.STITCH: pyembroidery.STITCH,
    Command.JUMP: pyembroidery.JUMP,
    Command.STOP: pyembroidery.STOP,
    Command.END: pyembroidery.END,
}


EmbroideryFormat = Literal["exp", "u01"]
"""Formats besides DST that the machine reads, by their suffix."""

FARTHEST = 32_767
"""Largest coordinate, in 0.1 mm, for which the header of U01 has room."""


_EXP_CONTROL = 0x80
_U01_HEADER_BYTES = 256
_U01_END = b"\xf8\x00\x00"


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
        When a record moves further, or the design reaches further, than the format holds.
    """
    step = int(np.abs(np.diff(records.xy, axis=0, prepend=0)).max(initial=0))
    if step > LARGEST_STEP:
        raise InputError(f"a record moves {step / 10:.1f} mm; it can hold {LARGEST_STEP / 10} mm")
    reach = int(np.abs(records.xy).max(initial=0))
    if reach > FARTHEST:
        raise InputError(
            f"the design reaches {reach / 10:g} mm; U01 and EXP go to {FARTHEST / 10} mm"
        )
    whole = io.BytesIO()
    writer = ExpWriter if file_format == "exp" else U01Writer
    writer.write(embroidery_pattern(records), whole)
    return whole.getvalue()


def read_embroidery(data: bytes, file_format: EmbroideryFormat) -> Records:
    """Decode one of the fallback formats, as `write_embroidery` writes them.

    Raises
    ------
    DesignFileError
        When the data breaks off or holds a record of an unknown kind.
    """
    moves = _exp_moves(data) if file_format == "exp" else _u01_moves(data)
    found = [*moves]
    command = [*(str(what) for what, _, _ in found), str(Command.END)]
    step = [*((x, y) for _, x, y in found), (0, 0)]
    return Records(np.array(command), np.cumsum(np.array(step, dtype=np.int64), axis=0))


def _exp_moves(data: bytes) -> Iterator[tuple[Command, int, int]]:
    """Pairs of signed bytes; 80 hex announces a pair that is no stitch. Nothing marks the end."""
    kinds = {0x01: Command.STOP, 0x04: Command.JUMP}
    if len(data) % 2:
        raise DesignFileError(
            f"the EXP file breaks off in the middle of byte pair {len(data) // 2}"
        )
    pairs = iter(np.frombuffer(data, dtype=np.uint8).reshape(-1, 2).tolist())
    for x, y in pairs:
        if x != _EXP_CONTROL:
            yield Command.STITCH, _signed(x), _signed(y)
            continue
        moved = next(pairs, None)
        if y not in kinds or moved is None:
            raise DesignFileError(f"the EXP file holds an unknown or broken command {y:02X}")
        if kinds[y] is Command.STOP and any(moved):
            raise DesignFileError("the EXP file stops and moves at once")
        yield kinds[y], _signed(moved[0]), _signed(moved[1])


def _signed(byte: int) -> int:
    return byte - 256 if byte > 127 else byte


def _u01_moves(data: bytes) -> Iterator[tuple[Command, int, int]]:
    """Three bytes a record after a header of 256: kind and signs, then |y| and |x|."""
    kinds = {0x00: Command.STITCH, 0x01: Command.JUMP, 0x08: Command.STOP}
    body = data[_U01_HEADER_BYTES:]
    if len(body) % 3 or not body.endswith(_U01_END):
        raise DesignFileError("the U01 file breaks off: it does not end with its end record")
    for kind, y, x in np.frombuffer(body[:-3], dtype=np.uint8).reshape(-1, 3).tolist():
        if kind & 0x1F not in kinds or not kind & 0x80:
            raise DesignFileError(f"the U01 file holds an unknown record {kind:02X}")
        if kinds[kind & 0x1F] is Command.STOP and (x or y):
            raise DesignFileError("the U01 file stops and moves at once")
        yield kinds[kind & 0x1F], -x if kind & 0x20 else x, -y if kind & 0x40 else y
