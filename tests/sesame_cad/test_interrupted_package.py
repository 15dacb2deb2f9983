"""Interrupts and full disks at any stage of a real package."""

import errno
import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from sesame_cad.package import write_package
from sesame_cad.specification import specification_from


def specification():
    layout = {"rows": 1, "columns": 2, "loop_diameter_mm": 25, "shape": "none"}
    output = {"formats": ["exp", "pes", "jef", "vp3"], "pictures": False}
    sections = {"wire": {"diameter_mm": 0.5}, "layout": layout, "output": output}
    return specification_from(sections, "array", "test")


def tree(folder):
    return {
        file.relative_to(folder).as_posix(): hashlib.sha256(file.read_bytes()).hexdigest()
        for file in folder.rglob("*")
        if file.is_file()
    }


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    target = tmp_path_factory.mktemp("designs") / "array"
    write_package(specification(), target, lambda _: None)
    return target


@pytest.fixture
def earlier(package, tmp_path):
    return shutil.copytree(package, tmp_path / "array")


def test_an_interrupt_at_any_stage(earlier):
    before, stages = tree(earlier), []
    write_package(specification(), earlier, stages.append)
    assert len(stages) >= 5
    for stage in stages:

        def interrupting(doing, stage=stage):
            if doing == stage:
                raise KeyboardInterrupt

        with pytest.raises(KeyboardInterrupt):
            write_package(specification(), earlier, interrupting)
        assert tree(earlier) == before
        assert [path.name for path in earlier.parent.iterdir()] == ["array"]


def test_a_full_disk_at_any_file(earlier, monkeypatch):
    before, write = tree(earlier), Path.write_bytes
    for full_at in range(len(before)):
        left = full_at

        def writing(path, content):
            nonlocal left
            left -= 1
            if left < 0:
                write(path, content[: len(content) // 2])
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            write(path, content)

        with monkeypatch.context() as patched:
            patched.setattr(Path, "write_bytes", writing)
            with pytest.raises(OSError, match="No space"):
                write_package(specification(), earlier, lambda _: None)
        assert tree(earlier) == before
        assert [path.name for path in earlier.parent.iterdir()] == ["array"]


@pytest.mark.skipif(os.name != "posix", reason="limits of POSIX")
def test_a_limit_of_the_system_is_told_in_one_line(earlier):
    """Files larger than 4 kB cannot be written: as on a full disk, in the middle of a file."""
    (earlier.parent / "array.toml").write_text(specification().to_toml())
    before = tree(earlier)
    program = (
        "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096));"
        "from sesame_cad.cli import main; main()"
    )
    run = subprocess.run(
        [sys.executable, "-c", program, "design", "array.toml", "-o", "array"],
        cwd=earlier.parent,
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 1
    assert run.stderr.count("\n") == 1
    assert "File too large" in run.stderr
    assert tree(earlier) == before
    assert sorted(path.name for path in earlier.parent.iterdir()) == ["array", "array.toml"]
