"""Printable previews of an array: flat in the hoop, cold and hot."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
import trimesh
from numpy.typing import NDArray

from sesame_cad.pipeline import Design
from sesame_cad.shape_state import ShapeState
from sesame_cad.sheet_shape import SheetShape
from sesame_cad.sheet_solid import sheet_solid
from sesame_cad.solids import Surface, array_solid, boundary_segments, cell_solid
from sesame_cad.specification import Specification
from sesame_cad.state import CellState

Vectors = NDArray[np.float64]

CHORD_TOLERANCE_MM = 0.05
"""The boundary's chords keep this near the solved curve."""

FABRIC_RINGS = 10
WIRE_SIDES = 12


def state_solid(spec: Specification, state: ShapeState) -> trimesh.Trimesh:
    """Solid of the released array."""
    if not isinstance(state, CellState):
        return _sheet(spec, state.shape)
    return _array(spec, state.surface, state.centres_mm())


def flat_solid(spec: Specification, state: ShapeState) -> trimesh.Trimesh:
    """Solid of the array as it is sewn: flat loops at the pitch of their diameter."""
    if not isinstance(state, CellState):
        return _sheet(spec, state.flat_shape)
    radius_mm = spec.layout.diameter_mm / 2

    def disc(radius: Vectors, angle_rad: Vectors) -> Vectors:
        x, y = radius * np.cos(angle_rad), radius * np.sin(angle_rad)
        return radius_mm * np.stack([x, y, np.zeros_like(x)], axis=1)

    centres = state.centres_mm() * (spec.layout.diameter_mm / state.pitch_mm)
    return _array(spec, disc, centres)


def solids(
    design: Design, progress: Callable[[str], None] = lambda _: None
) -> Iterator[tuple[str, trimesh.Trimesh]]:
    """Give the three previews by name, one after the other; none of a design without a shape."""
    for state in design.states[:1]:
        progress("preview: flat")
        yield "flat", flat_solid(design.spec, state)
    for state in design.states:
        progress(f"preview: {state.name}")
        yield state.name, state_solid(design.spec, state)


def _sheet(spec: Specification, shape: SheetShape) -> trimesh.Trimesh:
    return sheet_solid(shape, fabric_thickness_mm=spec.preview_thickness_mm, sides=WIRE_SIDES)


def _array(spec: Specification, surface: Surface, centres_mm: Vectors) -> trimesh.Trimesh:
    def boundary(angle_rad: Vectors) -> Vectors:
        return surface(np.ones_like(angle_rad), angle_rad)

    cell = cell_solid(
        surface,
        boundary,
        wire_diameter_mm=spec.wire.diameter_mm,
        fabric_thickness_mm=spec.preview_thickness_mm,
        rings=FABRIC_RINGS,
        segments=boundary_segments(boundary, CHORD_TOLERANCE_MM),
        sides=WIRE_SIDES,
    )
    return array_solid(cell, centres_mm)
