"""Links to the files that lie beside the page."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from urllib.parse import quote

WHAT = {
    "stitch": "for the embroidery machine",
    "plan": "the whole plan 1:1",
    "worksheet": "for the operator, to print",
    "cut": "cut lines 1:1",
    "shape": "solids to print",
    "pictures": "pictures",
}
"""What the folders of a package hold."""


def file_links(paths: Iterable[str]) -> str:
    """List files by their paths relative to the page."""
    items = (
        f'<li><a href="{escape(quote(path))}">{escape(path)}</a> '
        f"<span>{escape(WHAT.get(path.partition('/')[0], ''))}</span></li>"
        for path in paths
    )
    return f'<ul class="files">{"".join(items)}</ul>'
