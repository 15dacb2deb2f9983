"""What a solve on meshes has to say of itself."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from solver.errors import NotConvergedError
from solver.mesh.descent import Solved, mass_of
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.factorization import Factored
from solver.mesh.krylov import symmetric_product
from solver.mesh.measures import loop_heights, total_height
from solver.mesh.problem import MeshProblem
from solver.mesh.refusal import fault
from solver.mesh.rigid import lowest_eigenvalue, turn_of_fabric
from solver.mesh.scene import ArrayScene
from solver.mesh.sheet import SheetScene
from solver.mesh.triangulation import Mesh
from solver.mesh.wire_twist import twist_energies, twist_strays
from solver.scene import LoopScene

Vectors = NDArray[np.float64]

_LENT = (0.03, 0.3, 3.0, 30.0, 300.0)
"""Stiffness, in units of E_f t."""


def account(
    scene: LoopScene | ArrayScene | SheetScene,
    problem: MeshProblem,
    solved: list[Solved],
    *,
    lenient: bool,
) -> MeshEquilibrium:
    """Look at the last of a sequence of minima, the first of which may be a rough one."""
    last = solved[-1]
    mesh, positions = problem.meshes[-1], last.minimum.positions
    fabric = problem.fabric_on(len(problem.meshes) - 1)
    corners = positions[fabric.vertices]
    bare = len(corners) == 0
    compressed = 0.0 if bare else float(np.mean(fabric.compressed(corners)))
    status = fault(problem, last, slack=compressed > 0)
    if twist_strays(twist_energies(mesh, problem.wires), positions):
        status = (
            "the wire's twist is wrong: a loop has turned inside out; raise beta or lower strain"
        )
    if not (status == "converged" or lenient):
        raise NotConvergedError(status)
    energy = last.energy
    before = problem.meshes[max(0, len(problem.meshes) - 2)]
    coarser = _last_on(before, solved)
    return MeshEquilibrium(
        scene=scene,
        mesh=mesh,
        positions=positions,
        status=status,
        energy_terms=energy.terms(positions),
        gradient_norm=last.minimum.gradient_norm,
        lowest_eigenvalue=_lowest_eigenvalue(scene, last, mesh),
        negative_eigenvalues=last.minimum.negative,
        way_down=last.minimum.way_down,
        steps=sum(s.minimum.steps for s in solved),
        factorizations=sum(s.minimum.factorizations for s in solved),
        work=sum(s.minimum.steps * s.energy.pattern.size // 3 for s in solved),
        height=total_height(positions, mesh.wires),
        loop_heights=loop_heights(positions, mesh.wires),
        coarser_height=math.nan if coarser is None else total_height(coarser, before.wires),
        coarser_loop_heights=loop_heights(positions if coarser is None else coarser, before.wires),
        smallest_stress=0.0 if bare else float(fabric.smallest_stress(corners).min()),
        compressed_fraction=compressed,
        tension_field=problem.tension_field,
    )


def _lowest_eigenvalue(
    scene: LoopScene | ArrayScene | SheetScene, solved: Solved, mesh: Mesh
) -> float:
    minimum, mass = solved.minimum, mass_of(mesh)
    hessian = symmetric_product(solved.energy.pattern, minimum.entries)
    if minimum.converged and minimum.negative:
        factored = _positive(solved, mass)
        return lowest_eigenvalue(hessian, factored, minimum.positions, mass)
    alone = isinstance(scene, LoopScene) and scene.isotropic_circle
    free = turn_of_fabric(mesh, minimum.positions) if alone else None
    # the last matrix that a converged minimisation factorised is that of the minimum
    return lowest_eigenvalue(hessian, minimum.factored, minimum.positions, mass, free)


def _positive(solved: Solved, mass: Vectors) -> Factored:
    """Factors of the Hessian with as much stiffness lent as leaves no negative eigenvalue.

    Inverse iteration finds the eigenvalue next to 0; the lowest only where none is below.
    """
    for lent in _LENT:
        entries = solved.minimum.entries.copy()
        entries[solved.energy.pattern.diagonal] += lent * np.repeat(mass, 3)
        factored = solved.factoriser.factorise(entries)
        if factored.negative == 0:
            return factored
    return solved.factoriser.factorise(solved.minimum.entries)


def _last_on(mesh: Mesh, solved: list[Solved]) -> Vectors | None:
    """Positions of the last minimum on a mesh before the end, if there is one."""
    on = [s.minimum for s in solved[:-1] if len(s.minimum.positions) == len(mesh.points)]
    return on[-1].positions if on else None
