"""Loops that were solved together, in space: three shapes without a way between them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from sesame_cad.coupled_state import CoupledState
from sesame_cad.report.fabric_look import FabricLook, fabric_look
from sesame_cad.report.heating import austenite_fraction, heating_data
from sesame_cad.report.packing import packed_integers, packed_reals
from sesame_cad.report.recovery import at_vertices
from sesame_cad.specification import Specification
from solver.loop_energy import scene_membrane
from solver.mesh.any_scene import fabric_of
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.fields import chain_curvature, fabric_fields
from solver.mesh.triangulation import embedded, prolonged, refined
from solver.mesh.upright import upright

Data = dict[str, Any]
Vectors = NDArray[np.float64]

MOST_TRIANGLES = 60_000
"""Meshes are drawn refined once if that leaves fewer: smoother, and still quick to turn."""


def sheet_view(spec: Specification, cold: CoupledState, hot: CoupledState) -> Data:
    """Data of the 3-D view; lengths in mm, tension in N/m, stretch in percent, curvature in 1/mm.

    Each shape has a mesh of its own: hot and cold may have been solved on meshes of other fineness.
    """
    flat = embedded(cold.found.mesh.points)
    return {
        "kind": "sheet",
        "wireDiametersMm": list(cold.diameters_mm),
        "heating": heating_data(spec),
        "states": [
            _state(spec, "flat", cold, flat) | {"heightMm": 0.0, "pitchMm": cold.pitch_at_mm(flat)},
            _state(spec, "cold", cold, upright(cold.found.mesh, cold.found.positions)),
            _state(spec, "hot", hot, upright(hot.found.mesh, hot.found.positions)),
        ],
        "whole": False,
    }


def _state(spec: Specification, stop: str, state: CoupledState, positions: Vectors) -> Data:
    """One shape; positions (n, 3) in units of the largest loop's radius, of the solved mesh."""
    found, unit = state.found, state.radius_mm
    mesh = found.mesh
    look = _look(spec, found, positions)
    drawn, columns = mesh, [positions, look.stretch_percent[:, None], look.tension_N_m[:, None]]
    if 4 * len(mesh.triangles) <= MOST_TRIANGLES:
        drawn = refined(mesh)
        columns = [
            prolonged(mesh, drawn, positions),
            *(values[drawn.parents].mean(axis=1) for values in columns[1:]),
        ]
    points, stretch, tension = columns
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    wires = [wire.vertices for wire in drawn.wires]
    moduli = {"cold": spec.wire.modulus_cold_GPa, "hot": spec.wire.modulus_hot_GPa}
    modulus = moduli.get(stop)
    return {
        "stop": stop,
        "heightMm": state.height_mm,
        "pitchMm": state.pitch_mm,
        "modulusGPa": modulus,
        "austenite": None if modulus is None else austenite_fraction(spec, modulus),
        "points": packed_reals(unit * (points - middle)),
        "triangles": packed_integers(drawn.triangles.astype(np.uint32)),
        "stretch": packed_reals(stretch[:, 0]),
        "tension": packed_reals(tension[:, 0]),
        "wires": [packed_integers(wire.astype(np.uint32)) for wire in wires],
        "curvature": [
            packed_reals(chain_curvature(unit * points[wire], closed=True)) for wire in wires
        ],
    }


def _look(spec: Specification, found: MeshEquilibrium, positions: Vectors) -> FabricLook:
    """Stretch and tension at each vertex."""
    mesh, scene = found.mesh, fabric_of(found.scene)
    stiffness = scene_membrane(scene).stiffness
    fields = fabric_fields(
        mesh, positions, scene.strain, stiffness, tension_field=found.tension_field
    )
    of_triangles = fabric_look(spec, fields)
    return FabricLook(
        at_vertices(mesh, of_triangles.stretch_percent),
        at_vertices(mesh, of_triangles.tension_N_m),
    )
