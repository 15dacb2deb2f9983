"""A solved shape with what it feels in every place, as a mesh: for ParaView and the like."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sesame_cad.shape_state import ShapeState
from sesame_cad.specification import Specification
from sesame_cad.state import CellState
from solver.loop_energy import scene_membrane
from solver.mesh.any_scene import fabric_of
from solver.mesh.fields import FabricFields, chain_curvature, fabric_fields
from solver.mesh.loop_mesh import loop_fan
from solver.mesh.triangulation import Mesh, refined
from solver.mesh.upright import upright
from solver.scene import LoopScene

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]

CELL_REFINEMENTS = 4
"""Of the mesh on which one loop's smooth shape is read: 5,120 triangles."""


@dataclass(frozen=True)
class SolvedMesh:
    """Fabric and wires in space: one loop where all are alike, else the whole array.

    Attributes
    ----------
    mesh : Mesh
        Flat, in units of ``radius_mm``.
    points_mm : array (n, 3)
        Where its vertices are.
    radius_mm : float
    modulus_kPa : float
        Unit of the stresses.
    fabric : FabricFields
    """

    mesh: Mesh
    points_mm: Vectors
    radius_mm: float
    modulus_kPa: float  # noqa: N815 - the unit's own spelling
    fabric: FabricFields

    @property
    def flat_mm(self) -> Vectors:
        """Where the vertices were in the hoop, (n, 2)."""
        return self.mesh.points * self.radius_mm

    @property
    def wire_edges(self) -> Indices:
        """Vertices (e, 2) at the ends of each edge along a wire."""
        return np.concatenate([wire.edges for wire in self.mesh.wires])

    @property
    def curvature_per_mm(self) -> Vectors:
        """Of the wire through each vertex, (n,); no number where there is none."""
        curvature = np.full(len(self.points_mm), np.nan)
        for wire in self.mesh.wires:
            chain = self.points_mm[wire.vertices]
            curvature[wire.vertices] = chain_curvature(chain, closed=wire.closed)
        return curvature


def solved_mesh(spec: Specification, state: ShapeState) -> SolvedMesh:
    """Read a state on its mesh; a smooth shape on one fine enough for pictures."""
    if isinstance(state, CellState):
        read = (*_cell(state), state.equilibrium.scene, False)
    else:
        found = state.found
        positions = upright(found.mesh, found.positions)
        read = (found.mesh, positions, fabric_of(found.scene), found.tension_field)
    mesh, positions, scene, tension_field = read
    fields = _fields(mesh, positions, scene, tension_field=tension_field)
    radius = state.radius_mm
    return SolvedMesh(mesh, positions * radius, radius, spec.fabric.modulus_kPa, fields)


def _cell(state: CellState) -> tuple[Mesh, Vectors]:
    mesh = loop_fan()
    for _ in range(CELL_REFINEMENTS):
        mesh = refined(mesh)
    x, y = mesh.points.T
    return mesh, state.equilibrium.shape.position(np.hypot(x, y), np.arctan2(y, x))


def _fields(
    mesh: Mesh, positions: Vectors, scene: LoopScene, *, tension_field: bool
) -> FabricFields:
    stiffness = scene_membrane(scene).stiffness
    return fabric_fields(mesh, positions, scene.strain, stiffness, tension_field=tension_field)
