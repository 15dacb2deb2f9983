"""A specification from a file or from values, with every fault told at once."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path

from pydantic import ValidationError

from sesame_cad.errors import InputError
from sesame_cad.specification.diagnosis import diagnose
from sesame_cad.specification.fault import Fault
from sesame_cad.specification.specification import Specification, sections

LARGEST_FILE_BYTES = 1_000_000
"""Nobody writes a longer specification; something else was named by mistake."""

_BYTE_ORDER_MARKS = (b"\xef\xbb\xbf", b"\xff\xfe", b"\xfe\xff")
_PLACE = re.compile(r"(?P<problem>.*) \(at (?:line (?P<line>\d+), column (?P<column>\d+)|end .*)\)")


def load_specification(
    path: str | Path, overrides: Mapping[str, object] | None = None
) -> Specification:
    """Read a specification from a TOML file.

    Parameters
    ----------
    path
        The file; without a key ``name`` the design is called after it.
    overrides
        Values that replace the file's, by key with its section: ``{"fabric.prestrain": 0.2}``.

    Raises
    ------
    InputError
        With every fault of the file on a line of its own.
    """
    file = Path(path)
    mapping = _parsed(file.name, _text(file))
    return _specification(mapping, file.stem, file.name, overrides or {})


def specification_from(
    mapping: Mapping[str, object], name: str, source: str = "specification"
) -> Specification:
    """Make a specification from sections of keys.

    Parameters
    ----------
    mapping
        As a TOML parser gives it.
    name
        The design's name when the mapping has no key ``name``.
    source
        Where the values come from; every fault begins with it.

    Raises
    ------
    InputError
        With every fault on a line of its own.
    """
    return _specification(mapping, name, source, {})


def _specification(
    mapping: Mapping[str, object], name: str, source: str, overrides: Mapping[str, object]
) -> Specification:
    data = {"name": name, **{section: {} for section in sections()}, **mapping}
    data = _with_overrides(data, overrides)
    try:
        return Specification.model_validate(data)
    except ValidationError as error:
        raise InputError(*_lines(diagnose(data, error), source, overrides)) from None


def _with_overrides(
    data: Mapping[str, object], overrides: Mapping[str, object]
) -> dict[str, object]:
    result = dict(data)
    for keys, value in overrides.items():
        section, _, key = keys.partition(".")
        table = result.get(section, {})
        if not key:
            result[section] = value
        elif isinstance(table, Mapping):  # otherwise the section itself is reported
            result[section] = {**table, key: value}
    return result


def _lines(faults: Iterable[Fault], source: str, overrides: Mapping[str, object]) -> Iterable[str]:
    for fault in faults:
        yield f"{'override' if '.'.join(fault.keys) in overrides else source}: {fault}"


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
