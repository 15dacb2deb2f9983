"""What is wrong with a design on disk is found, even when its hashes are made to fit."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from patterns.plan import Block, BlockKind, StitchPlan
from patterns.records import Records, plan_from_records, plan_records
from sesame_cad.files.dst import decode_dst, write_dst
from sesame_cad.files.stl import read_stl, write_stl
from sesame_cad.package_files import file_data
from sesame_cad.specification import load_specification
from sesame_cad.verification import verify

EXAMPLE = Path(__file__).parents[2] / "examples" / "large-array.toml"
EXPECTED = tuple(
    Block(kind, "", (), stage)
    for kind, stage in (
        (BlockKind.MARKS, 0),
        (BlockKind.WIRE, 0),
        (BlockKind.COVER, 1),
        (BlockKind.WIRE, 1),
    )
)


@pytest.fixture
def copy(large_array, tmp_path):
    return shutil.copytree(large_array, tmp_path / "large-array")


def _replace(folder, path, content):
    """Write a file, and make its size and hash fit."""
    (folder / path).write_bytes(content)
    data = json.loads((folder / "design.json").read_text())
    data["files"][path] = file_data(content)
    (folder / "design.json").write_text(json.dumps(data))


def _tamper_stitches(folder, change):
    """Change the plan inside the stitch file."""
    path = "stitch/large-array.dst"
    records = decode_dst((folder / path).read_bytes()).records
    plan = plan_from_records(records, EXPECTED)
    changed = change(plan)
    if isinstance(changed, StitchPlan):
        machine = load_specification(EXAMPLE).patterns_machine()
        changed = plan_records(changed, machine)
    _replace(folder, path, write_dst(changed, "large-array"))


def _rules(folder):
    return " ".join(verify(folder))


def test_a_good_design_has_no_faults(large_array):
    assert verify(large_array) == ()


def test_the_command(large_array, copy, run_command, faults_of_command, tmp_path):
    assert run_command(["check", str(large_array)])[0] == 0
    (copy / "shape" / "hot.stl").unlink()
    code, out, _ = run_command(["check", str(copy)])
    assert code == 1
    assert out == "shape/hot.stl: missing\n"
    (fault,) = faults_of_command(["check", str(tmp_path / "nowhere")])
    assert "not a folder" in fault


def test_cover_block_removed(copy):
    _tamper_stitches(
        copy,
        lambda plan: StitchPlan(tuple(b for b in plan.blocks if b.kind is not BlockKind.COVER)),
    )
    assert "expected 4 blocks" in _rules(copy)


def test_cover_stitches_removed(copy):
    """The block stays, but one of its covers is gone."""

    def bare(plan):
        marks, first, cover, second = plan.blocks
        return StitchPlan((marks, first, type(cover)(cover.kind, "", cover.runs[1:]), second))

    _tamper_stitches(copy, bare)
    assert "insulation: short circuit" in _rules(copy)


def test_halves_swapped(copy):
    def swap(plan):
        marks, first, cover, second = plan.blocks
        return StitchPlan((marks, second, cover, first))

    _tamper_stitches(copy, swap)
    assert "wire-followed" in _rules(copy)


def test_one_needle_moved_onto_the_wire(copy):
    def move(plan):
        first = plan.blocks[1]
        needles = first.runs[0].needles
        middle = len(needles) // 2
        needles[middle] = (needles[middle - 1] + needles[middle + 1]) // 2
        across = needles[middle + 2] - needles[middle]
        needles[middle] += across // 2
        return plan

    _tamper_stitches(copy, move)
    faults = _rules(copy)
    assert "record" in faults
    assert "wire" in faults


def test_a_stop_too_many(copy):
    path = "stitch/large-array.dst"
    records = decode_dst((copy / path).read_bytes()).records
    middle = len(records.command) // 2
    command = np.insert(records.command, middle, "stop")
    xy = np.insert(records.xy, middle, records.xy[middle - 1], axis=0)
    _replace(copy, path, write_dst(Records(command, xy), "large-array"))
    assert "blocks" in _rules(copy)


@pytest.mark.parametrize("content", [b"", b"LA:", b"\x00" * 700, bytes(range(256)) * 9])
def test_a_stitch_file_that_is_none(copy, content):
    _replace(copy, "stitch/large-array.dst", content)
    (fault,) = verify(copy)
    assert fault.startswith("stitch/large-array.dst: ")
    assert "\n" not in fault


def test_any_changed_byte(copy):
    file = copy / "pictures" / "plan.png"
    file.write_bytes(file.read_bytes() + b" ")
    assert verify(copy) == (
        "pictures/plan.png: changed since it was written (its size or hash is another)",
    )


def test_a_file_of_someone_elses(copy):
    (copy / "notes.txt").write_text("mine")
    assert verify(copy) == ("notes.txt: not listed in design.json",)


def test_a_solid_with_a_hole(copy):
    solid = read_stl((copy / "shape" / "cold.stl").read_bytes())
    solid.update_faces(np.arange(len(solid.faces)) > 0)
    _replace(copy, "shape/cold.stl", write_stl(solid, "large-array cold"))
    assert "shape/cold.stl: not watertight" in verify(copy)


def test_a_solid_of_another_height(copy):
    solid = read_stl((copy / "shape" / "hot.stl").read_bytes())
    solid.apply_scale([1, 1, 1.01])
    _replace(copy, "shape/hot.stl", write_stl(solid, "large-array hot"))
    (fault,) = verify(copy)
    assert fault.startswith("shape/hot.stl: height")


@pytest.mark.parametrize("kind", ["svg", "dxf"])
def test_cut_lines_in_other_units(copy, kind):
    path = f"cut/large-array.{kind}"
    text = (copy / path).read_text()
    changed = (
        text.replace('mm"', 'in"')
        if kind == "svg"
        else text.replace("$INSUNITS\n 70\n4", "$INSUNITS\n 70\n1")
    )
    assert changed != text
    _replace(copy, path, changed.encode())
    assert any(fault.startswith(path) for fault in verify(copy))


def test_an_open_cut_line(copy):
    path = "cut/large-array.svg"
    text = (copy / path).read_text()
    changed = text.replace(' Z"', '"', 1)
    assert changed != text
    _replace(copy, path, changed.encode())
    assert any(fault.startswith(path) for fault in verify(copy))


@pytest.mark.parametrize(
    ("key", "value"),
    [("beta", 0.06), ("name", "other"), ("files", []), ("format", 99), ("specification", None)],
)
def test_numbers_that_do_not_follow(copy, key, value):
    file = copy / "design.json"
    data = json.loads(file.read_text())
    data[key] = value
    file.write_text(json.dumps(data))
    faults = verify(copy)
    assert faults
    assert all(fault.startswith("design.json") for fault in faults if key != "name")


@pytest.mark.parametrize("text", ["", "{", "[]", "null", '{"files": {}}', "[" * 100_000])
def test_a_design_file_that_is_none(copy, text):
    (copy / "design.json").write_text(text)
    (fault,) = verify(copy)
    assert fault.startswith("design.json: ")
