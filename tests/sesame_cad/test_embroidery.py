"""EXP, U01 and JEF come back exactly, through pystitch and through the own decoder."""

import io
from contextlib import suppress

import numpy as np
import pystitch
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pystitch import ExpReader, JefReader, U01Reader

from patterns.records import Command, Records
from sesame_cad.errors import DesignFileError, InputError
from sesame_cad.files.stitch_formats import FORMATS, write_embroidery
from sesame_cad.threads import Thread

QUICK = settings(deadline=None, max_examples=60)
EXACT = ["exp", "u01", "jef"]
READERS = {"exp": ExpReader, "u01": U01Reader, "jef": JefReader}
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


def threads_of(records: Records) -> list[Thread]:
    stops = int(np.sum(records.command == "stop"))
    return [Thread("thread", "thread", 1, f"#0000{k % 256:02x}") for k in range(stops + 1)]


def library_rows(data: bytes, kind: str) -> list[tuple[str, int, int]]:
    pattern = pystitch.EmbPattern()
    as_it_is = {"trims": False, "trim_distance": None, "clipping": False}
    READERS[kind].read(io.BytesIO(data), pattern, as_it_is)
    codes = {pystitch.STITCH: "stitch", pystitch.JUMP: "jump", pystitch.STOP: "stop"}
    codes |= {pystitch.COLOR_CHANGE: "stop", pystitch.END: "end"}
    codes |= {pystitch.TRIM: "jump"}  # of JEF, a jump to where the machine stands
    return [(codes[c & 0xFF], int(x), int(-y)) for x, y, c in pattern.stitches]


def rows(records: Records) -> list[tuple[str, int, int]]:
    return [(str(c), int(x), int(y)) for c, (x, y) in zip(records.command, records.xy, strict=True)]


@pytest.mark.parametrize("kind", EXACT)
@QUICK
@given(moves=MOVES)
def test_every_point_and_stop_comes_back(kind, moves):
    # JEF has a colour for what is sewn before the first stop, so something must be.
    records = records_of([(Command.STITCH, 1, 1), *moves])
    data = write_embroidery(records, kind, threads_of(records))
    assert library_rows(data, kind) == rows(records)
    assert rows(FORMATS[kind].read(data)) == rows(records)


@pytest.mark.parametrize("kind", FORMATS)
def test_moves_and_extents_out_of_range_are_refused(kind):
    thread = threads_of(records_of([]))
    with pytest.raises(InputError, match=r"moves 12\.2 mm"):
        write_embroidery(records_of([(Command.STITCH, 0, 122)]), kind, thread)
    with pytest.raises(InputError, match=r"reaches 3276\.8 mm"):
        write_embroidery(records_of([(Command.STITCH, 64, 0)] * 512), kind, thread)


def test_a_thread_for_each_block():
    records = records_of([(Command.STITCH, 1, 0), (Command.STOP, 0, 0), (Command.STITCH, 1, 0)])
    with pytest.raises(InputError, match="2 blocks and 1 threads"):
        write_embroidery(records, "jef", threads_of(records)[:1])


def test_a_format_that_does_not_hold_the_design_is_refused():
    """A stop without stitches around it is a needle point in PES."""
    records = records_of([(Command.JUMP, 9, 9), (Command.STOP, 0, 0), (Command.STITCH, 5, 5)])
    with pytest.raises(InputError, match="PES file does not hold the design"):
        write_embroidery(records, "pes", threads_of(records))


@pytest.mark.parametrize("kind", EXACT)
def test_broken_files_are_refused(kind):
    records = records_of([(Command.STITCH, 5, 5), (Command.STOP, 0, 0)])
    whole = write_embroidery(records, kind, threads_of(records))
    read = FORMATS[kind].read
    with pytest.raises(DesignFileError, match="breaks off"):
        read(whole[:-3] if kind == "u01" else whole[:-1])
    unknown = {
        "exp": whole[:-4] + b"\x80\x77\x00\x00",
        "u01": whole[:-3] + b"\x9f\x00\x00\xf8\x00\x00",
        "jef": whole[:-2] + b"\x80\x77\x00\x00\x80\x10",
    }
    with pytest.raises(DesignFileError, match="unknown"):
        read(unknown[kind])
    moving = {
        "exp": whole[:-4] + b"\x80\x01\x05\x00",
        "u01": whole[:-6] + b"\x88\x05\x00\xf8\x00\x00",
        "jef": whole[:-6] + b"\x80\x01\x05\x00\x80\x10",
    }
    with pytest.raises(DesignFileError, match="stops and moves"):
        read(moving[kind])


@pytest.mark.parametrize("kind", FORMATS)
@QUICK
@given(data=st.binary(max_size=400))
def test_random_bytes_raise_nothing_else(kind, data):
    with suppress(DesignFileError):
        FORMATS[kind].read(data)
