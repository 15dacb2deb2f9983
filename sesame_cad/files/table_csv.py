"""Curves as tables: a line of names with units, then a line a point."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

Column = Sequence[float | int | str | None]


def table_csv(columns: Mapping[str, Column]) -> str:
    """Write columns of equal length; numbers to nine digits, nothing for None."""
    lines = [",".join(columns)]
    lines += [",".join(map(_cell, row)) for row in zip(*columns.values(), strict=True)]
    return "\n".join(lines) + "\n"


def _cell(value: float | str | None) -> str:
    if value is None:
        return ""
    if isinstance(value, str):
        return f'"{value.replace(chr(34), chr(34) * 2)}"' if set(value) & set(',"\n') else value
    return f"{value:.9g}"
