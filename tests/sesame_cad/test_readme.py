"""The README tells the truth: its keys are the specification's, its commands run."""

import re
import shlex
from pathlib import Path

import pytest

from sesame_cad.specification.allowed import allowed_text
from sesame_cad.specification.specification import Specification, sections
from solver.compact import solve_loop
from solver.scene import LoopScene

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
KEYS = re.compile(r"(<!-- keys: .*? -->\n).*(<!-- end of keys -->)", re.DOTALL)


def _key_table():
    rows = ["| key | what it is | allowed | default |", "|---|---|---|---|"]
    for name, section in {"": Specification, **sections()}.items():
        for key, field in section.model_fields.items():
            if key in sections():
                continue
            path = f"{name}.{key}" if name else key
            default = "required" if field.is_required() else _default(field.default)
            if key == "name" and not name:
                default = "the file's name"
            rows.append(f"| `{path}` | {field.description} | {allowed_text(field)} | {default} |")
    return "\n".join(rows)


def _with_keys(text):
    return KEYS.sub(lambda found: f"{found[1]}\n{_key_table()}\n\n{found[2]}", text)


def _default(value):
    if value in {None, (), ""}:
        return "none"
    if isinstance(value, tuple):
        return ", ".join(value)
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:g}" if isinstance(value, float) else str(value)


def test_keys_are_those_of_the_specification():
    """To mend: python tests/sesame_cad/test_readme.py."""
    assert _with_keys(README) == README


def _commands():
    return [
        c for c in re.findall(r"`(sesame-cad [^`]+)`", README) if "NAME" not in c and "DIR" not in c
    ]


def test_there_are_commands():
    assert len(_commands()) >= 3


@pytest.mark.parametrize("command", _commands())
def test_commands_run(command, run_command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    name = "beam-sleeves" if command.split()[1] == "chain" else "large-array"
    spec = str(ROOT / "examples" / f"{name}.toml")
    arguments = [spec if word == "SPEC" else word for word in shlex.split(command)[1:]]
    code, _, err = run_command(arguments)
    assert code == 0, err


def test_pictures_are_there():
    for path in re.findall(r"!\[.*?\]\((.*?)\)", README):
        assert (ROOT / path).is_file()


def test_comparison_with_surface_evolver_is_what_the_solver_gives():
    rows = re.findall(r"^\| (0\.\d+), (0\.\d+) \| [\d.]+ \| ([\d.]+) \|$", README, re.MULTILINE)
    assert len(rows) == 4
    for strain, beta, height in rows:
        found = solve_loop(LoopScene(float(strain), float(beta), 0.3))
        assert found.shape.height_over_perimeter == pytest.approx(float(height), abs=1.5e-6)


if __name__ == "__main__":
    (ROOT / "README.md").write_text(_with_keys(README), encoding="utf-8")
