"""What a solve on meshes has to say of itself."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from solver.errors import NotConvergedError
from solver.mesh.descent import Solved, mass_of
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.krylov import symmetric_product
from solver.mesh.measures import loop_heights, total_height
from solver.mesh.problem import MeshProblem
from solver.mesh.rigid import lowest_eigenvalue
from solver.mesh.scene import ArrayScene
from solver.mesh.search import SparseMinimum
from solver.mesh.sheet import SheetScene
from solver.mesh.triangulation import Mesh
from solver.mesh.wire_twist import twist_energies, twist_strays
from solver.scene import LoopScene

Vectors = NDArray[np.float64]


def _fault(minimum: SparseMinimum) -> str:
    if minimum.converged:
        return "converged"
    saddle = f" with {minimum.negative} negative eigenvalues" if minimum.negative else ""
    return (
        f"not converged: gradient {minimum.gradient_norm:.1e}{saddle} after {minimum.steps} steps "
        "on the finest mesh; where fabric goes slack a mesh wrinkles at its own scale: "
        "take the tension field, refine less, raise beta or lower strain"
    )


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
    status = _fault(last.minimum)
    if twist_strays(twist_energies(mesh, problem.wires), positions):
        status = "the wire's twist is wrong: a loop has turned inside out; raise beta, lower strain"
    if not (status == "converged" or lenient):
        raise NotConvergedError(status)
    energy = last.energy
    fabric = problem.fabric_on(len(problem.meshes) - 1)
    corners = positions[fabric.vertices]
    bare = len(corners) == 0
    before = problem.meshes[max(0, len(problem.meshes) - 2)]
    coarser = _last_on(before, solved)
    return MeshEquilibrium(
        scene=scene,
        mesh=mesh,
        positions=positions,
        status=status,
        energy_terms=energy.terms(positions),
        gradient_norm=last.minimum.gradient_norm,
        lowest_eigenvalue=_lowest_eigenvalue(last, mesh),
        steps=sum(s.minimum.steps for s in solved),
        factorizations=sum(s.minimum.factorizations for s in solved),
        work=sum(s.minimum.steps * len(s.minimum.positions) for s in solved),
        height=total_height(positions, mesh.wires),
        loop_heights=loop_heights(positions, mesh.wires),
        coarser_height=math.nan if coarser is None else total_height(coarser, before.wires),
        coarser_loop_heights=loop_heights(positions if coarser is None else coarser, before.wires),
        smallest_stress=0.0 if bare else float(fabric.smallest_stress(corners).min()),
        compressed_fraction=0.0 if bare else float(np.mean(fabric.compressed(corners))),
        tension_field=problem.tension_field,
    )


def _lowest_eigenvalue(solved: Solved, mesh: Mesh) -> float:
    minimum = solved.minimum
    hessian = symmetric_product(solved.energy.pattern, minimum.entries)
    # the last matrix that a converged minimisation factorised is that of the minimum
    return lowest_eigenvalue(hessian, minimum.factored, minimum.positions, mass_of(mesh))


def _last_on(mesh: Mesh, solved: list[Solved]) -> Vectors | None:
    """Positions of the last minimum on a mesh before the end, if there is one."""
    on = [s.minimum for s in solved[:-1] if len(s.minimum.positions) == len(mesh.points)]
    return on[-1].positions if on else None
