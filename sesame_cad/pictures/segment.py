"""A segment in both of its states, from the side."""

from __future__ import annotations

from collections.abc import Iterator
from types import MappingProxyType

import numpy as np
from matplotlib.colors import to_rgb

from sesame_cad.pictures.rendering import AnyPatch, View, fabric_patch, solid_patch, wire_patch
from sesame_cad.pictures.shapes import FABRIC, WIRE, PatchView, shapes_picture
from sesame_cad.sleeve_prediction.assembly import COLD, HOT, Assembly, assemblies
from sesame_cad.sleeve_prediction.solids import strips
from sesame_cad.specification import Specification
from solver.sleeve.segment import SegmentPrediction

BEAM, CONSTRAINT = "#C9CED3", "#6E7780"
COLOURS = MappingProxyType({COLD: (FABRIC, "#2F4B6E"), HOT: ("#F3C2A4", WIRE)})
"""Fabric and wire of a sleeve."""

_AIR = 1.15
"""Room below for the scale."""

FROM_THE_SIDE = View(azimuth_deg=-90.0, elevation_deg=14.0)


def segment_picture(spec: Specification, prediction: SegmentPrediction) -> bytes:
    """Draw both states side by side at one scale; a PNG."""
    views = [
        PatchView(assembly.title, tuple(_patches(spec, assembly)))
        for assembly in assemblies(spec, prediction)
    ]
    return shapes_picture(views, FROM_THE_SIDE, _AIR)


def _patches(spec: Specification, assembly: Assembly) -> Iterator[AnyPatch]:
    for strip, colour in zip(strips(spec, assembly), (BEAM, CONSTRAINT), strict=True):
        mesh = strip.to_mesh64()
        points, faces = mesh.vert_properties[:, :3], mesh.tri_verts.astype(np.int64)
        yield solid_patch(points, faces, np.array(to_rgb(colour)))
    for row in assembly.rows:
        fabric, wire = (np.array(to_rgb(colour)) for colour in COLOURS[row.temperature])
        for surface in row.surfaces(assembly.beam):
            yield fabric_patch(surface, fabric)
            yield wire_patch(surface, spec.wire.diameter_mm, wire)
