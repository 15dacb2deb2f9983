"""The operator's worksheet on paper: words first, then the outline, 1:1 where it fits."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import ceil

from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from sesame_cad.pictures.paper import (
    MARGIN_MM,
    PAPERS_MM,
    blank_page,
    pdf_bytes,
    wrapped,
    write_text,
)
from sesame_cad.pictures.template import template_page
from sesame_cad.pipeline import Pattern
from sesame_cad.worksheet import BlockRow, Worksheet

_TITLE_PT, _HEADING_PT, _TEXT_PT = 15.0, 10.0, 8.0
_LINE_MM, _GAP_MM = 3.9, 1.2
_NAME_MM, _BLOCK_MM, _SWATCH_MM = 48.0, 62.0, 3.0


@dataclass
class _Column:
    """Pages that fill from the top; a new one is begun where a part does not fit."""

    size_mm: tuple[float, float]
    title: str
    pages: list[Axes]
    y_mm: float = 0.0

    @property
    def width_mm(self) -> float:
        return self.size_mm[0] - 2 * MARGIN_MM

    def room(self, height_mm: float) -> Axes:
        """Give the page that has room for so much more, and go down by it."""
        if not self.pages or self.y_mm - height_mm < MARGIN_MM:
            self.pages.append(blank_page(*self.size_mm))
            self.y_mm = self.size_mm[1] - MARGIN_MM - 6.0
            more = ", continued" if len(self.pages) > 1 else ""
            place = MARGIN_MM, self.y_mm
            write_text(self.pages[-1], place, f"{self.title}: worksheet{more}", _TITLE_PT, "bold")
            self.y_mm -= 4.0
        self.y_mm -= height_mm
        return self.pages[-1]


def worksheet_pdf(sheet: Worksheet, laid: Pattern, paper: str) -> bytes:
    """Lay a worksheet on paper; as vectors, and the same bytes every time.

    Parameters
    ----------
    paper
        ``"a4"`` or ``"letter"``.
    """
    size = PAPERS_MM[paper]
    column = _Column(size, sheet.title, [])
    _write_pairs(column, "Job", sheet.facts)
    _write_pairs(column, "Material", sheet.materials)
    _write_heading(column, "Blocks, in the order of sewing; what to do before each")
    for row in sheet.blocks:
        _write_block(column, row)
    _write_heading(column, "Notes")
    for line in wrapped(sheet.notes, column.width_mm, _TEXT_PT) if sheet.notes else ():
        axes = column.room(_LINE_MM)
        write_text(axes, (MARGIN_MM, column.y_mm), line, _TEXT_PT)
    return pdf_bytes([*column.pages, template_page(laid, sheet.title, size)])


def _write_heading(column: _Column, text: str) -> None:
    axes = column.room(_LINE_MM + 4.0)
    write_text(axes, (MARGIN_MM, column.y_mm + 1.0), text, _HEADING_PT, "bold")
    across = [MARGIN_MM, MARGIN_MM + column.width_mm]
    axes.plot(across, [column.y_mm, column.y_mm], color="#999999", linewidth=0.5)
    column.y_mm -= 0.6


def _write_pairs(column: _Column, heading: str, rows: tuple[tuple[str, str], ...]) -> None:
    _write_heading(column, heading)
    for name, value in rows:
        names = wrapped(name, _NAME_MM - 2.0, _TEXT_PT)
        values = wrapped(value, column.width_mm - _NAME_MM, _TEXT_PT)
        _write_beside(column, names, values, _NAME_MM)


def _write_block(column: _Column, row: BlockRow) -> None:
    about = (
        f"{row.number}  {row.thread.material}",
        f"{row.thread.place}, {row.thread.colour_name}",
        f"{row.stitches} stitches, about {ceil(row.minutes)} min",
    )
    names = [line for text in about for line in wrapped(text, _BLOCK_MM - 8.0, _TEXT_PT)]
    values = wrapped(row.instruction, column.width_mm - _BLOCK_MM, _TEXT_PT)
    axes, top = _write_beside(column, names, values, _BLOCK_MM, indent_mm=5.0)
    corner = MARGIN_MM, top - _SWATCH_MM
    axes.add_patch(
        Rectangle(corner, _SWATCH_MM, _SWATCH_MM, color=row.thread.spool_colour, linewidth=0)
    )


def _write_beside(
    column: _Column,
    names: tuple[str, ...] | list[str],
    values: tuple[str, ...],
    apart_mm: float,
    indent_mm: float = 0.0,
) -> tuple[Axes, float]:
    """Write two columns of lines that stay together; gives the page and where they begin."""
    height = max(len(names), len(values)) * _LINE_MM + _GAP_MM
    axes = column.room(height)
    top = column.y_mm + height - _GAP_MM
    for at, lines in ((indent_mm, names), (apart_mm, values)):
        for baseline, line in _baselines(top, lines):
            write_text(axes, (MARGIN_MM + at, baseline), line, _TEXT_PT)
    return axes, top


def _baselines(top_mm: float, lines: tuple[str, ...] | list[str]) -> Iterator[tuple[float, str]]:
    for k, line in enumerate(lines):
        yield top_mm - _LINE_MM * k - 2.7, line
