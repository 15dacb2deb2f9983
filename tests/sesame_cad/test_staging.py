"""Results appear complete or not at all, and nobody's files go."""

import errno
import json
import os
import sys
from pathlib import Path

import pytest

from sesame_cad import staging
from sesame_cad.errors import InputError
from sesame_cad.staging import replace_file, staged_directory


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


def interrupted_at(line, work):
    """Do some work, with an interrupt before a line of the module; whether it came so far."""
    left = line

    def trace(frame, event, _):
        nonlocal left
        if frame.f_code.co_filename != staging.__file__:
            return None
        if event == "line":
            left -= 1
            if left == 0:
                raise KeyboardInterrupt
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        work()
    except KeyboardInterrupt:
        return True
    finally:
        sys.settrace(before)
    return False


def staged(target):
    with staged_directory(target) as folder:
        fill(folder)


@pytest.mark.parametrize("line", range(1, 90, 2))
def test_an_interrupt_anywhere_leaves_the_old_or_the_new_result_whole(earlier, line):
    interrupted_at(line, lambda: staged(earlier))
    assert contents(earlier)["cut/plate.svg"] in {"old", "new"}
    assert contents(earlier).keys() == {"cut/plate.svg", "design.json"}


def test_an_interrupt_while_the_result_is_moved_leaves_it_in_its_place(earlier, monkeypatch):
    """In the moment in which the earlier result is aside and the new one not there yet."""
    rename = Path.rename

    def interrupting(path, to):
        moved = rename(path, to)
        if path == earlier:
            raise KeyboardInterrupt
        return moved

    monkeypatch.setattr(Path, "rename", interrupting)
    with pytest.raises(KeyboardInterrupt):
        staged(earlier)
    assert contents(earlier)["cut/plate.svg"] == "old"
    assert_nothing_beside(earlier)


def test_a_full_disk_at_any_file_leaves_the_earlier_result(earlier, monkeypatch):
    before, write = contents(earlier), Path.write_text
    for full_at in (1, 2):
        count = 0

        def writing(path, text, full_at=full_at):
            nonlocal count
            count += 1
            if count == full_at:
                write(path, text[:3])
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            write(path, text)

        with monkeypatch.context() as patched:
            patched.setattr(Path, "write_text", writing)
            with pytest.raises(OSError, match="No space"):
                staged(earlier)
        assert contents(earlier) == before
        assert_nothing_beside(earlier)


def test_a_file_takes_the_place_of_another_only_when_it_is_complete(tmp_path, monkeypatch):
    target = tmp_path / "faults.svg"
    replace_file(target, b"one")
    replace_file(target, b"two")
    assert target.read_bytes() == b"two"
    write = Path.write_bytes

    def full(path, content):
        write(path, content[:1])
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(OSError, match="No space"):
        replace_file(target, b"three")
    assert target.read_bytes() == b"two"
    assert [path.name for path in tmp_path.iterdir()] == ["faults.svg"]


def test_links_and_folders_are_not_replaced(tmp_path):
    (tmp_path / "folder").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "folder")
    for name in ("folder", "link"):
        with pytest.raises(InputError, match="is no file"):
            replace_file(tmp_path / name, b"x")
