"""Tables on the terminal."""

from __future__ import annotations

from rich.table import Table


def grid(rows: list[tuple[str, str]]) -> Table:
    """Give names and values in two columns."""
    table = Table.grid(padding=(0, 2))
    for name, value in rows:
        table.add_row(name, value)
    return table
