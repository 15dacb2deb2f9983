"""Markup, styles and programs of the pages."""

from __future__ import annotations

from html import escape
from importlib.resources import files
from string import Template

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


def page(name: str, title: str, **parts: object) -> str:
    """Fill a page's template, behind the head that all pages have."""
    whole = Template(asset("head.html") + asset(f"{name}.html"))
    return whole.substitute(parts, title=escape(title), style=asset("style.css"))


def script() -> str:
    """Join all programs to one that leaves no names behind."""
    scripts = "\n".join(asset(f"{name}.js") for name in SCRIPTS)
    return f'"use strict";\n(() => {{\n{scripts}}})();'
