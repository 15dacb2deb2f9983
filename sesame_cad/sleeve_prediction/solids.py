"""Printable solids of a segment's parts, as they lie in each of its states."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
import trimesh
from manifold3d import CrossSection, FillRule, Manifold
from numpy.typing import NDArray

from patterns.cut_piece import CutPiece
from sesame_cad.bodies import CHORD_TOLERANCE_MM, FABRIC_RINGS, WIRE_SIDES
from sesame_cad.sleeve_prediction.assembly import (
    Assembly,
    SleeveRow,
    assemblies,
    beam_piece,
    constraint_piece,
)
from sesame_cad.sleeve_prediction.bent import BentBeam
from sesame_cad.solids import array_solid, boundary_segments, cell_bodies, union_solid
from sesame_cad.specification import Specification
from sesame_cad.watertight import watertight
from solver.sleeve.segment import SegmentPrediction

Vectors = NDArray[np.float64]

LONGEST_EDGE_MM = 2.0
"""Of a bent strip's facets: within 0.01 mm of a beam that bends with a radius of 50 mm."""


def segment_solids(
    spec: Specification,
    prediction: SegmentPrediction,
    progress: Callable[[str], None] = lambda _: None,
) -> Iterator[tuple[str, trimesh.Trimesh]]:
    """Give beam, constraint and sleeves in both states, by name, one after the other.

    All parts of a state lie as they do when assembled, the first rivet at the origin.
    """
    for assembly in assemblies(spec, prediction):
        progress(f"preview: segment, state {assembly.state.side}")
        for part, solid in assembly_solids(spec, assembly):
            yield f"segment-{assembly.name}-{part}", solid


def assembly_solids(
    spec: Specification, assembly: Assembly
) -> Iterator[tuple[str, trimesh.Trimesh]]:
    """Give the parts of one state by name."""
    for name, strip in zip(("beam", "constraint"), strips(spec, assembly), strict=True):
        yield name, watertight(strip)
    for row in assembly.rows:
        name = f"{'upper' if row.upper else 'lower'}-sleeve-{row.temperature}"
        yield name, sleeve_solid(spec, row, assembly.beam)


def strips(spec: Specification, assembly: Assembly) -> tuple[Manifold, Manifold]:
    """Give the bent beam with its holes and hooks, and the shorter strip, both as they are cut.

    The shorter strip lies along the chord, riveted to the beam's lower face in both states: that
    which arches down passes through its window.
    """
    thick = spec.beam.thickness_mm
    beam = _strip(beam_piece(spec), thick).warp_batch(assembly.beam.carried)
    return beam, _strip(constraint_piece(spec), thick).translate((0.0, 0.0, -thick))


def sleeve_solid(spec: Specification, row: SleeveRow, bent: BentBeam) -> trimesh.Trimesh:
    """Join a row of loops on the straight beam, and bend it with the beam."""

    def boundary(angle_rad: Vectors) -> Vectors:
        return row.loop(np.ones_like(angle_rad), angle_rad)

    bodies = cell_bodies(
        row.loop,
        boundary,
        wire_diameter_mm=spec.wire.diameter_mm,
        fabric_thickness_mm=spec.preview_thickness_mm,
        rings=FABRIC_RINGS,
        segments=boundary_segments(boundary, CHORD_TOLERANCE_MM),
        sides=WIRE_SIDES,
    )
    centres = np.stack([row.centres_mm, np.zeros_like(row.centres_mm)], axis=1)
    straight = array_solid(union_solid(bodies), centres)
    return union_solid([(bent.carried(straight.vertices), straight.faces)])


def _strip(piece: CutPiece, thickness_mm: float) -> Manifold:
    """Give a flat strip in small facets, its middle at z = 0."""
    cut = piece.polygon(CHORD_TOLERANCE_MM)
    lines = (cut.exterior, *cut.interiors)
    rings = [np.array(line.simplify(CHORD_TOLERANCE_MM).coords)[:-1] for line in lines]
    flat = CrossSection(rings, FillRule.EvenOdd).extrude(thickness_mm)
    return flat.translate((0.0, 0.0, -thickness_mm / 2)).refine_to_length(LONGEST_EDGE_MM)
