"""Cut files for CAM programs: DXF R2010 in millimetres."""

from __future__ import annotations

import io
from collections.abc import Generator, Iterator
from contextlib import contextmanager

import numpy as np
from ezdxf._options import options
from ezdxf.document import Drawing
from ezdxf.entities.lwpolyline import LWPolyline
from ezdxf.filemanagement import new, read
from ezdxf.layouts.layout import Modelspace
from ezdxf.lldxf.const import DXFError
from ezdxf.units import MM
from numpy.typing import NDArray

from patterns.loop_ring import Ring
from patterns.outline import Outline
from patterns.registration import Mark
from sesame_cad.errors import DesignFileError
from sesame_cad.files.dxf_vertices import (
    all_vertices,
    stand_in,
    with_vertices,
    without_vertices,
)
from sesame_cad.files.sheet import lay_out

Strokes = tuple[NDArray[np.float64], ...]

_COLOURS = {"HOLE": 5, "CUT": 1, "MARK": 7, "REFERENCE": 8}
_METRIC = 1


def outline_dxf(outline: Outline, marks: tuple[Mark, ...]) -> str:
    """Draw cut lines and marks in the design's coordinates, inner lines first.

    Layers: HOLE (openings), CUT (outside), MARK (registration), REFERENCE (a 100 mm bar; not cut).
    """
    with without_dates():
        document = new_document()
        lines = _draw(document.modelspace(), outline, marks)
        return with_vertices(document_text(document), lines)


def _draw(space: Modelspace, outline: Outline, marks: tuple[Mark, ...]) -> list[Ring]:
    """Draw every line as the vertex that stands for it, and give the lines."""
    bar = lay_out(outline, marks).check_bar
    drawn = [
        *(("HOLE", ring) for ring in outline.openings),
        *(("CUT", ring) for ring in outline.outsides),
        *(("MARK", stroke) for mark in marks for stroke in mark.strokes),
        ("REFERENCE", bar),
    ]
    for number, (layer, _) in enumerate(drawn):
        closed = layer in ("HOLE", "CUT")
        space.add_lwpolyline(stand_in(number), close=closed, dxfattribs={"layer": layer})
    return [line for _, line in drawn]


def read_outline_dxf(data: bytes) -> tuple[Outline, Strokes]:
    """Read the cut lines and strokes back.

    Raises
    ------
    DesignFileError
        When the drawing is not in millimetres, a cut line is open or bent, or something other
        than a polyline is drawn.
    """
    document, taken = _read(data)
    lines = list(_lines(document))
    for layer, line in lines:
        if layer in ("CUT", "HOLE") and not line.closed:
            raise DesignFileError(f"a line on layer {layer} of the DXF is not closed")
    rings = {
        layer: [_points(line, taken) for of, line in lines if of == layer] for layer in _COLOURS
    }
    outside = rings["CUT"]
    if not outside:
        raise DesignFileError("0 lines on the DXF's layer CUT instead of one or more")
    return Outline(outside[0], tuple(rings["HOLE"]), tuple(outside[1:])), tuple(rings["MARK"])


def new_document() -> Drawing:
    """Begin a drawing in millimetres, with the layers of cut files."""
    document = new("R2010", setup=False, units=MM)
    document.header["$MEASUREMENT"] = _METRIC
    for layer, colour in _COLOURS.items():
        document.layers.add(layer, color=colour)
    # A layer that plots nothing keeps the bar out of the cut.
    document.layers.get("REFERENCE").dxf.plot = 0
    return document


def document_text(document: Drawing) -> str:
    """Write a drawing."""
    stream = io.StringIO()
    document.write(stream)
    return stream.getvalue()


@contextmanager
def without_dates() -> Generator[None]:
    """Keep dates and random identifiers out of documents that are made and written within."""
    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        options.write_fixed_meta_data_for_testing = before


def read_millimetres(data: bytes) -> Drawing:
    """Read a drawing in millimetres; raises `DesignFileError` when it is none."""
    return _in_millimetres(_decoded(data))


def _read(data: bytes) -> tuple[Drawing, list[Ring]]:
    """Read a drawing without most of its vertices, and these."""
    try:
        text, taken = without_vertices(_decoded(data))
    except ValueError as error:
        raise _unreadable(error) from error
    return _in_millimetres(text), taken


def _unreadable(error: Exception) -> DesignFileError:
    return DesignFileError(f"this is no DXF that can be read: {error}")


def _decoded(data: bytes) -> str:
    try:
        return data.decode("utf-8")
    except ValueError as error:
        raise _unreadable(error) from error


def _in_millimetres(text: str) -> Drawing:
    document = _parsed(text)
    units = document.header.get("$INSUNITS", 0)
    if units != MM:
        raise DesignFileError(f"the DXF's units are {units}, not 4 (mm)")
    return document


def _parsed(text: str) -> Drawing:
    try:
        return read(io.StringIO(text))
    # A damaged file can fail anywhere in the library.
    except (DXFError, ValueError, LookupError, TypeError, AttributeError, OSError) as error:
        raise _unreadable(error) from error


def _lines(document: Drawing) -> Iterator[tuple[str, LWPolyline]]:
    for entity in document.modelspace():
        layer = str(entity.dxf.layer)
        if layer not in _COLOURS:
            raise DesignFileError(
                f"the DXF draws on layer {layer!r}; known are {', '.join(_COLOURS)}"
            )
        if not isinstance(entity, LWPolyline) or entity.has_arc:
            raise DesignFileError(
                f"the DXF's layer {layer} holds a {entity.dxftype()} that is no polyline"
            )
        yield layer, entity


def _points(line: LWPolyline, taken: list[Ring]) -> Ring:
    try:
        return all_vertices([(x, y) for x, y, *_ in line.get_points()], taken)
    except (IndexError, ValueError) as error:
        raise DesignFileError(f"a line of the DXF cannot be read: {error}") from error
