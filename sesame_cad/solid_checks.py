"""Previews read back: are they solids of the predicted size."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from patterns.layout import Layout
from sesame_cad.errors import DesignFileError
from sesame_cad.files.stl import read_stl
from sesame_cad.pipeline import Design
from sesame_cad.state import CellState

HEIGHT_TOLERANCE_MM = 0.01
FOOTPRINT_TOLERANCE_MM = 0.1

Size = tuple[float, float, float]


def solid_sizes_mm(made: Design) -> dict[str, Size]:
    """Give width, depth and height, with the wire, of each preview that there should be."""
    wire = made.spec.wire.diameter_mm
    sizes: dict[str, Size] = {}
    for state in made.states:
        width, depth = _laid_size_mm(made.pattern.circuit.layout)
        sizes["flat"] = (width + wire, depth + wire, wire)
        if not isinstance(state, CellState):
            sizes["flat"] = state.flat_shape.size_mm(made.spec.preview_thickness_mm)
            sizes[state.name] = state.shape.size_mm(made.spec.preview_thickness_mm)
            continue
        width, depth = state.footprint_mm
        sizes[state.name] = (width + wire, depth + wire, state.height_mm + wire)
    return sizes


def solid_faults(content: bytes, size_mm: Size) -> Iterator[str]:
    """Check that an STL file is one watertight solid of a size."""
    try:
        solid = read_stl(content)
    except DesignFileError as error:
        yield str(error)
        return
    if not solid.is_watertight:
        yield "not watertight"
    if solid.volume <= 0:
        yield "inside out: its volume is not positive"
    tolerances = (FOOTPRINT_TOLERANCE_MM, FOOTPRINT_TOLERANCE_MM, HEIGHT_TOLERANCE_MM)
    measured = solid.extents
    for axis, found, predicted, tolerance in zip(
        ("width", "depth", "height"), measured, size_mm, tolerances, strict=True
    ):
        if abs(found - predicted) > tolerance:
            yield f"{axis} {found:.3f} mm; predicted {predicted:.3f} mm with the wire"


def _laid_size_mm(layout: Layout) -> tuple[float, float]:
    """Width and depth over the outer wires' centrelines in the hoop."""
    box = np.array([loop.box_mm() for loop in layout.loops])
    width, depth = box[:, 2:].max(axis=0) - box[:, :2].min(axis=0)
    return float(width), float(depth)
