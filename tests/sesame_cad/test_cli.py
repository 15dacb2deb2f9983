import json
import os
import shutil
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


SPEC = """[wire]
diameter_mm = 0.3
[layout]
rows = 1
columns = 1
loop_diameter_mm = 25
"""


@pytest.fixture
def spec(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    file = tmp_path / "it.toml"
    file.write_text(SPEC)
    return file.name


@pytest.mark.parametrize(
    ("arguments", "fault"),
    [
        (
            ["force", "it.toml", "--gap", "9mm", "--axis", "hight"],
            "--axis: 'hight' must be one of lateral, across, height; did you mean height?",
        ),
        (["force", "it.toml", "--gap", "9mm", "-q"], "--quiet: nothing would come of it; say"),
        (["fit", "--answers", "0"], "--answers: '0' must be a whole number from 1 to 50"),
        (["sweep", "--tolerance", "1"], "--tolerance: '1.0' must be a number from 1e-06 to 0.1"),
        (["sweep", "--beta", "0.1:x"], "--beta: '0.1:x' is no range"),
        (
            ["sweep", "it.toml", "--set", "fabric.prestrain=0.1:x"],
            "--set fabric.prestrain: '0.1:x' is no range",
        ),
        (["design", "it.toml", "--rows", "two"], "--rows: 'two' must be a whole number"),
        (["solve", "--strain", "x"], "--strain: 'x' must be a number"),
        (["scale", "--like", "it.toml"], "--wire-diameter: missing (The other wire's diameter"),
        (["actuate"], "SPEC: missing; write sesame-cad actuate [OPTIONS] SPEC"),
        (["machines", "single-needle", "--json"], "--json: lists the profiles"),
        (
            ["design", "it.toml", "--format", "dts"],
            'options: output.formats = ["dts"]: must be a list, each item one of "dst", "exp", '
            '"u01", "pes", "jef", "vp3"; did you mean dst?',
        ),
    ],
)
def test_a_mistake_is_one_line_with_what_is_allowed(arguments, fault, spec, faults_of_command):
    (told,) = faults_of_command(arguments)
    assert told.startswith(f"error: {fault}")


def test_a_word_that_is_misspelt_in_a_file_is_told_the_nearest(spec, faults_of_command, tmp_path):
    (tmp_path / spec).write_text(SPEC + 'kind = "hexagnal"\n')
    (told,) = faults_of_command(["design", spec])
    assert told.startswith('error: it.toml: layout.kind = "hexagnal": must be one of "grid", ')
    assert told.endswith("; did you mean hexagonal?")


@pytest.mark.parametrize(
    "arguments",
    [
        ["new", "other"],
        ["export-evolver", "it.toml"],
        ["coupon", "--wire-diameter", "0.3mm"],
        ["force", "it.toml", "--gap", "15mm", "-o", "force"],
    ],
    ids=lambda arguments: arguments[0],
)
def test_quiet_says_nothing(arguments, spec, run_command, tmp_path):
    before = set(tmp_path.iterdir())
    assert run_command([*arguments, "--quiet"]) == (0, "", "")
    assert set(tmp_path.iterdir()) > before


@pytest.mark.parametrize(
    "arguments",
    [
        ["machines"],
        ["schema"],
        ["coupon", "--wire-diameter", "0.3mm"],
        ["scale", "--like", "it.toml", "--wire-diameter", "0.5mm"],
        ["solve", "--strain", "0.3", "--beta", "0.0145", "--poisson", "0.3"],
    ],
    ids=lambda arguments: arguments[0],
)
def test_json_is_all_that_is_printed(arguments, spec, run_command):
    asked = [] if arguments == ["schema"] else ["--json"]
    code, out, err = run_command([*arguments, *asked])
    assert (code, err) == (0, "")
    assert json.loads(out)


def test_check_tells_its_faults_as_json(run_command, large_array, tmp_path):
    code, out, _ = run_command(["check", str(large_array), "--json"])
    assert (code, json.loads(out)) == (0, {"faults": []})
    folder = tmp_path / "broken"
    shutil.copytree(large_array, folder)
    (folder / "shape" / "cold.stl").unlink()
    code, out, _ = run_command(["check", str(folder), "--json"])
    assert code == 1
    assert any("shape/cold.stl" in fault for fault in json.loads(out)["faults"])


def completed(words):
    """What the shell is offered after these words, the last of which is being typed."""
    asked = {
        "_SESAME_CAD_COMPLETE": "bash_complete",
        "COMP_WORDS": " ".join(["sesame-cad", *words]),
        "COMP_CWORD": str(len(words)),
    }
    run = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | asked,
    )
    return [line.partition(",")[2] for line in run.stdout.splitlines()]


PROGRAM = "import sys; sys.argv = ['sesame-cad']; from sesame_cad.cli import main; main()"


def test_the_shell_completes_commands_options_and_choices():
    assert completed(["des"]) == ["design"]
    assert completed(["force", "it.toml", "--ax"]) == ["--axis"]
    assert completed(["force", "it.toml", "--axis", "h"]) == ["height"]
    assert set(completed([""])) == set(COMMANDS)


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_the_shell_is_given_its_completion(shell):
    asked = {"_SESAME_CAD_COMPLETE": f"{shell}_source"}
    run = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | asked,
    )
    assert "_SESAME_CAD_COMPLETE" in run.stdout


@pytest.mark.skipif(os.name != "posix", reason="terminals of POSIX")
def test_a_person_at_a_terminal_sees_what_is_done_and_a_pipe_does_not():
    """A terminal for both, then a pipe for what is printed: rich draws in the first only."""
    arguments = ["solve", "--strain", "0.3", "--beta", "0.0145", "--poisson", "0.3"]
    program = PROGRAM.replace("['sesame-cad']", repr(["sesame-cad", *arguments]))
    above, below = os.openpty()
    asked = {"TERM": "xterm-256color"}
    command = [sys.executable, "-c", program]
    run = subprocess.run(
        command,
        stdout=subprocess.PIPE,
        stderr=below,
        text=True,
        check=False,
        env=os.environ | asked,
    )
    os.close(below)
    seen = os.read(above, 1 << 16).decode()
    os.close(above)
    assert "solving" in seen
    assert "height / perimeter" in run.stdout
    assert "\x1b" not in run.stdout
