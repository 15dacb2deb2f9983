import json
import os
import subprocess
import sys

import pytest

from sesame_cad.cli import COMMANDS


def test_help_names_every_command(run_command):
    code, out, _ = run_command(["--help"])
    assert code == 0
    assert all(name in out for name in COMMANDS)


def test_help_loads_nothing_heavy():
    program = (
        "import sys\n"
        "sys.argv = ['sesame-cad', '--help']\n"
        "from sesame_cad.cli import main\n"
        "try:\n    main()\nexcept SystemExit:\n    pass\n"
        "heavy = {'numpy', 'scipy', 'shapely', 'trimesh', 'matplotlib', 'pydantic', 'networkx'}\n"
        "print(sorted(heavy & set(sys.modules)), file=sys.stderr)\n"
    )
    run = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert run.stderr.strip() == "[]"


@pytest.mark.parametrize("name", list(COMMANDS))
def test_every_command_explains_itself(name, run_command):
    code, out, _ = run_command([name, "--help"])
    assert code == 0
    assert out.startswith("Usage: sesame-cad " + name)


def test_unknown_command_is_told_the_nearest(faults_of_command):
    assert faults_of_command(["desing"]) == ["error: no command 'desing'; did you mean design?"]


def test_unknown_option(faults_of_command):
    (fault,) = faults_of_command(["design", "--row", "3"])
    assert "--row" in fault


def test_schema_describes_every_key(run_command):
    code, out, _ = run_command(["schema"])
    assert code == 0
    schema = json.loads(out)
    assert {"fabric", "wire", "layout", "stitching", "machine", "output"} <= set(
        schema["properties"]
    )
    assert all(
        "description" in key
        for section in schema["$defs"].values()
        for key in section["properties"].values()
    )


def test_new_writes_what_design_reads(run_command, faults_of_command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, _ = run_command(["new", "glove"])
    assert code == 0
    assert "glove.toml" in out
    text = (tmp_path / "glove.toml").read_text()
    (fault,) = faults_of_command(["new", "glove"])
    assert "exists already" in fault
    assert (tmp_path / "glove.toml").read_text() == text
    code, _, err = run_command(["design", "glove.toml", "--rows", "1", "--columns", "1", "-q"])
    assert code == 0, err
    assert (tmp_path / "glove" / "design.json").is_file()


def test_new_refuses_a_name_that_is_none(faults_of_command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (fault,) = faults_of_command(["new", "../outside"])
    assert "name" in fault
    assert list(tmp_path.iterdir()) == []


def test_a_full_disk_is_one_line(run_command, monkeypatch, tmp_path):
    def full(*_):
        raise OSError(28, "No space left on device", "cold.stl")

    monkeypatch.setattr("sesame_cad.package_files.file_data", full)
    code, _, err = run_command(
        [
            *("design", "--rows", "1", "--columns", "1", "--loop-diameter", "40mm"),
            *("--wire-diameter", "0.4mm", "-o", str(tmp_path / "it")),
        ]
    )
    assert code == 1
    assert err == "error: cold.stl: No space left on device\n"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(os.name != "posix", reason="pipes of POSIX")
def test_no_colour_in_a_pipe(run_command):
    _, out, _ = run_command(["solve", "--strain", "0.3", "--beta", "0.0145", "--poisson", "0.3"])
    assert "\x1b" not in out
