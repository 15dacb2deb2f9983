"""The last rung: any scene, on a mesh that is refined until the tolerance is met."""

from __future__ import annotations

from functools import partial
from typing import Protocol

from solver.errors import NotConvergedError
from solver.ladder.answer import Answer, Rung
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.omissions import mesh_omissions, wrinkles_escape
from solver.mesh.scene import ArrayScene
from solver.mesh.solve import solve_array, solve_loop_mesh
from solver.scene import LoopScene

FINEST_LOOP = 5
FINEST_ARRAY = 3
FINEST_SLACK = 3
"""Finer meshes of wrinkled fabric take hundreds of steps; what they would change is told."""

_SHARES_OF_ERROR = 3.0
"""A second-order error is a third of its change from the mesh with edges twice as long."""


class _Solve(Protocol):
    """Solve on a mesh so fine, with or without the tension field."""

    def __call__(self, refinement: int, *, field: bool, lenient: bool) -> MeshEquilibrium: ...


def by_loop_mesh(scene: LoopScene, reason: str, tolerance: float, *, lenient: bool) -> Answer:
    """Refine until a third of the last change in height is the error allowed."""
    solve = partial(_loop, scene)
    found = _refined(solve, range(2, FINEST_LOOP + 1), scene, tolerance, lenient=lenient)
    return _mesh_answer(found, reason, tolerance, lenient=lenient)


def by_array_mesh(scene: ArrayScene, reason: str, tolerance: float, *, lenient: bool) -> Answer:
    """Solve all loops together, on finer and finer meshes."""
    solve = partial(_array, scene)
    found = _refined(solve, range(1, FINEST_ARRAY + 1), scene.loop, tolerance, lenient=lenient)
    return _mesh_answer(found, reason, tolerance, lenient=lenient)


def _loop(scene: LoopScene, refinement: int, *, field: bool, lenient: bool) -> MeshEquilibrium:
    return solve_loop_mesh(
        scene, refinement=refinement, tension_field=field, allow_unreliable=lenient
    )


def _array(scene: ArrayScene, refinement: int, *, field: bool, lenient: bool) -> MeshEquilibrium:
    return solve_array(scene, refinement=refinement, tension_field=field, allow_unreliable=lenient)


def _refined(
    solve: _Solve, refinements: range, loop: LoopScene, tolerance: float, *, lenient: bool
) -> MeshEquilibrium:
    """Solve on finer and finer meshes; from where plain fabric goes slack, with a tension field."""
    knows_field = loop.modulus_ratio == 1
    field = False
    found = None
    for refinement in refinements:
        if not field:
            # a plain solve that fails may be one that wrinkles: the tension field has its turn
            found = solve(refinement, field=False, lenient=lenient or knows_field)
            slack = loop.strain > 0 and wrinkles_escape(found)
            field = knows_field and (slack or found.status != "converged")
        if field:
            found = solve(refinement, field=True, lenient=lenient)
        first_of_array = refinement == 1
        if found is not None and not first_of_array and _mesh_error(found) <= tolerance:
            break
        if field and refinement >= FINEST_SLACK:
            break
    if found is None:
        raise NotConvergedError("no mesh to solve on")
    return found


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
