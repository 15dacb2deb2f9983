"""DST: every byte of the header, and the body against two decoders."""

import io
import re
from contextlib import suppress
from itertools import pairwise

import numpy as np
import pystitch
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pyembroidery import DstWriter
from pystitch import DstReader

from patterns.records import Command, Records
from sesame_cad.errors import DesignFileError, InputError
from sesame_cad.files.dst import clean_label, decode_dst, write_dst
from sesame_cad.files.dst_records import read_records, record_bytes
from sesame_cad.files.dst_switches import DstSwitches
from sesame_cad.files.embroidery import embroidery_pattern

QUICK = settings(deadline=None, max_examples=60)
MOVES = st.tuples(
    st.sampled_from([Command.STITCH, Command.JUMP, Command.STOP]),
    st.integers(-121, 121),
    st.integers(-121, 121),
)


def records_of(moves: list[tuple[Command, int, int]]) -> Records:
    command = [str(what) for what, _, _ in moves] + [str(Command.END)]
    step = [(0, 0) if what is Command.STOP else (x, y) for what, x, y in moves] + [(0, 0)]
    return Records(np.array(command), np.cumsum(np.array(step, dtype=np.int64), axis=0))


def walk(*points: tuple[int, int]) -> Records:
    """Stitches from point to point, the first one from (0, 0)."""
    steps = [(b[0] - a[0], b[1] - a[1]) for a, b in pairwise([(0, 0), *points])]
    return records_of([(Command.STITCH, x, y) for x, y in steps])


def header_of(data: bytes) -> dict[str, str]:
    text = data[: data.index(b"\x1a")].decode("ascii")
    return dict(line.split(":", 1) for line in text.split("\r") if line)


def with_field(data: bytes, field: str, value: str) -> bytes:
    start = data.index(f"\r{field}:".encode()) + 1
    end = data.index(b"\r", start)
    return data[:start] + f"{field}:{value}".encode() + data[end:]


def assert_same(found: Records, expected: Records) -> None:
    assert list(found.command) == list(expected.command)
    np.testing.assert_array_equal(found.xy, expected.xy)


@QUICK
@given(st.lists(MOVES, max_size=60))
def test_every_point_and_stop_comes_back(moves):
    records = records_of(moves)
    assert_same(decode_dst(write_dst(records, "design")).records, records)


@QUICK
@given(st.lists(MOVES, max_size=60))
def test_a_second_library_reads_the_same(moves):
    records = records_of(moves)
    pattern = pystitch.EmbPattern()
    # Its readers turn three jumps into a trim unless told otherwise.
    DstReader.read(
        io.BytesIO(write_dst(records, "x")), pattern, {"trim_at": 10**9, "clipping": False}
    )
    codes = {
        pystitch.STITCH: "stitch",
        pystitch.JUMP: "jump",
        pystitch.COLOR_CHANGE: "stop",
        pystitch.END: "end",
    }
    found = [(codes[c & 0xFF], int(x), int(-y)) for x, y, c in pattern.stitches]
    expected = [
        (str(c), int(x), int(y)) for c, (x, y) in zip(records.command, records.xy, strict=True)
    ]
    assert found == expected


@QUICK
@given(st.lists(MOVES, max_size=40))
def test_the_header_agrees_with_the_body(moves):
    records = records_of(moves)
    data = write_dst(records, "design")
    x, y = [0, *records.xy[:, 0]], [0, *records.xy[:, 1]]
    said = {key: value.replace(" ", "") for key, value in header_of(data).items()}
    assert int(said["ST"]) == (len(data) - 512) // 3 - 1 == len(moves)
    assert int(said["CO"]) == sum(1 for k in range(514, len(data), 3) if data[k] == 0xC3)
    assert (int(said["+X"]), int(said["-X"])) == (max(x), -min(x))
    assert (int(said["+Y"]), int(said["-Y"])) == (max(y), -min(y))
    assert (int(said["AX"]), int(said["AY"])) == (x[-1], y[-1])


def test_the_header_byte_for_byte():
    data = write_dst(walk((100, 20), (30, -50)), "large-array")
    lines = ["LA:large-array     ", "ST:      2", "CO:  0", "+X:  100", "-X:    0", "+Y:   20"]
    lines += ["-Y:   50", "AX:+   30", "AY:-   50", "MX:+    0", "MY:+    0", "PD:******"]
    assert data[:512] == ("\r".join(lines) + "\r\x1a").encode().ljust(512)


def test_y_points_away_from_the_operator():
    """Against +Y and -Y exchanged."""
    said = header_of(write_dst(walk((0, 100)), "x"))
    assert (said["+Y"], said["-Y"], said["AY"]) == ("  100", "    0", "+  100")


def test_a_design_away_from_its_start_reaches_back_by_nothing():
    """Against extents that leave out the start point."""
    said = header_of(write_dst(walk((100, 100), (110, 120)), "x"))
    assert (said["-X"], said["-Y"]) == ("    0", "    0")
    said = header_of(write_dst(walk((-100, -100), (-110, -120)), "x"))
    assert (said["+X"], said["+Y"]) == ("    0", "    0")


def test_the_jumps_of_a_trim_count_one_by_one():
    """Against ST counting a trim as one of its records."""
    moves = [(Command.JUMP, 10, 0)] * 3 + [(Command.STITCH, 1, 1)]
    assert int(header_of(write_dst(records_of(moves), "x"))["ST"]) == 4


def test_stops_count_as_colour_changes():
    """Against CO leaving out stops."""
    moves = [(Command.STITCH, 1, 1), (Command.STOP, 0, 0), (Command.STITCH, 1, 1)]
    assert header_of(write_dst(records_of(moves), "x"))["CO"] == "  1"


@pytest.mark.parametrize("label", ["x" * 33, "x" * 600, "a\rST:      9\rb", "\x1a\x00ä☃", ""])
def test_no_label_moves_a_field(label):
    data = write_dst(walk((1, 1)), label)
    assert (data[:3], data[19:23], data[30:34]) == (b"LA:", b"\rST:", b"\rCO:")
    assert_same(decode_dst(data).records, walk((1, 1)))


@QUICK
@given(st.text(max_size=700))
def test_labels_are_printable_and_short(label):
    data = write_dst(walk((1, 1)), label)
    assert re.fullmatch(rb"LA:[ -~]{16}\rST:      1\r", data[:31])
    assert decode_dst(data).header.label == clean_label(label)


def test_999_stops_fit_and_1000_do_not():
    moves = [(Command.STITCH, 1, 1), (Command.STOP, 0, 0)]
    assert header_of(write_dst(records_of(moves * 999), "x"))["CO"] == "999"
    with pytest.raises(InputError, match="1000 stops; DST has room for 999"):
        write_dst(records_of(moves * 1000), "x")


def test_a_long_stitch_is_refused_rather_than_made_a_jump():
    assert len(write_dst(walk((121, -121)), "x")) == 512 + 6
    with pytest.raises(InputError, match=r"record 0 moves 12\.2 mm"):
        write_dst(walk((122, 0)), "x")


def test_extents_beyond_five_figures_are_refused():
    moves = [(Command.STITCH, 100, 0)] * 999 + [(Command.STITCH, 99, 0)]
    assert header_of(write_dst(records_of(moves), "x"))["+X"] == "99999"
    with pytest.raises(InputError, match="reaches 10000 mm"):
        write_dst(records_of([*moves, (Command.STITCH, 1, 0)]), "x")


def test_records_without_an_end_or_with_moving_stops_are_refused():
    with pytest.raises(InputError, match="do not end"):
        write_dst(Records(np.array(["stitch"]), np.array([[1, 1]])), "x")
    with pytest.raises(InputError, match="moves the hoop"):
        write_dst(Records(np.array(["stop", "end"]), np.array([[1, 1], [1, 1]])), "x")


def test_many_moves_do_not_drift():
    moves = [
        (Command.STITCH, (-1) ** k * (k % 122), (-1) ** k * (7 * k % 122)) for k in range(20_000)
    ]
    assert_same(decode_dst(write_dst(records_of(moves), "x")).records, records_of(moves))


@pytest.mark.parametrize("field", ["ST", "CO", "+X", "-X", "+Y", "-Y", "AX", "AY"])
def test_a_false_header_is_found(field):
    data = write_dst(walk((10, 20), (-30, -40)), "x")
    with pytest.raises(DesignFileError, match="header's"):
        decode_dst(with_field(data, field, header_of(data)[field][:-1] + "7"))


@QUICK
@given(st.binary(max_size=700))
def test_random_bytes_are_refused(data):
    with pytest.raises(DesignFileError, match=r"^[^\n]+$"):
        decode_dst(data)


@QUICK
@given(st.data(), st.lists(MOVES, min_size=1, max_size=10))
def test_damage_is_refused_or_harmless(data, moves):
    whole = write_dst(records_of(moves), "x")
    place = data.draw(st.integers(0, len(whole) - 1))
    damaged = whole[:place] + bytes([data.draw(st.integers(0, 255))]) + whole[place + 1 :]
    with suppress(DesignFileError):
        decode_dst(damaged)


@QUICK
@given(st.data(), st.lists(MOVES, max_size=10))
def test_a_truncated_file_is_refused(data, moves):
    whole = write_dst(records_of(moves), "x")
    with pytest.raises(DesignFileError):
        decode_dst(whole[: data.draw(st.integers(0, len(whole) - 1))])


def test_bytes_after_the_end_and_unknown_records_are_refused():
    whole = write_dst(walk((1, 1)), "x")
    decode_dst(whole + b"\x1a")
    with pytest.raises(DesignFileError, match="after the end record"):
        decode_dst(whole + b"abc")
    with pytest.raises(DesignFileError, match="no known kind"):
        decode_dst(whole[:512] + b"\x00\x00\x40" + whole[512:])


DEMANDING = DstSwitches(refuses_zero_colours=True, double_stop=True)


@QUICK
@given(st.lists(MOVES, max_size=60), st.booleans(), st.booleans())
def test_switches_come_back_as_the_plain_records(moves, one_colour, double):
    """Stops side by side are what another stop would be: plans have none."""
    stop = Command.STOP
    apart = [
        move
        for before, move in pairwise([(stop, 0, 0), *moves])
        if not before[0] is move[0] is stop
    ]
    records, switches = records_of(apart), DstSwitches(one_colour, double)
    data = write_dst(records, "x", switches)
    assert_same(decode_dst(data, switches).records, records)
    stops = int(np.sum(records.command == Command.STOP))
    assert sum(data[k] == 0xC3 for k in range(514, len(data), 3)) == stops * (1 + double)
    assert int(header_of(data)["CO"]) == max(stops * (1 + double), int(one_colour))


def test_no_colour_change_is_told_as_one_and_read_only_by_who_asked_for_it():
    data = write_dst(walk((1, 1)), "x", DEMANDING)
    assert header_of(data)["CO"] == "  1"
    with pytest.raises(DesignFileError, match="stop_count is 1"):
        decode_dst(data)
    with pytest.raises(DesignFileError, match="stop_count is 0"):
        decode_dst(write_dst(walk((1, 1)), "x"), DEMANDING)


def test_a_stop_alone_is_none_of_two():
    moves = [(Command.STITCH, 1, 1), (Command.STOP, 0, 0), (Command.STITCH, 1, 1)]
    with pytest.raises(DesignFileError, match="stands alone"):
        decode_dst(write_dst(records_of(moves), "x"), DEMANDING)
    with pytest.raises(DesignFileError, match="stands alone"):
        decode_dst(write_dst(records_of(moves * 2), "x"), DEMANDING)


def test_records_are_encoded_as_the_library_does() -> None:
    rng = np.random.default_rng(0)
    step = rng.integers(-121, 122, (2000, 2))
    command = rng.choice(["stitch", "jump", "stop"], len(step), p=[0.6, 0.3, 0.1])
    command[-1] = "end"
    step[np.isin(command, ["stop", "end"])] = 0
    records = Records(command, np.cumsum(step, axis=0))
    whole = io.BytesIO()
    DstWriter.write(embroidery_pattern(records), whole)
    assert record_bytes(records) == whole.getvalue()[512:]


@pytest.mark.parametrize("body", [b"\x01\x00\xc3\x00\x00\xf3", b"\x00\x00\x03\x01\x00\xf3"])
def test_a_stop_or_an_end_that_moves_is_refused(body):
    with pytest.raises(DesignFileError, match="stops and moves"):
        read_records(body)
