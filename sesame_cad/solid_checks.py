"""Shapes read back: have they the predicted size, and are the printable ones solids."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import NDArray

from patterns.layout import Layout
from sesame_cad.errors import DesignFileError
from sesame_cad.files.glb import read_glb
from sesame_cad.files.stl import read_stl
from sesame_cad.files.threemf import read_3mf
from sesame_cad.files.vtu import read_vtu
from sesame_cad.pipeline import Design
from sesame_cad.shape_files import shape_paths
from sesame_cad.shape_state import ShapeState
from sesame_cad.solved_mesh import solved_mesh
from sesame_cad.state import CellState

HEIGHT_TOLERANCE_MM = 0.01
FOOTPRINT_TOLERANCE_MM = 0.1

Size = tuple[float, float, float]
Points = NDArray[np.float64]


def shape_sizes_mm(made: Design) -> dict[str, Size]:
    """Give width, depth and height of what each file in the folder ``shape`` should hold."""
    sizes = _solid_sizes_mm(made)
    lines = {state.name: _mesh_size_mm(made, state) for state in made.states}
    return {
        path: (lines if Path(path).suffix == ".vtu" else sizes)[Path(path).stem]
        for path in shape_paths(made)
    }


def shape_faults(content: bytes, kind: str, size_mm: Size) -> Iterator[str]:
    """Check a file of a shape, by its ending, against a size."""
    try:
        if kind == ".stl":
            solid = read_stl(content)
            yield from _solid_faults(solid)
            points = np.asarray(solid.vertices, dtype=np.float64)
        else:
            points = _READERS[kind](content)
    except DesignFileError as error:
        yield str(error)
        return
    yield from _size_faults(np.ptp(points, axis=0), size_mm)


_READERS: dict[str, Callable[[bytes], Points]] = {
    ".3mf": read_3mf,
    ".glb": read_glb,
    ".vtu": read_vtu,
}


def _mesh_size_mm(made: Design, state: ShapeState) -> Size:
    """Size of the mesh between the wires' centrelines."""
    width, depth, height = np.ptp(solved_mesh(made.spec, state).points_mm, axis=0)
    return float(width), float(depth), float(height)


def _solid_sizes_mm(made: Design) -> dict[str, Size]:
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


def _solid_faults(solid: trimesh.Trimesh) -> Iterator[str]:
    if not solid.is_watertight:
        yield "not watertight"
    if solid.volume <= 0:
        yield "inside out: its volume is not positive"


def _size_faults(measured: Points, size_mm: Size) -> Iterator[str]:
    tolerances = (FOOTPRINT_TOLERANCE_MM, FOOTPRINT_TOLERANCE_MM, HEIGHT_TOLERANCE_MM)
    for axis, found, predicted, tolerance in zip(
        ("width", "depth", "height"), measured, size_mm, tolerances, strict=True
    ):
        if not abs(found - predicted) <= tolerance:
            yield f"{axis} {found:.3f} mm; predicted {predicted:.3f} mm"


def _laid_size_mm(layout: Layout) -> tuple[float, float]:
    """Width and depth over the outer wires' centrelines in the hoop."""
    box = np.array([loop.box_mm() for loop in layout.loops])
    width, depth = box[:, 2:].max(axis=0) - box[:, :2].min(axis=0)
    return float(width), float(depth)
