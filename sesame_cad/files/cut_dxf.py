"""Sheets to cut as DXF R2010: circles stay circles, arcs are bulges of polylines."""

from __future__ import annotations

import numpy as np
from ezdxf.entities.circle import Circle
from ezdxf.entities.dxfgfx import DXFGraphic
from ezdxf.entities.lwpolyline import LWPolyline

from patterns.mat import Mat
from sesame_cad.errors import DesignFileError
from sesame_cad.files.cut_line import CUT, HOLE, CutLine
from sesame_cad.files.cut_svg import mat_sheet
from sesame_cad.files.dxf import document_text, new_document, read_millimetres, without_dates


def cut_dxf(lines: tuple[CutLine, ...], mat: Mat) -> str:
    """Draw a sheet in the mat's coordinates, in the order of cutting.

    Layers: HOLE (inside pieces), CUT (outsides), REFERENCE (a 100 mm bar; not cut).
    """
    with without_dates():
        document = new_document()
        space = document.modelspace()
        for line in lines:
            on = {"layer": line.layer}
            if line.is_circle:
                x, y, diameter = line.vertices[0].tolist()
                space.add_circle((x, y), diameter / 2, dxfattribs=on)
            else:
                corners = line.vertices.tolist()
                space.add_lwpolyline(corners, format="xyb", close=line.closed, dxfattribs=on)
        bar = mat_sheet(mat).check_bar
        space.add_lwpolyline(bar.tolist(), dxfattribs={"layer": "REFERENCE"})
        return document_text(document)


def read_cut_dxf(data: bytes) -> tuple[CutLine, ...]:
    """Read the lines of a sheet back, in order.

    Raises
    ------
    DesignFileError
        When the drawing is not in millimetres, or holds more than circles and polylines.
    """
    document = read_millimetres(data)
    drawn = [one for one in document.modelspace() if one.dxf.layer != "REFERENCE"]
    return tuple(_line(one) for one in drawn)


def _line(entity: DXFGraphic) -> CutLine:
    layer = str(entity.dxf.layer)
    if layer not in (HOLE, CUT):
        raise DesignFileError(f"the DXF draws on layer {layer!r}; known are {HOLE} and {CUT}")
    if isinstance(entity, Circle):
        x, y, _ = entity.dxf.center
        return CutLine(layer, True, np.array([[x, y, 2 * entity.dxf.radius]], dtype=np.float64))
    if isinstance(entity, LWPolyline):
        corners = np.array(list(entity.get_points("xyb")), dtype=np.float64)
        return CutLine(layer, bool(entity.closed), corners)
    raise DesignFileError(f"the DXF's layer {layer} holds a {entity.dxftype()}, no line to cut")
