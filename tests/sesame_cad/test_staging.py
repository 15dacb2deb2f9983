"""Results appear complete or not at all, and nobody's files go."""

import json
from pathlib import Path

import pytest

from sesame_cad.errors import InputError
from sesame_cad.staging import staged_directory


class BrokenError(Exception):
    pass


def fill(folder, content="new"):
    (folder / "cut").mkdir()
    (folder / "cut" / "plate.svg").write_text(content)
    (folder / "design.json").write_text(json.dumps({"files": {"cut/plate.svg": {}}}))


def write(target, failure):
    with staged_directory(target) as folder:
        fill(folder)
        raise failure


def contents(folder):
    return {
        path.relative_to(folder).as_posix(): path.read_text()
        for path in folder.rglob("*")
        if path.is_file()
    }


@pytest.fixture
def target(tmp_path):
    return tmp_path / "work" / "array"


@pytest.fixture
def earlier(target):
    target.mkdir(parents=True)
    fill(target, "old")
    return target


def assert_nothing_beside(target):
    assert [path.name for path in target.parent.iterdir()] in ([], [target.name])


def test_a_result_appears_at_the_end(target):
    target.parent.mkdir()
    with staged_directory(target) as folder:
        fill(folder)
        assert not target.exists()
        assert folder.parent == target.parent
    assert contents(target)["cut/plate.svg"] == "new"
    assert_nothing_beside(target)


def test_others_may_read_a_result_as_they_may_any_directory(target):
    (target.parent / "plain").mkdir(parents=True)
    with staged_directory(target) as folder:
        fill(folder)
    assert target.stat().st_mode == (target.parent / "plain").stat().st_mode


def test_a_relative_target_works(tmp_path, monkeypatch):
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path)
    with staged_directory(Path("array")) as folder:
        fill(folder)
        monkeypatch.chdir(tmp_path / "elsewhere")
    assert contents(tmp_path / "array")["cut/plate.svg"] == "new"


def test_an_earlier_result_is_replaced_whole(earlier):
    with staged_directory(earlier) as folder:
        (folder / "design.json").write_text("{}")
    assert contents(earlier) == {"design.json": "{}"}
    assert_nothing_beside(earlier)


@pytest.mark.parametrize("failure", [BrokenError, KeyboardInterrupt, SystemExit])
def test_a_failure_leaves_the_earlier_result(earlier, failure):
    before = contents(earlier)
    with pytest.raises(failure):
        write(earlier, failure)
    assert contents(earlier) == before
    assert_nothing_beside(earlier)


def test_a_failure_leaves_nothing_where_nothing_was(target):
    target.parent.mkdir()
    with pytest.raises(BrokenError):
        write(target, BrokenError)
    assert list(target.parent.iterdir()) == []


def test_an_earlier_result_comes_back_when_the_new_one_cannot_take_its_place(earlier, monkeypatch):
    before, rename = contents(earlier), Path.rename

    def failing(path, to):
        if ".new." in path.name:
            raise OSError("disk gone")
        return rename(path, to)

    monkeypatch.setattr(Path, "rename", failing)
    with pytest.raises(OSError, match="disk gone"), staged_directory(earlier) as folder:
        fill(folder)
    assert contents(earlier) == before
    assert_nothing_beside(earlier)


def refused(target):
    with pytest.raises(InputError) as caught, staged_directory(target):
        pytest.fail("entered")
    assert len(caught.value.faults) == 1
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_an_empty_directory_is_taken(target):
    target.mkdir(parents=True)
    with staged_directory(target) as folder:
        fill(folder)
    assert contents(target)["cut/plate.svg"] == "new"


def test_somebody_elses_directory_stays(target):
    target.mkdir(parents=True)
    (target / "thesis.tex").write_text("x")
    assert "no design.json" in refused(target)
    assert contents(target) == {"thesis.tex": "x"}


@pytest.mark.parametrize("name", ["notes.txt", "cut/mine.svg", "deep/down/file"])
def test_files_that_a_result_does_not_list_stay(earlier, name):
    (earlier / name).parent.mkdir(parents=True, exist_ok=True)
    (earlier / name).write_text("mine")
    assert name in refused(earlier)
    assert contents(earlier)[name] == "mine"


def test_empty_directories_and_links_of_the_user_stay(earlier):
    (earlier / "link").symlink_to(earlier.parent)
    assert "link" in refused(earlier)
    (earlier / "link").unlink()
    (earlier / "mine").mkdir()
    assert "mine" in refused(earlier)


def test_files_that_appear_meanwhile_stay(earlier):
    writing = staged_directory(earlier)
    fill(writing.__enter__())
    (earlier / "notes.txt").write_text("mine")
    with pytest.raises(InputError, match=r"notes\.txt"):
        writing.__exit__(None, None, None)
    assert contents(earlier)["notes.txt"] == "mine"
    assert_nothing_beside(earlier)


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"files": 3}', "\xff"])
def test_a_design_file_of_another_kind_protects_its_directory(target, text):
    target.mkdir(parents=True)
    (target / "design.json").write_text(text, encoding="latin-1")
    refused(target)
    assert_nothing_beside(target)


def test_files_and_links_in_the_target_s_place_stay(target):
    target.parent.mkdir()
    target.write_text("x")
    assert "no directory" in refused(target)
    target.unlink()
    target.symlink_to(target.parent)
    assert "no directory" in refused(target)
    target.unlink()
    target.symlink_to(target.parent / "nowhere")
    assert "no directory" in refused(target)


def test_a_missing_parent_is_said(target):
    assert f"{target.parent} is no directory: make it" in refused(target)
    target.parent.write_text("x")
    assert f"{target.parent} is no directory: make it" in refused(target)


def test_a_parent_that_cannot_be_written_to_is_said(target, monkeypatch):
    target.parent.mkdir()

    def failing(**_):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("sesame_cad.staging.tempfile.mkdtemp", failing)
    assert "cannot write" in refused(target)


def test_directories_of_killed_runs_do_no_harm(earlier):
    stale = earlier.parent / ".array.new.abc"
    stale.mkdir()
    with staged_directory(earlier) as folder:
        fill(folder)
    assert contents(earlier)["cut/plate.svg"] == "new"
    assert stale.is_dir()
