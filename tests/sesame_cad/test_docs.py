"""The documentation tells the truth: its commands and programs run, its links and pictures are."""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
PAGES = sorted(DOCS.rglob("*.md"))
BLOCK = re.compile(r'^```(\w+)(?: title="([^"]+)")?\n(.*?)^```$', re.MULTILINE | re.DOTALL)
FETCHED = re.compile(r'(?:src|href)="(?:https?:)?//[^"]*\.(?:js|css|woff2?)"')
RUN = [page for page in PAGES if re.search("^```(sh|python)$", page.read_text(), re.MULTILINE)]


def _name(page):
    return page.relative_to(DOCS).as_posix()


@pytest.mark.parametrize("page", RUN, ids=_name)
def test_what_a_page_says_to_do_can_be_done(page, run_command, tmp_path, monkeypatch):
    """Blocks in their order, in one folder: files are written, commands and programs run."""
    monkeypatch.chdir(tmp_path)
    scope = {}
    for kind, title, text in BLOCK.findall(page.read_text(encoding="utf-8")):
        if title:
            Path(title).write_text(text, encoding="utf-8")
        elif kind == "python":
            exec(compile(text, _name(page), "exec"), scope)
        elif kind == "sh":
            for line in text.splitlines():
                program, *arguments = shlex.split(line)
                assert program == "sesame-cad"
                code, _, err = run_command(arguments)
                assert code == 0, f"{line}\n{err}"


def test_there_are_pages_that_run():
    assert {"tutorial.md", "python.md", "how-to/my-own-wire.md"} <= {_name(page) for page in RUN}


def _in_nav(entries):
    for entry in entries:
        for value in entry.values():
            yield from _in_nav(value) if isinstance(value, list) else [value]


def test_every_page_is_in_the_menu():
    menu = yaml.safe_load((ROOT / "mkdocs.yml").read_text(encoding="utf-8"))["nav"]
    assert sorted(_in_nav(menu)) == sorted(_name(page) for page in PAGES)


def test_the_site_builds_without_a_warning(tmp_path):
    """Strict: a broken link, a missing picture or an unknown name in the reference is an error."""
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "-d", str(tmp_path)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    reference = (tmp_path / "python" / "index.html").read_text(encoding="utf-8")
    assert "Rise of the wire" in reference  # what a docstring says
    for page in tmp_path.rglob("*.html"):
        fetched = FETCHED.findall(page.read_text(encoding="utf-8"))
        assert not fetched, f"{page.name} fetches from elsewhere"


def test_the_gallery_shows_every_example():
    page = (DOCS / "gallery.md").read_text(encoding="utf-8")
    for example in (ROOT / "examples").glob("*.toml"):
        assert f"`examples/{example.name}`" in page
        assert re.search(rf"pictures/gallery/{example.stem}-plan\S*\.png", page)


def test_the_gallery_is_drawn_by_its_script(tmp_path):
    command = [
        sys.executable,
        "-c",
        "import gallery, pathlib; gallery.draw(['small-array'], pathlib.Path('.'))",
    ]
    path = os.pathsep.join([str(DOCS), str(ROOT)])
    subprocess.run(command, cwd=tmp_path, check=True, env=os.environ | {"PYTHONPATH": path})
    assert {file.name for file in tmp_path.glob("*.png")} == {
        "small-array-plan.png",
        "small-array-shapes.png",
    }
