"""Markup, styles and programs of the pages."""

from __future__ import annotations

from importlib.resources import files

SCRIPTS = (
    "packing",
    "dragging",
    "geometry",
    "shapes",
    "heating",
    "painter",
    "viewer",
    "records",
    "sewing_canvas",
    "player",
    "page",
)
"""In the order in which they are read."""


def asset(name: str) -> str:
    """Read a file."""
    return (files(__name__) / name).read_text(encoding="utf-8")


def script() -> str:
    """Join all programs to one that leaves no names behind."""
    scripts = "\n".join(asset(f"{name}.js") for name in SCRIPTS)
    return f'"use strict";\n(() => {{\n{scripts}}})();'
