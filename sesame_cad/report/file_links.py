"""Links to the files that lie beside the page."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from urllib.parse import quote

WHAT = {
    "design.json": "every number of the design",
    ".blocks.csv": "a line a block: head, needle, material, colour, what to do",
    ".stl": "a solid to print",
    ".3mf": "fabric and wire, to print with two materials",
    ".glb": "fabric and wire in colours, for viewers",
    ".vtu": "the solved mesh with stretch, stress and curvature, for ParaView",
    "stitch/": "for the embroidery machine",
    "plan/": "the whole plan 1:1",
    "worksheet/": "for the operator, to print",
    "cut/": "cut lines 1:1",
    "pictures/": "to look at",
}
"""What the files of a package are, by how their paths begin or end; the first that fits says it."""


def file_links(paths: Iterable[str]) -> str:
    """List files by their paths relative to the page."""
    items = (
        f'<li><a href="{escape(quote(path))}">{escape(path)}</a> '
        f"<span>{escape(_what(path))}</span></li>"
        for path in paths
    )
    return f'<ul class="files">{"".join(items)}</ul>'


def _what(path: str) -> str:
    return next(
        (says for part, says in WHAT.items() if path.endswith(part) or path.startswith(part)), ""
    )
