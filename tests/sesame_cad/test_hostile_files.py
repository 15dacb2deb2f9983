"""Truncated, random, spoiled and hostile stitch files: clear lines from ``check``, never more."""

import json
import tracemalloc

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from patterns.plan import UNITS_PER_MM
from patterns.records import LARGEST_STEP, Records
from sesame_cad import verification
from sesame_cad.errors import DesignFileError
from sesame_cad.files.dst import HEADER_BYTES, MOST_RECORDS, decode_dst, write_dst
from sesame_cad.package import write_package
from sesame_cad.package_files import file_data
from sesame_cad.pipeline import design
from sesame_cad.specification import specification_from
from sesame_cad.verification import verified

PATH = "stitch/loop.dst"
SPOILED = settings(deadline=None, max_examples=12, phases=[Phase.explicit, Phase.generate])


@pytest.fixture(scope="module")
def loop(tmp_path_factory):
    """A package of one loop, and the bytes of its DST file."""
    target = tmp_path_factory.mktemp("designs") / "loop"
    layout = {"rows": 1, "columns": 1, "loop_diameter_mm": 25, "shape": "none"}
    output = {"pictures": False}
    sections = {"wire": {"diameter_mm": 0.5}, "layout": layout, "output": output}
    spec = specification_from(sections, "loop", "test")
    write_package(spec, target, lambda _: None)
    again = design(spec)
    with pytest.MonkeyPatch.context() as patched:
        # The design follows from design.json, which is the same every time.
        patched.setattr(verification, "design", lambda _: again)
        # The other checks do not look at stitch files.
        looking = verification._check_files, verification.sewn_faults
        patched.setattr(verification, "CHECKS", looking)
        yield target, (target / PATH).read_bytes()


def faults_with(loop, content):
    """Lines of ``check`` on the stitch file; size and hash fit, so that it must be looked into."""
    folder, whole = loop
    (folder / PATH).write_bytes(content)
    file = folder / "design.json"
    said = file.read_text()
    data = json.loads(said)
    data["files"][PATH] = file_data(content)
    file.write_text(json.dumps(data))
    try:
        faults = verified(folder).faults
    finally:
        (folder / PATH).write_bytes(whole)
        file.write_text(said)
    said_of_it = (PATH, "... and ")
    assert all(fault.startswith(said_of_it) and len(fault.splitlines()) == 1 for fault in faults)
    return faults


def test_the_good_file_has_no_faults(loop):
    assert faults_with(loop, loop[1]) == ()


@SPOILED
@given(st.data())
def test_a_truncated_file(loop, data):
    length = data.draw(st.integers(0, len(loop[1]) - 1))
    (fault,) = faults_with(loop, loop[1][:length])
    assert "DST" in fault


@SPOILED
@given(st.binary(max_size=3000), st.booleans())
def test_random_bytes(loop, data, headed):
    assert faults_with(loop, loop[1][:HEADER_BYTES] + data if headed else data)


@SPOILED
@given(st.data())
def test_a_flipped_bit(loop, data):
    spoiled = bytearray(loop[1])
    at = data.draw(st.integers(0, len(spoiled) - 1))
    spoiled[at] ^= 1 << data.draw(st.integers(0, 7))
    faults = faults_with(loop, bytes(spoiled))
    assert faults or at < HEADER_BYTES  # the label may be another, and what nobody reads


@SPOILED
@given(st.data())
def test_stitches_anywhere_are_held_against_the_rules(loop, data):
    """Files that are sound in themselves, with as many stops as the plan."""
    commands = decode_dst(loop[1]).records.command
    steps = st.tuples(*[st.integers(-LARGEST_STEP, LARGEST_STEP)] * 2)
    drawn = data.draw(st.lists(steps, min_size=3, max_size=30))
    moved = np.array([drawn[k % len(drawn)] for k in range(len(commands))], dtype=np.int64)
    moved[np.isin(commands, ["stop", "end"])] = 0
    content = write_dst(Records(commands, np.cumsum(moved, axis=0)), "loop")
    assert faults_with(loop, content)


@pytest.mark.parametrize("step", [(0, 0), (121, 121), (1, 0)])
def test_twenty_thousand_stitches_of_one_kind(loop, step):
    """Far out of the hoop, or all in one hole."""
    commands = decode_dst(loop[1]).records.command
    middle = int(np.flatnonzero(commands == "stitch")[40])
    command = np.insert(commands, middle, ["stitch"] * 20_000)
    moved = np.tile(step, (len(command), 1))
    moved[np.isin(command, ["stop", "end"])] = 0
    xy = np.cumsum(moved, axis=0)
    if xy.max() > 99_999:
        xy = xy * 99_999 // xy.max()
    faults = faults_with(loop, write_dst(Records(command, xy), "loop"))
    assert 0 < len(faults) < 200
    assert xy.max() / UNITS_PER_MM < 10_000


def test_more_records_than_dst_can_count_are_not_looked_at():
    size = HEADER_BYTES + 3 * (MOST_RECORDS + 2)
    with pytest.raises(DesignFileError, match="counts to 9999999 records"):
        decode_dst(bytes(size))


def test_a_long_file_is_decoded_in_little_memory():
    count = 300_000
    xy = np.zeros((count + 1, 2), dtype=np.int64)
    data = write_dst(Records(np.array(["stitch"] * count + ["end"]), xy), "long")
    tracemalloc.start()
    decode_dst(data)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert most < 120 * count


def test_a_huge_file_is_not_read(loop, monkeypatch):
    monkeypatch.setattr("sesame_cad.reading.MOST_BYTES", len(loop[1]) + 10)
    (fault,) = (f for f in verified(loop[0]).faults if f.startswith("worksheet"))
    assert "more than" in fault
