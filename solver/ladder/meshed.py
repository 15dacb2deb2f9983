"""The last rung: any scene, on a mesh that is refined until the tolerance is met."""

from __future__ import annotations

from solver.errors import NotConvergedError
from solver.ladder.answer import Answer, Rung
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.omissions import mesh_omissions
from solver.mesh.scene import ArrayScene
from solver.mesh.solve import solve_array, solve_loop_mesh
from solver.scene import LoopScene

FINEST_LOOP = 5
FINEST_ARRAY = 3
_SHARES_OF_ERROR = 3.0
"""A second-order error is a third of its change from the mesh with edges twice as long."""


def by_loop_mesh(scene: LoopScene, reason: str, tolerance: float, *, lenient: bool) -> Answer:
    """Refine until half the last change in height, or less, is the error allowed."""
    found = None
    for refinement in range(2, FINEST_LOOP + 1):
        found = solve_loop_mesh(scene, refinement=refinement, allow_unreliable=lenient)
        if _mesh_error(found) <= tolerance:
            break
    if found is None:
        raise NotConvergedError("no mesh to solve on")
    return _mesh_answer(found, reason, tolerance, lenient=lenient)


def _mesh_error(found: MeshEquilibrium) -> float:
    change = abs(found.height - found.coarser_height) / _SHARES_OF_ERROR
    return change / found.height if found.height > 1e-6 else change


def _mesh_answer(found: MeshEquilibrium, reason: str, tolerance: float, *, lenient: bool) -> Answer:
    omitted = mesh_omissions(found)
    error = _mesh_error(found)
    faults = [f"{o.term} is left out, and the shape is wrong without" for o in omitted if o.fatal]
    if error > tolerance:
        faults.append(
            f"the finest mesh still errs by {error:.1e} in the height; allow a larger tolerance"
        )
    if faults and not lenient:
        raise NotConvergedError("; ".join(faults))
    return Answer(
        rung=Rung.MESH,
        reason=reason,
        buckled=found.height > 1e-6,
        height_over_perimeter=found.height_over_perimeter,
        height_error=error,
        terms=tuple(found.energy_terms),
        omitted=omitted,
        equilibrium=found,
    )


def by_array_mesh(scene: ArrayScene, reason: str, tolerance: float, *, lenient: bool) -> Answer:
    """Solve all loops together, on finer and finer meshes."""
    found = None
    for refinement in range(1, FINEST_ARRAY + 1):
        found = solve_array(scene, refinement=refinement, allow_unreliable=lenient)
        if refinement > 1 and _mesh_error(found) <= tolerance:
            break
    if found is None:
        raise NotConvergedError("no mesh to solve on")
    return _mesh_answer(found, reason, tolerance, lenient=lenient)
