"""Drawings inside a page: they take the page's colours, and scale with its width."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

from sesame_cad.files.svg_page import number


def drawing(
    width: float, height: float, label: str, parts: Iterable[str], *, style: str = ""
) -> str:
    """Join parts to a drawing with a view box of a size, and words for who cannot see it."""
    return (
        f'<svg class="{style or "drawing"}" viewBox="0 0 {number(width)} {number(height)}" '
        f'role="img" aria-label="{escape(label)}">{"".join(parts)}</svg>'
    )


def path(data: str, kind: str, **attributes: str) -> str:
    """Draw path data in the style of a kind, such as ``"cut"``."""
    more = "".join(f' {key.replace("_", "-")}="{escape(text)}"' for key, text in attributes.items())
    return f'<path class="{kind}" d="{data}"{more}/>'


def dot(place: tuple[float, float], radius: float, kind: str, title: str = "") -> str:
    """Draw a filled circle that says its title when it is pointed at."""
    x, y = place
    said = f"<title>{escape(title)}</title>" if title else ""
    return (
        f'<circle class="{kind}" cx="{number(x)}" cy="{number(y)}" r="{number(radius)}">{said}'
        "</circle>"
    )


def words(
    place: tuple[float, float], size: float, text: str, *, anchor: str = "middle", turn: float = 0
) -> str:
    """Write a line at a place, its middle or an end there, turned by degrees."""
    x, y = number(place[0]), number(place[1])
    turned = f' transform="rotate({turn:g} {x} {y})"' if turn else ""
    return (
        f'<text x="{x}" y="{y}" font-size="{number(size)}" text-anchor="{anchor}"{turned}>'
        f"{escape(text)}</text>"
    )


def dimension(
    start: tuple[float, float], end: tuple[float, float], size: float, text: str
) -> list[str]:
    """Draw a level or upright line with a tick at both ends, and words above it or beside it."""
    (x1, y1), (x2, y2) = start, end
    tick = size / 2
    level = y1 == y2
    across = (0.0, tick) if level else (tick, 0.0)
    ticks = "".join(
        f"M{number(x - across[0])},{number(y - across[1])}L{number(x + across[0])},"
        f"{number(y + across[1])}"
        for x, y in (start, end)
    )
    line = f"M{number(x1)},{number(y1)}L{number(x2)},{number(y2)}{ticks}"
    middle = ((x1 + x2) / 2, (y1 + y2) / 2)
    place = (middle[0], middle[1] - size / 3) if level else (middle[0] - size / 3, middle[1])
    return [path(line, "dimension"), words(place, size, text, turn=0 if level else -90)]
