"""A scene on its sequence of meshes: the energy on each, and where a solve begins."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from solver.errors import SceneError
from solver.loop_energy import scene_membrane
from solver.mesh.array_mesh import array_fan, grid_knots
from solver.mesh.bonds import bond_energy
from solver.mesh.levelling import levelling_energy
from solver.mesh.loop_mesh import SEGMENTS, loop_fan
from solver.mesh.mesh_energy import Family, MeshEnergy, listed, mesh_energy
from solver.mesh.mirror import Mirrors
from solver.mesh.mirrored_energy import MirroredEnergy
from solver.mesh.orbits import one_of_each
from solver.mesh.plane_mesh import plane_mesh
from solver.mesh.rod_energy import WireStiffness, rod_energies
from solver.mesh.scene import ArrayScene, Contact, loop_wire
from solver.mesh.sheet import SheetScene
from solver.mesh.star_bending import star_bending
from solver.mesh.triangle_energy import TriangleEnergy, triangle_energy
from solver.mesh.triangulation import Mesh, refinements
from solver.mesh.wire_twist import twist_energies
from solver.scene import LoopScene

Vectors = NDArray[np.float64]

LARGEST_REFINEMENT = 7
FEWEST_SEGMENTS = 12
MOST_SEGMENTS = 80
_LEVELLING = 1e-4
"""Lifts the shape's energy by less than that, times its mean square height, for each loop."""
TENSION_FIELD_TERM = "fabric stretch (tension field)"
LEVELLING_TERM = "levelling"
_BOND = 1000.0
"""Stiffness of a bond over the largest β: tangents part by about κ R/500."""


@dataclass(frozen=True)
class MeshProblem:
    """Fabric, wires and bonds, on meshes each of which refines the one before.

    Attributes
    ----------
    meshes : tuple of Mesh
        Coarsest first.
    strain : float
        ε of the fabric.
    fabric : array (3, 3)
        Its stiffness, units of E_f.
    wires : tuple of WireStiffness
    bonded : bool
        Whether wires that touch keep their tangents parallel.
    tension_field : bool
        Whether the fabric wrinkles instead of bearing compression.
    loose : frozenset of int
        Vertices at which wires share no more than the point, though others are bonded.
    levelling : float
        Stiffness, in units of E_f t, with which all is drawn to the plane.
    alpha : float
        α of the fabric's bending.
    mirrored : bool
        Whether only shapes are looked at that are their own images in the planes through the
        meshes' middle; see `solver.mesh.mirrored_energy`.
    """

    meshes: tuple[Mesh, ...]
    strain: float
    fabric: Vectors
    wires: tuple[WireStiffness, ...]
    bonded: bool
    tension_field: bool = False
    loose: frozenset[int] = frozenset()
    levelling: float = 0.0
    alpha: float = 0.0
    mirrored: bool = False

    def fabric_on(self, level: int) -> TriangleEnergy:
        """Fabric on one of the meshes."""
        return triangle_energy(
            self.meshes[level], self.strain, self.fabric, tension_field=self.tension_field
        )

    def energy(self, level: int) -> MeshEnergy:
        """Energy on one of the meshes."""
        return mesh_energy(self._families(level), len(self.meshes[level].points))

    def mirrored_energy(self, level: int, planes: Mirrors) -> MirroredEnergy:
        """Energy on one of the meshes of shapes that are their own images in planes."""
        quarter = {
            name: tuple(one_of_each(elements, planes) for elements in listed(family))
            for name, family in self._families(level).items()
        }
        return MirroredEnergy(mesh_energy(quarter, len(self.meshes[level].points)), planes)

    def _families(self, level: int) -> dict[str, Family]:
        mesh = self.meshes[level]
        bending, stretch = rod_energies(mesh, self.wires)
        families: dict[str, Family] = {
            TENSION_FIELD_TERM if self.tension_field else "fabric stretch": self.fabric_on(level),
            "wire bending": bending,
            "wire stretch": stretch,
        }
        if self.bonded:
            stiffness = _BOND * max(w.beta for w in self.wires)
            families["bonds"] = bond_energy(mesh, stiffness, self.loose)
        if self.levelling > 0:
            families[LEVELLING_TERM] = levelling_energy(mesh, self.levelling)
        if self.alpha > 0:
            families["fabric bending"] = star_bending(mesh, self.alpha)
        families["wire twist"] = twist_energies(mesh, self.wires)
        return families

    def softened(self, axial_stiffness: float) -> MeshProblem:
        """Give the same with wires no stiffer than that against stretch."""
        soft = tuple(
            replace(wire, axial_stiffness=min(wire.axial_stiffness, axial_stiffness))
            for wire in self.wires
        )
        return replace(self, wires=soft)


def _refined(coarsest: Mesh, times: int) -> tuple[Mesh, ...]:
    if not 0 <= times <= LARGEST_REFINEMENT:
        raise SceneError(f"refinement = {times}: must be from 0 to {LARGEST_REFINEMENT}")
    meshes = refinements(coarsest, times)
    if (meshes[-1].areas <= 0).any():
        raise SceneError("wires come too near each other for so fine a mesh: refine less")
    return meshes


def loop_problem(
    scene: LoopScene, refinement: int, *, tension_field: bool = False, segments: int = SEGMENTS
) -> MeshProblem:
    """One loop on a fan of so many triangles, refined so many times."""
    return MeshProblem(
        meshes=_refined(loop_fan(scene.axis_ratio, segments), refinement),
        strain=scene.strain,
        fabric=scene_membrane(scene).stiffness,
        wires=(loop_wire(scene),),
        bonded=False,
        tension_field=tension_field,
        alpha=scene.alpha,
    )


def array_problem(
    scene: ArrayScene, refinement: int, *, tension_field: bool = False, segments: int = SEGMENTS
) -> MeshProblem:
    """A grid of loops, each on a fan of so many triangles, refined so many times."""
    coarsest = array_fan(scene.grid, scene.between, scene.loop.axis_ratio, segments)
    bonded = scene.contact is Contact.BONDED and scene.rows * scene.columns > 1
    hinged = _hinged(coarsest, len(grid_knots(scene.grid, scene.loop.axis_ratio)))
    return MeshProblem(
        meshes=_refined(coarsest, refinement),
        strain=scene.loop.strain,
        fabric=scene_membrane(scene.loop).stiffness,
        wires=scene.stiffness,
        bonded=bonded,
        tension_field=tension_field,
        levelling=_LEVELLING if hinged else 0.0,
        alpha=scene.loop.alpha,
    )


def sheet_problem(
    scene: SheetScene, refinement: int, segments: int, *, tension_field: bool = False
) -> MeshProblem:
    """Any plane scene whose unit is the size of its loops, refined so many times."""
    if not FEWEST_SEGMENTS <= segments <= MOST_SEGMENTS:
        raise SceneError(
            f"segments = {segments}: must be from {FEWEST_SEGMENTS} to {MOST_SEGMENTS}"
        )
    meshes = _refined(plane_mesh(scene.drawing, scene.regions, segments), refinement)
    bonded = {joint.contact is Contact.BONDED for joint in scene.joints}
    # vertices of the joints come first, in their order
    loose = [k for k, joint in enumerate(scene.joints) if joint.contact is Contact.POINT]
    hinged = _hinged(meshes[0], len(scene.joints))
    return MeshProblem(
        meshes=meshes,
        strain=scene.loop.strain,
        fabric=scene_membrane(scene.loop).stiffness,
        wires=scene.stiffness,
        bonded=True in bonded,
        tension_field=tension_field,
        loose=frozenset(loose),
        levelling=_LEVELLING if hinged else 0.0,
        alpha=scene.loop.alpha,
    )


def _hinged(mesh: Mesh, joints: int) -> bool:
    """Whether parts of a scene hang together by its joints alone."""
    sides = [mesh.triangles[:, [0, 1]], mesh.triangles[:, [1, 2]]]
    edges = np.concatenate([*sides, *(wire.edges for wire in mesh.wires)])
    held = edges[(edges >= joints).all(axis=1)]
    count = len(mesh.points)
    graph = coo_array((np.ones(len(held)), held.T), shape=(count, count))
    parts = connected_components(graph, directed=False)[1]
    return len(np.unique(parts[joints:])) > 1
