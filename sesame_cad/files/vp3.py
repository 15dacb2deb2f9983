"""Pfaff and Husqvarna VP3: a block for each colour, without jumps."""

from __future__ import annotations

import io
import struct
from collections.abc import Iterator, Sequence

import numpy as np
from pyembroidery import JUMP, TRIM, EmbPattern, Vp3Writer

from patterns.records import Command, Records
from sesame_cad.errors import DesignFileError
from sesame_cad.files.embroidery import coloured_pattern, run_starts, signed, without_travel
from sesame_cad.threads import Thread

LOSSES = (
    "every stop is a colour change, and comes before the machine travels",
    "there are no jumps: the travel before a run is a trim and a long stitch",
)

_MAGIC = b"%vsm%\x00"
_BLOCK, _STITCHES = b"\x00\x05\x00", b"\x0a\xf6\x00"
_CONTROL, _LONG, _AFTER_LONG, _TRIM = 0x80, 0x01, 0x02, 0x03
_UNITS = 100
"""Positions of blocks count in hundredths of 0.1 mm."""


def write_vp3(records: Records, threads: Sequence[Thread]) -> bytes:
    """Encode a design."""
    sewn = without_travel(records)
    pattern = coloured_pattern(sewn, threads)
    for k in run_starts(records)[:0:-1].tolist():
        pattern.stitches.insert(k, [*pattern.stitches[k - 1][:2], TRIM])
    _make_even(pattern)
    whole = io.BytesIO()
    Vp3Writer.write(pattern, whole)
    return whole.getvalue()


def _make_even(pattern: EmbPattern) -> None:
    """Widen the design by a jump, which is not written, to an even number of 0.1 mm.

    pyembroidery counts blocks from the design's centre, and cuts off what is no whole number: the
    blocks of a design with an odd size would be 0.1 mm apart from each other.
    """
    x, y = np.array(pattern.stitches)[:, :2].T
    right, bottom = int(x.max()), int(y.max())
    pattern.stitches.insert(
        -1, [right + (right - int(x.min())) % 2, bottom + (bottom - int(y.min())) % 2, JUMP]
    )


def read_vp3(data: bytes) -> Records:
    """Decode a design: its needle points, and a stop between blocks.

    Raises
    ------
    DesignFileError
        When the data breaks off or is not built as `write_vp3` builds it.
    """
    command: list[str] = []
    places: list[tuple[int, int]] = []
    for k, points in enumerate(_blocks(_Bytes(data))):
        if k:
            command.append(str(Command.STOP))
            places.append(places[-1] if places else (0, 0))
        command.extend([str(Command.STITCH)] * len(points))
        places.extend(points)
    command.append(str(Command.END))
    places.append(places[-1] if places else (0, 0))
    return Records(np.array(command), np.array(places, dtype=np.int64))


class _Bytes:
    """Bytes, read one part after the other."""

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.place = 0

    def take(self, count: int) -> bytes:
        part = self.data[self.place : self.place + count]
        if len(part) < count:
            raise DesignFileError(f"the VP3 file breaks off after {len(self.data)} bytes")
        self.place += count
        return part

    def expect(self, mark: bytes, what: str) -> None:
        if self.take(len(mark)) != mark:
            raise DesignFileError(f"the VP3 file has no {what} at byte {self.place - len(mark)}")

    def integer(self) -> int:
        value: int = struct.unpack(">i", self.take(4))[0]
        return value

    def text(self) -> bytes:
        return self.take(int.from_bytes(self.take(2), "big"))


def _blocks(data: _Bytes) -> Iterator[list[tuple[int, int]]]:
    """Needle points of each block, in 0.1 mm, y up."""
    data.expect(_MAGIC, "signature")
    data.text()
    data.take(7)
    data.text()
    data.take(32)
    centre = data.integer() // _UNITS, data.integer() // _UNITS
    data.take(27)
    data.text()
    data.take(24)
    data.text()
    for _ in range(int.from_bytes(data.take(2), "big")):
        data.expect(_BLOCK, "block")
        length = data.integer()
        end = data.place + length
        x, y = centre[0] + data.integer() // _UNITS, centre[1] + data.integer() // _UNITS
        _skip_thread(data)
        data.take(15)
        data.expect(_STITCHES, "stitches")
        if end < data.place:
            raise DesignFileError(f"a block of the VP3 file is {length} bytes long")
        yield [*_needles(data.take(end - data.place)[:-1], x, y)]


def _skip_thread(data: _Bytes) -> None:
    data.take(10)  # one colour, without a transition; the kind of thread and its weight
    for _ in range(3):
        data.text()


def _needles(body: bytes, x: int, y: int) -> Iterator[tuple[int, int]]:
    """Add up the steps; what is longer than a byte can say follows 80 01, as two bytes each."""
    k = 0
    while k + 1 < len(body):
        first, second = body[k], body[k + 1]
        k += 2
        if first != _CONTROL:
            step = signed(first), signed(second)
        elif second == _LONG and k + 4 <= len(body):
            step = struct.unpack_from(">hh", body, k)
            k += 4
        elif second in (_AFTER_LONG, _TRIM):
            continue
        else:
            raise DesignFileError(f"the VP3 file holds an unknown or broken command {second:02X}")
        x, y = x + step[0], y - step[1]
        yield x, y
