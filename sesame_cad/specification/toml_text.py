"""Values as TOML writes them: for specifications that are written out, and for messages."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

_BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")


LONGEST_DECIMAL_BITS = 1000


def number_text(number: float) -> str:
    """Write a number as a person would: whole ones without a decimal point, and one zero only."""
    return repr(number + 0.0).removesuffix(".0")


def toml_key(key: str) -> str:
    """Write one part of a key, quoted where TOML wants it so."""
    return key if _BARE_KEY.fullmatch(key) else _quoted(key)


def toml_value(value: object) -> str:
    """Write a value on one line.

    Everything that a TOML file can hold comes out as TOML; anything else as Python shows it.
    """
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, Mapping):
        return _inline_table(value)  # pyright: ignore[reportUnknownArgumentType]
    if isinstance(value, (list, tuple)):
        return _array(value)  # pyright: ignore[reportUnknownArgumentType]
    if isinstance(value, int):
        # Python refuses to write very long integers in decimals, but TOML may hold them.
        return str(value) if value.bit_length() < LONGEST_DECIMAL_BITS else hex(value)
    return str(value)


def _array(values: Iterable[object]) -> str:
    return f"[{', '.join(toml_value(item) for item in values)}]"


def _inline_table(table: Mapping[object, object]) -> str:
    pairs = (f"{toml_key(str(key))} = {toml_value(value)}" for key, value in table.items())
    return f"{{{', '.join(pairs)}}}"


def _quoted(text: str) -> str:
    return f'"{"".join(_escaped(character) for character in text)}"'


def _escaped(character: str) -> str:
    if character in '"\\':
        return f"\\{character}"
    if character.isprintable():
        return character
    code = ord(character)
    return f"\\u{code:04X}" if code <= 0xFFFF else f"\\U{code:08X}"
