"""One thing wrong with a specification."""

from __future__ import annotations

from dataclasses import dataclass

from sesame_cad.specification.toml_text import toml_key, toml_value

LONGEST_VALUE = 60
"""Characters of a wrong value that a message shows."""


@dataclass(frozen=True, slots=True)
class Fault:
    """What is wrong with one key, on one line.

    Attributes
    ----------
    keys : tuple of str
        Section and key, or a section alone, or nothing.
    problem : str
        What is wrong, and what is allowed.
    value : str or None
        The wrong value, as TOML writes it.
    meant : tuple of str or None
        The known keys that a misspelt one is taken for.
    """

    keys: tuple[str, ...]
    problem: str
    value: str | None = None
    meant: tuple[str, ...] | None = None

    def __str__(self) -> str:
        key = ".".join(map(toml_key, self.keys))
        shown = "" if self.value is None else f" = {self.value}"
        return f"{key}{shown}: {self.problem}"


def shown_value(value: object) -> str:
    """Write a wrong value on one line, cut short when it is long."""
    try:
        text = toml_value(value)
    except RecursionError:
        return "[...]"
    return text if len(text) <= LONGEST_VALUE else f"{text[: LONGEST_VALUE - 3]}..."
