"""The records of a DST file: three bytes each, read and written with no library."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from patterns.plan import Points
from patterns.records import Command, Records
from sesame_cad.errors import DesignFileError

RECORD_BYTES = 3

X_WEIGHTS = (
    (1, -1, 9, -9, 0, 0, 0, 0),
    (3, -3, 27, -27, 0, 0, 0, 0),
    (0, 0, 81, -81, 0, 0, 0, 0),
)
"""What the bits of the three bytes add to x, least significant first."""

Y_WEIGHTS = (
    (0, 0, 0, 0, -9, 9, -1, 1),
    (0, 0, 0, 0, -27, 27, -3, 3),
    (0, 0, 0, 0, -81, 81, 0, 0),
)

_PLACES = (1, 3, 9, 27, 81)

_STITCH, _JUMP, _STOP, _END = 0x03, 0x83, 0xC3, 0xF3
_COMMANDS = {_STITCH: Command.STITCH, _JUMP: Command.JUMP, _STOP: Command.STOP}


def read_records(body: bytes) -> Records:
    """Decode what follows the header.

    Raises
    ------
    DesignFileError
        When there is no end record, something behind it, or a record of no kind.
    """
    table = np.frombuffer(body[: len(body) // RECORD_BYTES * RECORD_BYTES], dtype=np.uint8)
    table = table.reshape(-1, RECORD_BYTES)
    ends = np.flatnonzero(table[:, 2] == _END)
    if len(ends) == 0:
        raise DesignFileError(f"the DST file breaks off after {len(table)} records: no end record")
    table = table[: ends[0] + 1]
    if body[len(table) * RECORD_BYTES :].strip(b"\x1a\x00 "):
        raise DesignFileError(f"there are bytes after the end record, record {ends[0]}")
    kind = (table[:, 2] & 0xC3).astype(np.uint8)
    kind[-1] = _END
    step = _steps(table)
    _check_kinds(kind, step)
    command = np.full(len(kind), str(Command.END), dtype="<U6")
    for byte, name in _COMMANDS.items():
        command[kind == byte] = str(name)
    return Records(command, np.cumsum(step, axis=0))


def record_bytes(records: Records) -> bytes:
    """Encode records, none of which moves farther than one can hold."""
    step = np.diff(records.xy, axis=0, prepend=0)
    table = np.zeros((len(step), RECORD_BYTES), dtype=np.uint8)
    digits = _digits(step)
    for k, weights in enumerate(zip(X_WEIGHTS, Y_WEIGHTS, strict=True)):
        for axis, of_bits in enumerate(weights):
            for bit, weight in enumerate(of_bits):
                if weight:
                    place = _PLACES.index(abs(weight))
                    set_here = digits[:, axis, place] == np.sign(weight)
                    table[:, k] |= (set_here << bit).astype(np.uint8)
    for byte, name in (*_COMMANDS.items(), (_END, Command.END)):
        table[records.command == name, 2] |= byte
    return table.tobytes()


def _digits(step: Points) -> NDArray[np.int8]:
    """Balanced ternary digits (n, 2, 5) of displacements, the lowest first."""
    rest = step.copy()
    digits = np.empty((*step.shape, len(_PLACES)), dtype=np.int8)
    for place in range(len(_PLACES)):
        digits[..., place] = (rest + 1) % 3 - 1
        rest = (rest - digits[..., place]) // 3
    return digits


def _check_kinds(kind: NDArray[np.uint8], step: Points) -> None:
    unknown = ~np.isin(kind, [*_COMMANDS, _END])
    moving = np.isin(kind, [_STOP, _END]) & np.any(step != 0, axis=1)
    for wrong, what in ((unknown, "is of no known kind"), (moving, "stops and moves at once")):
        if np.any(wrong):
            raise DesignFileError(f"record {int(np.argmax(wrong))} of the DST file {what}")


def _steps(table: NDArray[np.uint8]) -> Points:
    """Displacements in balanced ternary: one bit a sign of 1, 3, 9, 27 and 81 units."""
    bits = np.unpackbits(np.arange(256, dtype=np.uint8)[:, None], axis=1, bitorder="little")
    steps = np.zeros((len(table), 2), dtype=np.int64)
    # What each value of a byte adds, looked up: a long file is decoded in little memory.
    for k, weights in enumerate(zip(X_WEIGHTS, Y_WEIGHTS, strict=True)):
        steps += (bits @ np.array(weights).T)[table[:, k]]
    return steps
