"""A scene on its sequence of meshes: the energy on each, and where a solve begins."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from solver.errors import SceneError
from solver.loop_energy import scene_membrane
from solver.mesh.array_mesh import array_fan
from solver.mesh.bonds import bond_energy
from solver.mesh.loop_mesh import loop_fan
from solver.mesh.mesh_energy import Family, MeshEnergy, mesh_energy
from solver.mesh.rod_energy import WireStiffness, rod_energies
from solver.mesh.scene import ArrayScene, Contact, loop_wire
from solver.mesh.star_bending import star_bending
from solver.mesh.triangle_energy import TriangleEnergy, triangle_energy
from solver.mesh.triangulation import Mesh, refinements
from solver.mesh.wire_twist import twist_energies
from solver.scene import LoopScene

Vectors = NDArray[np.float64]

LARGEST_REFINEMENT = 6
TENSION_FIELD_TERM = "fabric stretch (tension field)"
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
    alpha : float
        α of the fabric's bending.
    """

    meshes: tuple[Mesh, ...]
    strain: float
    fabric: Vectors
    wires: tuple[WireStiffness, ...]
    bonded: bool
    tension_field: bool = False
    alpha: float = 0.0

    def fabric_on(self, level: int) -> TriangleEnergy:
        """Fabric on one of the meshes."""
        return triangle_energy(
            self.meshes[level], self.strain, self.fabric, tension_field=self.tension_field
        )

    def energy(self, level: int) -> MeshEnergy:
        """Energy on one of the meshes."""
        mesh = self.meshes[level]
        bending, stretch = rod_energies(mesh, self.wires)
        families: dict[str, Family] = {
            TENSION_FIELD_TERM if self.tension_field else "fabric stretch": self.fabric_on(level),
            "wire bending": bending,
            "wire stretch": stretch,
        }
        if self.bonded:
            families["bonds"] = bond_energy(mesh, _BOND * max(w.beta for w in self.wires))
        if self.alpha > 0:
            families["fabric bending"] = star_bending(mesh, self.alpha)
        families["wire twist"] = twist_energies(mesh, self.wires)
        return mesh_energy(families, len(mesh.points))

    def softened(self, axial_stiffness: float) -> MeshProblem:
        """Give the same with wires no stiffer than that against stretch."""
        soft = tuple(
            replace(wire, axial_stiffness=min(wire.axial_stiffness, axial_stiffness))
            for wire in self.wires
        )
        return replace(self, wires=soft)


def _check_refinement(times: int) -> None:
    if not 0 <= times <= LARGEST_REFINEMENT:
        raise SceneError(f"refinement = {times}: must be from 0 to {LARGEST_REFINEMENT}")


def loop_problem(scene: LoopScene, refinement: int, *, tension_field: bool = False) -> MeshProblem:
    """One loop on a fan of 20 triangles, refined so many times."""
    _check_refinement(refinement)
    return MeshProblem(
        meshes=refinements(loop_fan(scene.axis_ratio), refinement),
        strain=scene.strain,
        fabric=scene_membrane(scene).stiffness,
        wires=(loop_wire(scene),),
        bonded=False,
        tension_field=tension_field,
        alpha=scene.alpha,
    )


def array_problem(
    scene: ArrayScene, refinement: int, *, tension_field: bool = False
) -> MeshProblem:
    """A grid of loops, each on a fan of 20 triangles, refined so many times."""
    _check_refinement(refinement)
    coarsest = array_fan(scene.grid, scene.between, scene.loop.axis_ratio)
    bonded = scene.contact is Contact.BONDED and scene.rows * scene.columns > 1
    return MeshProblem(
        meshes=refinements(coarsest, refinement),
        strain=scene.loop.strain,
        fabric=scene_membrane(scene.loop).stiffness,
        wires=scene.stiffness,
        bonded=bonded,
        tension_field=tension_field,
        alpha=scene.loop.alpha,
    )
