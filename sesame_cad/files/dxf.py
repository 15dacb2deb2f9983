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
        _draw(document.modelspace(), outline, marks)
        return document_text(document)


def _draw(space: Modelspace, outline: Outline, marks: tuple[Mark, ...]) -> None:
    for ring in outline.openings:
        space.add_lwpolyline(ring.tolist(), close=True, dxfattribs={"layer": "HOLE"})
    for ring in outline.outsides:
        space.add_lwpolyline(ring.tolist(), close=True, dxfattribs={"layer": "CUT"})
    for mark in marks:
        for stroke in mark.strokes:
            space.add_lwpolyline(stroke.tolist(), dxfattribs={"layer": "MARK"})
    bar = lay_out(outline, marks).check_bar
    space.add_lwpolyline(bar.tolist(), dxfattribs={"layer": "REFERENCE"})


def read_outline_dxf(data: bytes) -> tuple[Outline, Strokes]:
    """Read the cut lines and strokes back.

    Raises
    ------
    DesignFileError
        When the drawing is not in millimetres, a cut line is open or bent, or something other
        than a polyline is drawn.
    """
    document = read_millimetres(data)
    lines = list(_lines(document))
    for layer, line in lines:
        if layer in ("CUT", "HOLE") and not line.closed:
            raise DesignFileError(f"a line on layer {layer} of the DXF is not closed")
    outside = [_points(line) for layer, line in lines if layer == "CUT"]
    if not outside:
        raise DesignFileError("0 lines on the DXF's layer CUT instead of one or more")
    openings = tuple(_points(line) for layer, line in lines if layer == "HOLE")
    strokes = tuple(_points(line) for layer, line in lines if layer == "MARK")
    return Outline(outside[0], openings, tuple(outside[1:])), strokes


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
    document = _read(data)
    units = document.header.get("$INSUNITS", 0)
    if units != MM:
        raise DesignFileError(f"the DXF's units are {units}, not 4 (mm)")
    return document


def _read(data: bytes) -> Drawing:
    try:
        return read(io.StringIO(data.decode("utf-8")))
    # A damaged file can fail anywhere in the library.
    except (DXFError, ValueError, LookupError, TypeError, AttributeError, OSError) as error:
        raise DesignFileError(f"this is no DXF that can be read: {error}") from error


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


def _points(line: LWPolyline) -> Ring:
    return np.array([(x, y) for x, y, *_ in line.get_points()], dtype=np.float64)
