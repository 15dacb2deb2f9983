"""A sheet of plastic inside a page: the mat, and every line that is cut from it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from patterns.mat import Mat
from sesame_cad.files.cut_line import CUT, HOLE, CutLine
from sesame_cad.files.cut_svg import cut_line_path, mat_sheet
from sesame_cad.files.sheet import Sheet
from sesame_cad.report.cut_drawing import mat_grid
from sesame_cad.report.inline_svg import dot, drawing, path

_KINDS = {CUT: "cut", HOLE: "hole"}


def sheet_drawing(lines: Iterable[CutLine], mat: Mat, name: str) -> str:
    """Draw a sheet on its mat, ruled in centimetres."""
    sheet = mat_sheet(mat)
    label = f"{name} on a mat of {mat.width_mm:g} by {mat.height_mm:g} mm"
    return drawing(sheet.width_mm, mat.height_mm, label, _parts(lines, sheet))


def _parts(lines: Iterable[CutLine], sheet: Sheet) -> Iterator[str]:
    yield path(mat_grid(sheet), "mat")
    for line in lines:
        if line.is_circle:
            x, y, diameter = line.vertices[0].tolist()
            ((x, y),) = sheet.on_page(np.array([(x, y)])).tolist()
            yield dot((x, y), diameter / 2, _KINDS[line.layer])
        else:
            yield path(cut_line_path(sheet, line), _KINDS[line.layer])
