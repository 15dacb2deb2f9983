"""Results appear complete or not at all."""

from __future__ import annotations

import json
import os
import shutil
import tempfile
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import cast

from sesame_cad.errors import InputError

DESIGN_FILE = "design.json"
"""Marks a directory as a design; its "files" lists the others by their relative paths."""


@contextmanager
def staged_directory(target: Path, listing: str = DESIGN_FILE) -> Generator[Path]:
    """Write into a new directory that takes the target's place once everything is written.

    On any exception the target stays as it was. An earlier result is replaced; anything else in
    the target's place is the user's and stays.

    Parameters
    ----------
    target : Path
        Where the result goes. Its parent must exist.
    listing : str
        Name of the file that marks a result of this kind.

    Yields
    ------
    Path
        An empty directory beside the target.

    Raises
    ------
    InputError
        When the target must not be replaced or its parent cannot be written to.
    """
    target = target.absolute()
    _check_replaceable(target, listing)
    staging = _sibling(target, "new")
    try:
        yield staging
        _check_replaceable(target, listing)
        # mkdtemp's directories are their owner's alone; results are as readable as others' are.
        staging.chmod(0o777 & ~_umask())
        _move_into_place(staging, target)
    finally:
        shutil.rmtree(staging, ignore_errors=True)


def write_new_file(target: Path, content: bytes) -> None:
    """Write a file that appears once it is complete, where there was none.

    Raises
    ------
    InputError
        When the target exists or its parent cannot be written to.
    """
    target = target.absolute()
    _check_free(target)
    staging = _sibling(target, "new")
    try:
        aside = staging / target.name
        aside.write_bytes(content)
        _check_free(target)
        aside.rename(target)
    finally:
        shutil.rmtree(staging, ignore_errors=True)


def replace_file(target: Path, content: bytes) -> None:
    """Write a file that takes the place of an earlier one once it is complete.

    Raises
    ------
    InputError
        When something other than a file is in its place or its parent cannot be written to.
    """
    target = target.absolute()
    _check_parent(target)
    if os.path.lexists(target) and not (target.is_file() and not target.is_symlink()):
        raise InputError(f"{target} is no file: it stays as it is; choose another name")
    staging = _sibling(target, "new")
    try:
        aside = staging / target.name
        aside.write_bytes(content)
        aside.replace(target)
    finally:
        shutil.rmtree(staging, ignore_errors=True)


def _move_into_place(staging: Path, target: Path) -> None:
    if not target.exists():
        staging.rename(target)
        return
    aside = _sibling(target, "old")
    # The new name must be free of its empty directory on systems that do not replace one.
    aside.rmdir()
    try:
        target.rename(aside)
        staging.rename(target)
    finally:
        # An interrupt may come between any two lines.
        if not target.exists():
            aside.rename(target)
        shutil.rmtree(aside, ignore_errors=True)


def _sibling(target: Path, purpose: str) -> Path:
    try:
        return Path(tempfile.mkdtemp(prefix=f".{target.name}.{purpose}.", dir=target.parent))
    except OSError as error:
        raise InputError(f"cannot write in {target.parent}: {error.strerror}") from error


def _check_free(target: Path) -> None:
    _check_parent(target)
    if os.path.lexists(target):
        raise InputError(f"{target} exists already, and is left as it is; choose another name")


def _check_parent(target: Path) -> None:
    if not target.parent.is_dir():
        raise InputError(f"{target.parent} is no directory: make it, or choose another place")


def _check_replaceable(target: Path, listing: str) -> None:
    _check_parent(target)
    if not os.path.lexists(target):
        return
    if target.is_symlink() or not target.is_dir():
        raise InputError(f"{target} is no directory: it stays as it is; choose another place")
    if not any(target.iterdir()):
        return
    if not (target / listing).is_file():
        raise InputError(f"{target} holds files but no {listing}, so it is no earlier result")
    foreign = sorted(_held(target) - _listed(target, listing))
    if foreign:
        raise InputError(
            f"{target} holds {foreign[0]}, which its {listing} does not list: move it away"
        )


def _held(target: Path) -> set[str]:
    """Files, and links, and directories without either."""
    paths = list(target.rglob("*"))
    return {
        path.relative_to(target).as_posix()
        for path in paths
        if path.is_symlink() or not path.is_dir() or not any(path.iterdir())
    }


def _listed(target: Path, listing: str) -> set[str]:
    try:
        design: object = json.loads((target / listing).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InputError(f"{target / listing} cannot be read: {error}") from error
    files = cast("dict[str, object]", design).get("files") if isinstance(design, dict) else None
    if not isinstance(files, dict):
        raise InputError(f'{target / listing} has no "files": {target} is no earlier result')
    return {listing, *(str(name) for name in cast("dict[object, object]", files))}


def _umask() -> int:
    """Ask for the mask; the system tells it only in exchange for another."""
    mask = os.umask(0o077)
    os.umask(mask)
    return mask
