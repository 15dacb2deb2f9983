"""What several tests of the product need."""

import json
import sys
from pathlib import Path

import pytest

from sesame_cad.cli import main
from sesame_cad.errors import InputError
from sesame_cad.package import write_package
from sesame_cad.specification import load_specification


@pytest.fixture
def faults_of():
    """Load a specification that must not load, and give its faults; each must be one line."""

    def load(path, overrides=None):
        with pytest.raises(InputError) as caught:
            load_specification(path, overrides)
        assert all(len(fault.splitlines()) == 1 for fault in caught.value.faults)
        return caught.value.faults

    return load


@pytest.fixture
def run_command(monkeypatch, capsys):
    """Run the program in this process; gives exit code, stdout and stderr."""

    def run(arguments):
        monkeypatch.setattr(sys, "argv", ["sesame-cad", *arguments])
        with pytest.raises(SystemExit) as ended:
            main()
        said = capsys.readouterr()
        return ended.value.code, said.out, said.err

    return run


@pytest.fixture
def run_design(run_command):
    """Make a design, and give what `design.json` holds."""

    def run(arguments):
        code, out, err = run_command(["design", *arguments, "--json"])
        assert code == 0, err
        return json.loads(out)

    return run


@pytest.fixture
def faults_of_command(run_command):
    """Run a command that must refuse its input, and give its one-line faults."""

    def run(arguments):
        code, out, err = run_command(arguments)
        assert code == 2, err
        assert out == ""
        faults = err.splitlines()
        assert faults
        assert all(fault.startswith("error: ") for fault in faults)
        return faults

    return run


@pytest.fixture(scope="session")
def large_array(tmp_path_factory):
    """Folder of the paper's large array; not to be changed."""
    target = tmp_path_factory.mktemp("designs") / "large-array"
    spec = load_specification(Path(__file__).parents[2] / "examples" / "large-array.toml")
    write_package(spec, target, lambda _: None)
    return target
