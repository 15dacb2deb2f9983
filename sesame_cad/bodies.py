"""The closed surfaces of which a drawn array is made: fabric and wire, and where copies stand."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sesame_cad.shape_state import ShapeState
from sesame_cad.sheet_shape import SheetShape
from sesame_cad.sheet_solid import sheet_bodies
from sesame_cad.solids import Surface, Triangles, boundary_segments, cell_bodies
from sesame_cad.specification import Specification
from sesame_cad.state import CellState

Vectors = NDArray[np.float64]

CHORD_TOLERANCE_MM = 0.05
"""The boundary's chords keep this near the solved curve."""

FABRIC_RINGS = 10
WIRE_SIDES = 12

FABRIC, WIRE = "fabric", "wire"

_ORIGIN = np.zeros((1, 2))


@dataclass(frozen=True)
class Body:
    """A closed surface that stands in one or more places.

    Attributes
    ----------
    name : str
        What it is, and its number among those.
    material : str
        ``"fabric"`` or ``"wire"``.
    points : array (n, 3)
        In mm.
    faces : array (m, 3)
        Turned outward.
    places_mm : array (k, 2)
        Where the origin of each copy goes.
    """

    name: str
    material: str
    points: Vectors
    faces: Triangles
    places_mm: Vectors


def released_bodies(spec: Specification, state: ShapeState) -> tuple[Body, ...]:
    """Give the bodies of the released array, fabric before wire."""
    if not isinstance(state, CellState):
        return _sheet(spec, state.shape)
    return _cells(spec, state.surface, state.centres_mm())


def flat_bodies(spec: Specification, state: ShapeState) -> tuple[Body, ...]:
    """Give those of the array as it is sewn: flat loops at the pitch of their diameter."""
    if not isinstance(state, CellState):
        return _sheet(spec, state.flat_shape)
    radius_mm = spec.layout.diameter_mm / 2

    def disc(radius: Vectors, angle_rad: Vectors) -> Vectors:
        x, y = radius * np.cos(angle_rad), radius * np.sin(angle_rad)
        return radius_mm * np.stack([x, y, np.zeros_like(x)], axis=1)

    centres = state.centres_mm() * (spec.layout.diameter_mm / state.pitch_mm)
    return _cells(spec, disc, centres)


def _cells(spec: Specification, surface: Surface, centres_mm: Vectors) -> tuple[Body, ...]:
    def boundary(angle_rad: Vectors) -> Vectors:
        return surface(np.ones_like(angle_rad), angle_rad)

    slab, tube = cell_bodies(
        surface,
        boundary,
        wire_diameter_mm=spec.wire.diameter_mm,
        fabric_thickness_mm=spec.preview_thickness_mm,
        rings=FABRIC_RINGS,
        segments=boundary_segments(boundary, CHORD_TOLERANCE_MM),
        sides=WIRE_SIDES,
    )
    return Body(FABRIC, FABRIC, *slab, centres_mm), Body(WIRE, WIRE, *tube, centres_mm)


def _sheet(spec: Specification, shape: SheetShape) -> tuple[Body, ...]:
    slabs, tubes = sheet_bodies(
        shape, fabric_thickness_mm=spec.preview_thickness_mm, sides=WIRE_SIDES
    )
    named = [(FABRIC, k, one) for k, one in enumerate(slabs, 1)]
    named += [(WIRE, k, one) for k, one in enumerate(tubes, 1)]
    return tuple(Body(f"{name} {k}", name, *one, _ORIGIN) for name, k, one in named)
