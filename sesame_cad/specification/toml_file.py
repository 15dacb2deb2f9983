"""Reading TOML that somebody wrote by hand."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

from sesame_cad.errors import InputError

LARGEST_FILE_BYTES = 1_000_000
"""Nobody writes a longer specification; something else was named by mistake."""

_BYTE_ORDER_MARKS = (b"\xef\xbb\xbf", b"\xff\xfe", b"\xfe\xff")
_PLACE = re.compile(r"(?P<problem>.*) \(at (?:line (?P<line>\d+), column (?P<column>\d+)|end .*)\)")


def read_toml(file: Path) -> dict[str, object]:
    """Read a TOML file.

    Raises
    ------
    InputError
        When it cannot be read or is no TOML; the message says where.
    """
    return _parsed(file.name, _text(file))


def _text(file: Path) -> str:
    try:
        with file.open("rb") as stream:
            data = stream.read(LARGEST_FILE_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(f"{file.name or file}: cannot be read: {reason}") from None
    if len(data) > LARGEST_FILE_BYTES:
        raise InputError(f"{file.name}: longer than 1 MB; not a specification")
    return _decoded(file.name, data)


def _decoded(name: str, data: bytes) -> str:
    if data.startswith(_BYTE_ORDER_MARKS):
        raise InputError(f"{name}: begins with a byte order mark; save it as plain UTF-8")
    try:
        text = data.decode()
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise InputError(f"{name}: line {line}: not text in UTF-8; save it as UTF-8") from None
    if "\0" in text:
        raise InputError(f"{name}: a binary file, not a specification in TOML")
    return text


def _parsed(name: str, text: str) -> dict[str, object]:
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise InputError(f"{name}: not TOML: nested too deeply") from None
    except ValueError as error:
        raise InputError(f"{name}: {_toml_problem(str(error), text)}") from None


def _toml_problem(message: str, text: str) -> str:
    found = _PLACE.fullmatch(message)
    if found is None:
        return f"not TOML: {message}"
    line, column = found["line"], found["column"]
    if line is None:
        lines = text.split("\n")
        line, column = len(lines), len(lines[-1]) + 1
    return f"line {line}, column {column}: not TOML: {found['problem']}"
