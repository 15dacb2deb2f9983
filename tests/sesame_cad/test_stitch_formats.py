"""What every format holds of a real plan, read back by pystitch, and what it is said to lose."""

import io
from contextlib import suppress
from datetime import datetime
from pathlib import Path

import numpy as np
import pystitch
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from patterns.plan import BlockKind
from patterns.records import Records, plan_records
from sesame_cad.errors import DesignFileError, InputError
from sesame_cad.files.stitch_formats import FORMATS, LOSSES, write_embroidery
from sesame_cad.pipeline import pattern
from sesame_cad.specification import load_specification
from sesame_cad.threads import threads_of

EXAMPLE = Path(__file__).parents[2] / "examples" / "large-array.toml"
COLOURED = ["pes", "jef", "vp3"]
READERS = {
    "exp": pystitch.ExpReader,
    "u01": pystitch.U01Reader,
    "pes": pystitch.PesReader,
    "jef": pystitch.JefReader,
    "vp3": pystitch.Vp3Reader,
}
STOPS = {pystitch.STOP, pystitch.COLOR_CHANGE}


@pytest.fixture(scope="module")
def sewn():
    """Records and threads of the large array, whose tail makes its size odd in 0.1 mm."""
    spec = load_specification(EXAMPLE)
    plan = pattern(spec).plan
    records = plan_records(plan, spec.patterns_machine())
    return records, threads_of(plan, spec.machine)


def read_by_library(data, kind):
    found = pystitch.EmbPattern()
    as_it_is = {"trims": False, "trim_distance": None, "clipping": False}
    READERS[kind].read(io.BytesIO(data), found, as_it_is)
    return found


def blocks_by_library(found):
    """Needle points of each block, y up."""
    blocks = [[]]
    for x, y, code in found.stitches:
        if code & 0xFF in STOPS:
            blocks.append([])
        elif code & 0xFF == pystitch.STITCH:
            blocks[-1].append((x, -y))
    return [np.array(block) for block in blocks]


def blocks_of(records):
    stops = np.cumsum(records.command == "stop")
    sewing = records.command == "stitch"
    return [records.xy[sewing & (stops == k)] for k in range(stops[-1] + 1)]


@pytest.mark.parametrize("kind", FORMATS)
def test_another_library_reads_every_needle_point_and_block(sewn, kind):
    """Nothing is lost of them, in no format: not in PES, not in VP3, whose centre is a half."""
    records, threads = sewn
    found = blocks_by_library(read_by_library(write_embroidery(records, kind, threads), kind))
    expected = blocks_of(records)
    assert len(found) == len(expected) == 4
    for one, other in zip(found, expected, strict=True):
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("kind", FORMATS)
def test_the_same_bytes_every_time_and_day(sewn, kind, monkeypatch):
    once = write_embroidery(sewn[0], kind, sewn[1])

    class Tomorrow(datetime):
        @classmethod
        def today(cls):
            return cls(2031, 2, 3)

    monkeypatch.setattr("pyembroidery.JefWriter.datetime.datetime", Tomorrow)
    assert write_embroidery(sewn[0], kind, sewn[1]) == once


def test_vp3_holds_the_colours_and_the_others_the_nearest_of_their_own(sewn):
    records, threads = sewn
    wanted = [thread.colour.lower() for thread in threads]
    for kind in COLOURED:
        found = read_by_library(write_embroidery(records, kind, threads), kind).threadlist
        colours = [thread.hex_color().lower() for thread in found]
        assert (colours == wanted) == (kind == "vp3")
        for colour, right in zip(colours, wanted, strict=True):
            assert max(abs(a - b) for a, b in zip(_rgb(colour), _rgb(right), strict=True)) < 60


def _rgb(colour):
    return bytes.fromhex(colour.removeprefix("#"))


def test_losses_that_are_told_are_those_that_are_seen(sewn):
    records, threads = sewn
    files = {kind: write_embroidery(records, kind, threads) for kind in FORMATS}
    found = {kind: read_by_library(data, kind) for kind, data in files.items()}
    jumps = {k: sum(c & 0xFF == pystitch.JUMP for *_, c in f.stitches) for k, f in found.items()}
    stops = {k: sum(c & 0xFF == pystitch.STOP for *_, c in f.stitches) for k, f in found.items()}
    assert jumps["exp"] == jumps["u01"] == jumps["jef"] == int(np.sum(records.command == "jump"))
    assert jumps["pes"] < jumps["jef"]
    assert jumps["vp3"] <= 4  # its reader begins each block with one
    for kind in COLOURED:
        assert stops[kind] == 0
        assert any("colour change" in loss for loss in LOSSES[kind])
    assert any("jump" in loss for loss in LOSSES["vp3"])
    assert any("hoop" in loss for loss in LOSSES["pes"])
    assert all(not found[kind].threadlist for kind in ("exp", "u01"))
    assert LOSSES["exp"] == LOSSES["u01"] == LOSSES["dst"]


def test_before_a_run_the_thread_is_trimmed(sewn):
    """Of the marks, which are four runs; the start needs none."""
    records, threads = sewn
    for kind in ("pes", "vp3"):
        stitches = read_by_library(write_embroidery(records, kind, threads), kind).stitches
        first = next(k for k, (*_, code) in enumerate(stitches) if code & 0xFF in STOPS)
        trims = sum(code & 0xFF == pystitch.TRIM for *_, code in stitches[:first])
        assert trims >= 3


def test_a_design_too_wide_for_pes_is_refused(sewn):
    reach = np.append(np.arange(0, 2080, 40), 2048)
    command = np.array(["stitch"] * (len(reach) - 1) + ["end"])
    records = Records(command, np.stack([reach, 0 * reach], axis=1))
    with pytest.raises(InputError, match=r"reaches 204\.8 mm from its start; PES has room"):
        write_embroidery(records, "pes", sewn[1][:1])


def whole_file(sewn, kind, made={}):  # noqa: B006 - each once
    if kind not in made:
        made[kind] = write_embroidery(sewn[0], kind, sewn[1])
    return made[kind]


@pytest.mark.parametrize("kind", COLOURED)
@settings(deadline=None, max_examples=100)
@given(at=st.integers(0, 16_000), byte=st.integers(0, 255), cut=st.booleans())
def test_a_spoiled_file_is_read_or_refused_in_one_line(sewn, kind, at, byte, cut):
    whole = bytearray(whole_file(sewn, kind))
    at %= len(whole)
    if cut:
        del whole[at:]
    else:
        whole[at] = byte
    with suppress(DesignFileError):
        FORMATS[kind].read(bytes(whole))


def test_threads_tell_blocks_apart(sewn):
    colours = [thread.colour for thread in sewn[1]]
    assert len(set(colours)) == len(colours)
    assert [thread.head for thread in sewn[1]] == ["thread", "wire", "thread", "wire"]
    assert BlockKind.COVER.value in sewn[1][2].material
