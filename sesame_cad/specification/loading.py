"""A specification from a file or from values, with every fault told at once."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from pydantic import ValidationError

from sesame_cad.errors import InputError
from sesame_cad.specification.diagnosis import diagnose
from sesame_cad.specification.fault import Fault
from sesame_cad.specification.profile import with_profile
from sesame_cad.specification.specification import Specification, sections
from sesame_cad.specification.toml_file import read_toml


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
    mapping = read_toml(file)
    return _specification(mapping, file.stem, file.name, overrides or {}, file.parent)


def specification_from(
    mapping: Mapping[str, object],
    name: str,
    source: str = "specification",
    overrides: Mapping[str, object] | None = None,
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
    overrides
        Values that replace others, by key with its section.

    Raises
    ------
    InputError
        With every fault on a line of its own.
    """
    return _specification(mapping, name, source, overrides or {}, Path())


def _specification(
    mapping: Mapping[str, object],
    name: str,
    source: str,
    overrides: Mapping[str, object],
    home: Path,
) -> Specification:
    data = {"name": name, **{section: {} for section in sections()}, **mapping}
    data = with_profile(_with_overrides(data, overrides), source, home)
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
        yield f"{'options' if '.'.join(fault.keys) in overrides else source}: {fault}"
