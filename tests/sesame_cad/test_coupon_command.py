import hashlib
import json

import numpy as np
import pytest

from sesame_cad.files.dst import decode_dst


def tree(folder):
    return {
        file.relative_to(folder).as_posix(): hashlib.sha256(file.read_bytes()).hexdigest()
        for file in folder.rglob("*")
        if file.is_file()
    }


def test_a_coupon_is_a_folder_that_can_be_sewn(run_command, tmp_path):
    target = tmp_path / "it"
    options = ["--wire-diameter", "0.3mm", "--machine", "single-needle", "--format", "exp"]
    code, out, err = run_command(["coupon", *options, "-o", str(target)])
    assert code == 0, err
    assert "18 cells" in out
    data = json.loads((target / "design.json").read_text())
    found = tree(target)
    found.pop("design.json")
    assert {path: one["sha256"] for path, one in data["files"].items()} == found
    assert set(found) == {
        *(f"stitch/coupon.{kind}" for kind in ("dst", "exp", "blocks.csv")),
        "pictures/coupon.png",
    }
    records = decode_dst((target / "stitch" / "coupon.dst").read_bytes()).records
    assert (records.command == "stop").sum() == data["stitch"]["stops"] == 3
    widths = [c["width_mm"] for c in data["cells"] if c["row"] == "width"]
    assert widths == pytest.approx([1.25, 1.35, 1.45, 1.65, 1.85, 2.05])
    code, out, _ = run_command(["check", str(target)])
    assert (code, out) == (0, f"{target}: every file is as it should be\n")
    again = run_command(["coupon", *options, "-o", str(target)])
    assert again[0] == 0
    assert json.loads((target / "design.json").read_text()) == data


def spoil_number(folder):
    file = folder / "design.json"
    file.write_text(file.read_text().replace('"cells": [', '"cells": [{}, '))


def spoil_listing(folder):
    (folder / "more.txt").write_text("more")


def spoil_specification(folder):
    file = folder / "design.json"
    file.write_text(file.read_text().replace('"specification":', '"was":'))


def spoil_stitch(folder):
    """Move a stitch, in a file that is listed as it is."""
    file, listing = folder / "stitch" / "coupon.dst", folder / "design.json"
    content = bytearray(file.read_bytes())
    data = json.loads(listing.read_text())
    listed = data["files"]["stitch/coupon.dst"]
    records = decode_dst(bytes(content)).records
    step = np.diff(records.xy[:, 0], prepend=0)
    first = int(np.argmax((step == 0) & (records.command == "stitch")))
    content[512 + 3 * first] ^= 0x01  # one unit to the right,
    content[512 + 3 * (first + 1)] ^= 0x02  # and back
    file.write_bytes(content)
    listed["sha256"] = hashlib.sha256(content).hexdigest()
    listing.write_text(json.dumps(data))


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (lambda folder: (folder / "pictures" / "coupon.png").unlink(), "coupon.png: missing"),
        (
            lambda folder: (folder / "pictures" / "coupon.png").write_bytes(b"none"),
            "coupon.png: changed since it was written",
        ),
        (spoil_stitch, "stitch/coupon.dst: record"),
        (spoil_number, "design.json: cells"),
        (spoil_listing, "more.txt: not listed in design.json"),
        (spoil_specification, 'no "specification" in it'),
        (
            lambda folder: (folder / "stitch" / "coupon.dst").write_bytes(b"LA:"),
            "stitch/coupon.dst: 3 bytes are no DST file",
        ),
        (
            lambda folder: (folder / "stitch" / "coupon.blocks.csv").write_text("a,b"),
            "not the list of the plan's blocks",
        ),
    ],
)
def test_a_spoilt_coupon_is_found(run_command, tmp_path, spoil, said):
    target = tmp_path / "it"
    assert run_command(["coupon", "--wire-diameter", "0.3mm", "-o", str(target)])[0] == 0
    spoil(target)
    code, out, _ = run_command(["check", str(target)])
    assert code == 1
    assert said in out


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--wire-diameter", "0.3"], "has no unit"),
        (["--wire-diameter", "0.3mm", "--machine", "lathe"], "no profile of this name"),
        (["--wire-diameter", "0.3mm", "--format", "pdf"], "output.formats"),
        (["--wire-diameter", "2mm", "--machine", "single-needle"], "no room for a coupon"),
        ([], "--wire-diameter"),
    ],
)
def test_what_cannot_be_leaves_nothing_behind(
    options, said, faults_of_command, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    (fault,) = faults_of_command(["coupon", *options])
    assert said in fault
    assert list(tmp_path.iterdir()) == []
