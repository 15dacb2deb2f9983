"""Brother PES version 1, whose PEC part the machine sews."""

from __future__ import annotations

import io
import struct
from collections.abc import Iterator, Sequence

import numpy as np
from pyembroidery import JUMP, EmbPattern, PesWriter

from patterns.records import Command, Records
from sesame_cad.errors import DesignFileError, InputError
from sesame_cad.files.embroidery import (
    coloured_pattern,
    records_of_moves,
    run_starts,
    without_travel,
)
from sesame_cad.threads import Thread

LOSSES = (
    "every stop is a colour change, and comes before the machine travels",
    "the travel before a run is one trim and jump to its first needle point",
    "the machine centres the design in its own hoop: the hoop's centre is not kept",
    "colours are the nearest of Brother's own threads",
)

LONGEST_JUMP = 2047
"""Largest displacement of a record along each axis, in 0.1 mm: 12 bits with sign."""

_SIGNATURE = b"#PES0001"
_HEADER_BYTES = 528
_COLOUR_CHANGE = b"\xfe\xb0"
_END = 0xFF
_LONG, _JUMP_FLAG, _TRIM_FLAG = 0x80, 0x10, 0x20


def carried_by_pes(records: Records) -> Records:
    """Give the records as this format holds them: each travel ends at the first needle point.

    pyembroidery puts a needle point of its own where a travel ends, so it must be one of ours.
    """
    sewn = without_travel(records)
    starts = run_starts(records)
    before = np.concatenate([np.zeros((1, 2), dtype=np.int64), sewn.xy])[starts]
    count = np.maximum(1, -(-np.abs(sewn.xy[starts] - before).max(axis=1) // LONGEST_JUMP))
    share = np.concatenate([np.arange(1, n + 1) / n for n in count])[:, None]
    step = np.repeat(sewn.xy[starts] - before, count, axis=0)
    jumps = np.repeat(before, count, axis=0) + np.floor(step * share + 0.5).astype(np.int64)
    at = np.repeat(starts, count)
    return Records(
        np.insert(sewn.command, at, str(Command.JUMP)), np.insert(sewn.xy, at, jumps, axis=0)
    )


def write_pes(records: Records, threads: Sequence[Thread]) -> bytes:
    """Encode a design.

    Raises
    ------
    InputError
        When it reaches farther from its start than the format can say.
    """
    reach = int(np.abs(records.xy).max(initial=0))
    if reach > LONGEST_JUMP:
        raise InputError(
            f"the design reaches {reach / 10:g} mm from its start; PES has room for "
            f"{LONGEST_JUMP / 10} mm"
        )
    pattern = coloured_pattern(carried_by_pes(records), threads)
    _count_from_corner(pattern)
    whole = io.BytesIO()
    PesWriter.write(pattern, whole)
    return whole.getvalue()


def _count_from_corner(pattern: EmbPattern) -> None:
    """Begin with the jump from the design's upper left corner to its start.

    Readers take it for the origin, and skip it; pyembroidery does not write it.
    """
    left, top = (min(stitch[axis] for stitch in pattern.stitches) for axis in (0, 1))
    left, top = min(left, 0), min(top, 0)
    for stitch in pattern.stitches:
        stitch[0] -= left
        stitch[1] -= top
    pattern.stitches.insert(0, [-left, -top, JUMP])


def read_pes(data: bytes) -> Records:
    """Decode the part that is sewn.

    Raises
    ------
    DesignFileError
        When the data breaks off, is of another version, or does not begin with its origin.
    """
    if data[: len(_SIGNATURE)] != _SIGNATURE or len(data) < 12:
        raise DesignFileError(f"no PES file of version 1: it does not begin with {_SIGNATURE!r}")
    start = struct.unpack_from("<I", data, len(_SIGNATURE))[0] + _HEADER_BYTES
    moves = _moves(data, start)
    origin = next(moves, None)
    if origin is None or origin[0] is not Command.JUMP:
        raise DesignFileError("the PES file does not begin with the jump from its corner")
    return records_of_moves(moves)


def _moves(data: bytes, place: int) -> Iterator[tuple[Command, int, int]]:
    """Numbers of one byte, or of two with flags; FE B0 changes the colour, FF ends."""
    while place < len(data) and data[place] != _END:
        if data[place : place + 2] == _COLOUR_CHANGE:
            place += 3
            yield Command.STOP, 0, 0
            continue
        x, x_flags, place = _number(data, place)
        y, y_flags, place = _number(data, place)
        travel = (x_flags | y_flags) & (_JUMP_FLAG | _TRIM_FLAG)
        yield (Command.JUMP if travel else Command.STITCH), x, -y
    if place >= len(data):
        raise DesignFileError("the PES file breaks off: no end record")


def _number(data: bytes, place: int) -> tuple[int, int, int]:
    """Give the number at a place, its flags and the place behind it."""
    if place + 1 >= len(data):
        raise DesignFileError("the PES file breaks off in the middle of a record")
    first = data[place]
    if not first & _LONG:
        return (first - 128 if first > 63 else first), 0, place + 1
    value = (first & 0x0F) << 8 | data[place + 1]
    return (value - 4096 if value > LONGEST_JUMP else value), first & 0x70, place + 2
