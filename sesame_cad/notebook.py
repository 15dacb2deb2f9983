"""What a notebook shows of a design: its numbers and its pictures."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable
from html import escape


def notebook_html(
    name: str, rows: Iterable[tuple[str, str]], pictures: Iterable[tuple[str, bytes]]
) -> str:
    """Write rows of names and values as a table, and PNG pictures by their paths below it."""
    cells = "".join(f"<tr><th>{escape(k)}</th><td>{escape(v)}</td></tr>" for k, v in rows)
    shown = "".join(
        f'<img alt="{escape(path)}" style="max-width: 100%" '
        f'src="data:image/png;base64,{b64encode(content).decode("ascii")}">'
        for path, content in pictures
    )
    return f"<h3>{escape(name)}</h3><table>{cells}</table>{shown}"
