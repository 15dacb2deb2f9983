"""EXP and U01 come back exactly, through pystitch and through the own decoder."""

import io
from contextlib import suppress

import numpy as np
import pystitch
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pystitch import ExpReader, U01Reader

from patterns.records import Command, Records
from sesame_cad.errors import DesignFileError, InputError
from sesame_cad.files.embroidery import read_embroidery, write_embroidery

QUICK = settings(deadline=None, max_examples=60)
FORMATS = ["exp", "u01"]
READERS = {"exp": ExpReader, "u01": U01Reader}
MOVES = st.lists(
    st.tuples(
        st.sampled_from([Command.STITCH, Command.JUMP, Command.STOP]),
        st.integers(-121, 121),
        st.integers(-121, 121),
    ),
    max_size=60,
)


def records_of(moves) -> Records:
    command = [str(what) for what, _, _ in moves] + [str(Command.END)]
    step = [(0, 0) if what is Command.STOP else (x, y) for what, x, y in moves] + [(0, 0)]
    return Records(np.array(command), np.cumsum(np.array(step, dtype=np.int64), axis=0))


def library_rows(data: bytes, kind: str) -> list[tuple[str, int, int]]:
    pattern = pystitch.EmbPattern()
    READERS[kind].read(io.BytesIO(data), pattern)
    codes = {pystitch.STITCH: "stitch", pystitch.JUMP: "jump", pystitch.STOP: "stop"}
    codes |= {pystitch.COLOR_CHANGE: "stop", pystitch.END: "end"}
    return [(codes[c & 0xFF], int(x), int(-y)) for x, y, c in pattern.stitches]


def rows(records: Records) -> list[tuple[str, int, int]]:
    return [(str(c), int(x), int(y)) for c, (x, y) in zip(records.command, records.xy, strict=True)]


@pytest.mark.parametrize("kind", FORMATS)
@QUICK
@given(moves=MOVES)
def test_every_point_and_stop_comes_back(kind, moves):
    records = records_of(moves)
    data = write_embroidery(records, kind)
    assert library_rows(data, kind) == rows(records)
    assert rows(read_embroidery(data, kind)) == rows(records)


@pytest.mark.parametrize("kind", FORMATS)
def test_moves_and_extents_out_of_range_are_refused(kind):
    with pytest.raises(InputError, match=r"moves 12\.2 mm"):
        write_embroidery(records_of([(Command.STITCH, 0, 122)]), kind)
    with pytest.raises(InputError, match=r"reaches 3276\.8 mm"):
        write_embroidery(records_of([(Command.STITCH, 64, 0)] * 512), kind)


@pytest.mark.parametrize("kind", FORMATS)
def test_broken_files_are_refused(kind):
    whole = write_embroidery(records_of([(Command.STITCH, 5, 5), (Command.STOP, 0, 0)]), kind)
    with pytest.raises(DesignFileError, match="breaks off"):
        read_embroidery(whole[:-1] if kind == "exp" else whole[:-3], kind)
    unknown = {
        "exp": whole[:-4] + b"\x80\x77\x00\x00",
        "u01": whole[:-3] + b"\x9f\x00\x00\xf8\x00\x00",
    }
    with pytest.raises(DesignFileError, match="unknown"):
        read_embroidery(unknown[kind], kind)
    moving = {"exp": b"\x80\x01\x05\x00", "u01": b"\x88\x05\x00\xf8\x00\x00"}
    with pytest.raises(DesignFileError, match="stops and moves"):
        read_embroidery(whole[: {"exp": -4, "u01": -6}[kind]] + moving[kind], kind)


@pytest.mark.parametrize("kind", FORMATS)
@QUICK
@given(data=st.binary(max_size=400))
def test_random_bytes_raise_nothing_else(kind, data):
    with suppress(DesignFileError):
        read_embroidery(data, kind)
