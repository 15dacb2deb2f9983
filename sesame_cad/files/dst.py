"""Tajima DST: a 512-byte header, then three bytes a record."""

from __future__ import annotations

import re
from dataclasses import dataclass, fields

import numpy as np

from patterns.plan import Points
from patterns.records import LARGEST_STEP, Command, Records
from sesame_cad.errors import DesignFileError, InputError
from sesame_cad.files.dst_records import RECORD_BYTES, read_records, record_bytes
from sesame_cad.files.dst_switches import DstSwitches

HEADER_BYTES = 512
LABEL_CHARACTERS = 16
MOST_STOPS = 999
MOST_RECORDS = 9_999_999
LARGEST_EXTENT = 99_999
"""Largest extent, in 0.1 mm, for which the header has room (five figures)."""

_FIELD = re.compile(r"([A-Z+-][A-Z]):([^\r]*)\r")


@dataclass(frozen=True)
class DstHeader:
    """What the header says; lengths in units of 0.1 mm.

    Attributes
    ----------
    label : str
        At most 16 characters.
    record_count : int
        Records before the end record (ST).
    stop_count : int
        Stops or colour changes (CO).
    right, left, up, down : int
        How far the design reaches from its start, never negative (+X, -X, +Y, -Y).
    end : tuple of int
        Where it ends (AX, AY).
    """

    label: str
    record_count: int
    stop_count: int
    right: int
    left: int
    up: int
    down: int
    end: tuple[int, int]


PLAIN = DstSwitches()


@dataclass(frozen=True)
class DstFile:
    """A file as read: what it says of itself, and what it holds."""

    header: DstHeader
    records: Records


def dst_header(records: Records, label: str, switches: DstSwitches = PLAIN) -> DstHeader:
    """Sum up records for the header, with the label reduced to what the format can hold.

    Parameters
    ----------
    records
        As they stand in the file: with double stops, each twice.
    """
    low, high = _extents(records.xy)
    return DstHeader(
        label=clean_label(label),
        record_count=int(np.sum(records.command != Command.END)),
        stop_count=max(
            int(np.sum(records.command == Command.STOP)), int(switches.refuses_zero_colours)
        ),
        right=int(high[0]),
        left=-int(low[0]),
        up=int(high[1]),
        down=-int(low[1]),
        end=(int(records.xy[-1, 0]), int(records.xy[-1, 1])),
    )


def clean_label(label: str) -> str:
    """Keep the printable ASCII characters of a label, at most 16, without spaces at its ends."""
    printable = "".join(c if " " <= c <= "~" else " " for c in label)
    return " ".join(printable.split())[:LABEL_CHARACTERS].rstrip()


def write_dst(records: Records, label: str, switches: DstSwitches = PLAIN) -> bytes:
    """Encode a design.

    The header is written here: the libraries' has +Y and -Y exchanged, takes labels of any length,
    counts trims and stops wrongly and errs where the design does not contain its start.

    Parameters
    ----------
    label : str
        Name shown on the machine; cleaned and cut to 16 ASCII characters.

    Raises
    ------
    InputError
        When the header has no room for the numbers, or the records do not end.
    """
    ends = np.flatnonzero(records.command == Command.END)
    if list(ends) != [len(records.command) - 1]:
        raise InputError("the records do not end with their one end record")
    if switches.double_stop:
        records = _doubled_stops(records)
    header = dst_header(records, label, switches)
    faults = _faults(records, header)
    if faults:
        raise InputError(*faults)
    return _header_bytes(header) + record_bytes(records)


def decode_dst(data: bytes, switches: DstSwitches = PLAIN) -> DstFile:
    """Decode a design and check it against its own header.

    Parameters
    ----------
    switches
        What it was written with. Stops that stand there twice are then given once.

    Raises
    ------
    DesignFileError
        When anything in the file is not as the format has it.
    """
    if len(data) < HEADER_BYTES + RECORD_BYTES:
        raise DesignFileError(
            f"{len(data)} bytes are no DST file: header and end record are "
            f"{HEADER_BYTES + RECORD_BYTES} bytes"
        )
    if len(data) > HEADER_BYTES + RECORD_BYTES * MOST_RECORDS:
        raise DesignFileError(
            f"{len(data)} bytes are no DST file: its header counts to {MOST_RECORDS} records"
        )
    header = _read_header(data[:HEADER_BYTES])
    records = read_records(data[HEADER_BYTES:])
    _check_header(header, dst_header(records, header.label, switches))
    return DstFile(header, _single_stops(records) if switches.double_stop else records)


def _doubled_stops(records: Records) -> Records:
    times = np.where(records.command == Command.STOP, 2, 1)
    return Records(np.repeat(records.command, times), np.repeat(records.xy, times, axis=0))


def _single_stops(records: Records) -> Records:
    """Leave out the second stop of every pair."""
    stops = np.flatnonzero(records.command == Command.STOP)
    first, second = stops[::2], stops[1::2]
    if len(first) != len(second) or np.any(second - first != 1):
        raise DesignFileError("a stop of the DST file stands alone; the machine wants two in a row")
    return Records(np.delete(records.command, second), np.delete(records.xy, second, axis=0))


def _extents(xy: Points) -> tuple[Points, Points]:
    return np.minimum(xy.min(axis=0), 0), np.maximum(xy.max(axis=0), 0)


def _faults(records: Records, header: DstHeader) -> tuple[str, ...]:
    step = np.abs(np.diff(records.xy, axis=0, prepend=0)).max(axis=1)
    reach = max(header.right, header.left, header.up, header.down)
    idle = np.isin(records.command, [Command.STOP, Command.END])
    checks = (
        (
            step.max() <= LARGEST_STEP,
            (
                f"record {int(np.argmax(step))} moves {step.max() / 10:.1f} mm "
                f"along one axis; DST holds {LARGEST_STEP / 10} mm"
            ),
        ),
        (not np.any(step[idle]), "a stop or the end moves the hoop; DST cannot say so"),
        (
            header.stop_count <= MOST_STOPS,
            f"{header.stop_count} stops; DST has room for {MOST_STOPS}: split the design",
        ),
        (
            reach <= LARGEST_EXTENT,
            (
                f"the design reaches {reach / 10:g} mm from its start; DST has "
                f"room for {LARGEST_EXTENT / 10} mm"
            ),
        ),
        (
            header.record_count <= MOST_RECORDS,
            f"{header.record_count} records; DST counts to {MOST_RECORDS}",
        ),
    )
    return tuple(message for good, message in checks if not good)


def _header_bytes(header: DstHeader) -> bytes:
    x, y = header.end
    lines = (
        f"LA:{header.label:<16}",
        f"ST:{header.record_count:7d}",
        f"CO:{header.stop_count:3d}",
        f"+X:{header.right:5d}",
        f"-X:{header.left:5d}",
        f"+Y:{header.up:5d}",
        f"-Y:{header.down:5d}",
        f"AX:{'-' if x < 0 else '+'}{abs(x):5d}",
        f"AY:{'-' if y < 0 else '+'}{abs(y):5d}",
        "MX:+    0",
        "MY:+    0",
        "PD:******",
    )
    text = "".join(line + "\r" for line in lines).encode("ascii") + b"\x1a"
    return text.ljust(HEADER_BYTES, b" ")


def _read_header(data: bytes) -> DstHeader:
    # Without the mark the padding stays, which is no field.
    text, _, _ = data.decode("latin-1").partition("\x1a")
    if _FIELD.sub("", text):
        raise DesignFileError("the DST header is not a list of fields that ends with the byte 1A")
    found = _FIELD.findall(text)
    values = dict(found)
    if len(values) != len(found):
        raise DesignFileError("a field stands twice in the DST header")
    return DstHeader(
        label=values.get("LA", "").rstrip(" "),
        record_count=_number(values, "ST"),
        stop_count=_number(values, "CO"),
        right=_number(values, "+X"),
        left=_number(values, "-X"),
        up=_number(values, "+Y"),
        down=_number(values, "-Y"),
        end=(_number(values, "AX"), _number(values, "AY")),
    )


def _check_header(said: DstHeader, held: DstHeader) -> None:
    for field in fields(DstHeader):
        value, right = getattr(said, field.name), getattr(held, field.name)
        if value != right:
            raise DesignFileError(
                f"the DST header's {field.name} is {value!r}, but its records make it {right!r}"
            )


def _number(values: dict[str, str], field: str) -> int:
    text = values.get(field)
    if text is None:
        raise DesignFileError(f"the DST header has no field {field}")
    if not re.fullmatch(r" *[+-]? *[0-9]{1,9}", text):
        raise DesignFileError(f"the DST header's field {field} is no number: {text!r}")
    return int(text.replace(" ", ""))
