"""Pages of paper with text and lines at places in millimetres, as a reproducible PDF."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from functools import cache
from types import MappingProxyType

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.backends.backend_pdf import FigureCanvasPdf, PdfPages
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties, findfont, get_font
from matplotlib.textpath import TextToPath

MM_PER_INCH = 25.4
POINTS_PER_MM = 72 / MM_PER_INCH

PAPERS_MM = MappingProxyType({"a4": (210.0, 297.0), "letter": (215.9, 279.4)})
"""Width and height, upright (ISO 216; ANSI Y14.1)."""

MARGIN_MM = 12.0
"""Printers leave this much free."""

_METADATA = MappingProxyType({"CreationDate": None, "Creator": None, "Producer": None})


def blank_page(width_mm: float, height_mm: float) -> Axes:
    """Give axes that fill a page; their coordinates are mm from its lower left corner."""
    figure = Figure(figsize=(width_mm / MM_PER_INCH, height_mm / MM_PER_INCH))
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_xlim(0.0, width_mm)
    axes.set_ylim(0.0, height_mm)
    axes.set_axis_off()
    return axes


def pdf_bytes(pages: Sequence[Axes]) -> bytes:
    """Write pages one after the other, with fonts whose text can be searched and copied."""
    stream = io.BytesIO()
    with (
        rc_context({"pdf.fonttype": 42}),
        PdfPages(stream, metadata=dict(_METADATA)) as document,
    ):
        for axes in pages:
            figure = axes.get_figure(root=True)
            FigureCanvasPdf(figure)
            document.savefig(figure)
    return stream.getvalue()


def write_text(
    axes: Axes, place_mm: tuple[float, float], text: str, size_pt: float, weight: str = "normal"
) -> None:
    """Write a line from a place at its baseline, letter by letter as it stands."""
    axes.text(
        *place_mm,
        printable(text),
        fontproperties=_font(size_pt, weight),
        ha="left",
        va="baseline",
        parse_math=False,
    )


def wrapped(text: str, width_mm: float, size_pt: float) -> tuple[str, ...]:
    """Break a text into lines that are no wider than a width."""
    lines = (line for part in text.split("\n") for line in _broken(part, width_mm, size_pt))
    return tuple(lines)


def printable(text: str) -> str:
    """Put a question mark for each character that the font does not have."""
    return "".join(c if ord(c) in _characters() else "?" for c in text)


def _broken(line: str, width_mm: float, size_pt: float) -> Iterator[str]:
    held = ""
    for word in line.split(" "):
        longer = f"{held} {word}" if held else word
        if text_width_mm(longer, size_pt) <= width_mm:
            held = longer
            continue
        if held:
            yield held
        *full, held = _chopped(word, width_mm, size_pt)
        yield from full
    yield held


def _chopped(word: str, width_mm: float, size_pt: float) -> list[str]:
    """Give the parts of a word that fit on a line each."""
    parts = [""]
    for letter in word:
        if parts[-1] and text_width_mm(parts[-1] + letter, size_pt) > width_mm:
            parts.append("")
        parts[-1] += letter
    return parts


def text_width_mm(text: str, size_pt: float) -> float:
    """Width of a line of text."""
    width, _, _ = TextToPath().get_text_width_height_descent(
        printable(text), _font(size_pt, "normal"), ismath=False
    )
    return float(width) / POINTS_PER_MM


@cache
def _font(size_pt: float, weight: str) -> FontProperties:
    # The one font that comes with matplotlib: the same on every machine.
    return FontProperties(family="DejaVu Sans", size=size_pt, weight=weight)


@cache
def _characters() -> frozenset[int]:
    found = get_font(findfont(_font(10.0, "normal")))
    return frozenset(found.get_charmap())
