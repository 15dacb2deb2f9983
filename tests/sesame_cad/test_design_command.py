import hashlib
import json
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from sesame_cad.files.dst import decode_dst

EXAMPLES = Path(__file__).parents[2] / "examples"

PER_STATE = {
    "buckled",
    "height_mm",
    "height_over_perimeter",
    "pitch_mm",
    "energy_mJ",
    "status",
    "gradient_norm",
    "lowest_eigenvalue",
    "steps",
    "seconds",
    "omitted_terms",
}

SHAPES = ("stl", "3mf", "glb")


def _without_seconds(data):
    return {
        key: _without_seconds(value) if isinstance(value, dict) else value
        for key, value in data.items()
        if key != "seconds"
    }


def _tree(folder):
    return {
        file.relative_to(folder).as_posix(): hashlib.sha256(file.read_bytes()).hexdigest()
        for file in folder.rglob("*")
        if file.is_file()
    }


def test_large_array(large_array):
    data = json.loads((large_array / "design.json").read_text())
    assert data["name"] == "large-array"
    assert data["beta"] == pytest.approx(0.01454, abs=1e-5)
    assert data["scaling_mm"] == pytest.approx(5e-7)
    assert data["strain"] == 0.3
    assert data["poisson"] == 0.45
    assert data["reading"] == "plane-stress"
    assert data["cold"].keys() >= PER_STATE
    assert data["hot"].keys() >= PER_STATE
    assert data["cold"]["height_over_perimeter"] == pytest.approx(0.140, abs=5e-4)
    assert data["hot"]["height_mm"] < data["cold"]["height_mm"]
    assert data["hot"]["pitch_mm"] > data["cold"]["pitch_mm"]
    assert data["circuit"]["contacts"] == data["circuit"]["covered_contacts"] == 24
    assert data["circuit"]["closed"] is True
    assert data["stitch"]["stops"] == 3


def test_files_are_listed_with_size_and_hash(large_array):
    data = json.loads((large_array / "design.json").read_text())
    found = _tree(large_array)
    found.pop("design.json")
    assert {path: entry["sha256"] for path, entry in data["files"].items()} == found
    assert set(found) == {
        "plan/large-array.svg",
        "stitch/large-array.blocks.csv",
        "worksheet/large-array.pdf",
        "stitch/large-array.dst",
        "cut/large-array.svg",
        "cut/large-array.dxf",
        *(f"shape/{name}.{kind}" for name in ("flat", "cold", "hot") for kind in SHAPES),
        "shape/cold.vtu",
        "shape/hot.vtu",
        "pictures/plan.png",
        "pictures/shapes.png",
    }


def test_wire_length_is_all_circles_and_both_tails(large_array):
    data = json.loads((large_array / "design.json").read_text())
    expected = 16 * 3.141592653589793 * 50 + 2 * 40
    assert data["circuit"]["wire_length_mm"] == pytest.approx(expected)
    # 80 uohm cm, 0.5 mm
    assert data["circuit"]["resistance_ohm_cold"] == pytest.approx(10.57, abs=0.01)


def test_numbers_of_the_stitch_file_are_those_of_the_file(large_array):
    data = json.loads((large_array / "design.json").read_text())["stitch"]
    records = decode_dst((large_array / "stitch" / "large-array.dst").read_bytes()).records
    assert data["stitches"] == (records.command == "stitch").sum()
    assert data["stops"] == (records.command == "stop").sum()
    points = records.xy[records.command == "stitch"] / 10
    assert data["extent_mm"] == pytest.approx(list(points.max(axis=0) - points.min(axis=0)))


def test_reproducible_byte_for_byte(large_array, run_design, tmp_path):
    again = run_design([str(EXAMPLES / "large-array.toml"), "-o", str(tmp_path / "again")])
    one, other = _tree(large_array), _tree(tmp_path / "again")
    one.pop("design.json")
    other.pop("design.json")
    assert one == other
    before = json.loads((large_array / "design.json").read_text())
    assert _without_seconds(again) == _without_seconds(before)


def test_without_a_file_from_options_with_units(run_design, tmp_path):
    data = run_design(
        [
            *("--rows", "3", "--columns", "4", "--loop-diameter", "40mm"),
            *("--wire-diameter", "0.4mm", "-o", str(tmp_path / "it")),
        ]
    )
    assert data["name"] == "grid-3x4"
    assert data["circuit"]["contacts"] == 17
    assert data["scaling_mm"] == pytest.approx(0.4**4 / 40**3)
    assert (tmp_path / "it" / "stitch" / "grid-3x4.dst").is_file()


def test_options_replace_keys_of_the_file(run_design, tmp_path):
    spec = EXAMPLES / "large-array.toml"
    options = ["--poisson", "0.3", "--rows", "1", "--columns", "1", "--format", "exp"]
    data = run_design([str(spec), *options, "-o", str(tmp_path / "one")])
    assert data["cold"]["height_over_perimeter"] == pytest.approx(0.1312, abs=5e-4)
    assert data["circuit"]["contacts"] == 0
    assert (tmp_path / "one" / "stitch" / "large-array.exp").is_file()


def test_flat_when_hot_below_the_threshold(run_design, tmp_path):
    spec = EXAMPLES / "large-array.toml"
    options = ["--prestrain", "15%", "--rows", "1", "--columns", "2"]
    data = run_design([str(spec), *options, "-o", str(tmp_path / "weak")])
    assert data["cold"]["buckled"]
    assert not data["hot"]["buckled"]
    assert data["hot"]["height_mm"] == 0


@pytest.mark.parametrize(
    ("options", "named"),
    [
        (["--rows", "3"], "layout.columns"),
        (["--loop-diameter", "40"], "--loop-diameter: '40' has no unit"),
        (["--loop-diameter", "40 km/h"], "--loop-diameter"),
        (["--rows", "0"], "layout.rows = 0"),
        (["--margin", "30mm"], "margin"),
    ],
)
def test_bad_options_leave_nothing_behind(options, named, faults_of_command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    spec = [] if options == ["--rows", "3"] else [str(EXAMPLES / "large-array.toml")]
    faults = faults_of_command(["design", *spec, *options])
    assert any(named in fault for fault in faults)
    assert list(tmp_path.iterdir()) == []


def test_no_input_at_all(faults_of_command):
    (fault,) = faults_of_command(["design"])
    assert "sesame-cad new" in fault


def test_a_folder_that_is_not_a_design_is_left_alone(faults_of_command, tmp_path):
    (tmp_path / "letters.txt").write_text("dear")
    (fault,) = faults_of_command(
        ["design", str(EXAMPLES / "large-array.toml"), "-o", str(tmp_path)]
    )
    assert str(tmp_path) in fault or tmp_path.name in fault
    assert [file.name for file in tmp_path.iterdir()] == ["letters.txt"]


def test_a_failed_run_leaves_the_earlier_result(large_array, faults_of_command, tmp_path):
    target = tmp_path / "result"
    shutil.copytree(large_array, target)
    before = _tree(target)
    faults_of_command(
        ["design", str(EXAMPLES / "large-array.toml"), "--margin", "30mm", "-o", str(target)]
    )
    assert _tree(target) == before
    assert [entry.name for entry in tmp_path.iterdir()] == ["result"]


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_an_interrupted_run_leaves_the_earlier_result(large_array, tmp_path):
    target = tmp_path / "result"
    shutil.copytree(large_array, target)
    before = _tree(target)
    arguments = ["design", str(EXAMPLES / "large-array.toml"), "-o", str(target)]
    program = "from sesame_cad.cli import main; main()"
    run = subprocess.Popen([sys.executable, "-c", program, *arguments], stderr=subprocess.PIPE)
    while run.poll() is None and len(list(tmp_path.iterdir())) == 1:
        pass  # until the folder beside the target is there
    run.send_signal(signal.SIGINT)
    _, said = run.communicate(timeout=60)
    assert run.returncode == 130
    assert b"interrupted" in said
    assert b"Traceback" not in said
    assert _tree(target) == before
    assert [entry.name for entry in tmp_path.iterdir()] == ["result"]
