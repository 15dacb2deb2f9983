"""The last rung: any scene, on a mesh that is refined until the tolerance is met."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import Protocol

from solver.checks import CONTACT
from solver.errors import NotConvergedError
from solver.ladder.answer import Answer, Rung
from solver.mesh.any_scene import MeshScene, fabric_of
from solver.mesh.barrier import REMEDY, contact_available
from solver.mesh.contact_solve import solve_in_contact
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.omissions import mesh_omissions
from solver.mesh.scene import ArrayScene
from solver.mesh.sheet import SheetScene
from solver.mesh.solve import solve_array, solve_loop_mesh
from solver.mesh.solve_sheet import solve_sheet
from solver.mesh.thickness import REACH
from solver.scene import LoopScene

FINEST_LOOP = 5
FINEST_ARRAY = 3
FINEST_SLACK = 3
"""Finer meshes of wrinkled fabric take hundreds of steps; what they would change is told."""
MOST_IN_CONTACT = 1700
"""Triangles of the finest mesh that is solved with contact, of which a step takes many times
longer: at the least two meshes are, to tell the error."""
LARGEST_IN_CONTACT = 6000
"""Triangles of a mesh on which contact is not even begun."""

_SHARES_OF_ERROR = 3.0
"""A second-order error is a third of its change from the mesh with edges twice as long."""


class _Solve(Protocol):
    """Solve on a mesh so fine, with or without the tension field."""

    def __call__(self, refinement: int, *, field: bool, lenient: bool) -> MeshEquilibrium: ...


class _InContact:
    """Solves again, with contact, what meets itself; from then on every mesh."""

    def __init__(self, scene: MeshScene) -> None:
        self._scene = scene
        self._last: MeshEquilibrium | None = None

    def solved(self, found: MeshEquilibrium, refinement: int, *, lenient: bool) -> MeshEquilibrium:
        """Give the shape as it is, or solved with contact where that is needed and can be had."""
        needed = self._last is not None or found.meets_itself
        small = len(found.mesh.triangles) <= LARGEST_IN_CONTACT
        if not (needed and small and contact_available()):
            return found
        solved = solve_in_contact(
            self._scene,
            refinement=refinement,
            tension_field=found.tension_field,
            allow_unreliable=lenient,
            before=found.distances,
        )
        before = math.nan if self._last is None else self._last.height
        self._last = replace(solved, coarser_height=before)
        return self._last


def by_loop_mesh(scene: LoopScene, reason: str, tolerance: float, *, lenient: bool) -> Answer:
    """Refine until a third of the last change in height is the error allowed."""
    solve = partial(_loop, scene)
    found = _refined(solve, range(2, FINEST_LOOP + 1), scene, tolerance, lenient=lenient)
    return _mesh_answer(found, reason, tolerance, lenient=lenient)


def by_array_mesh(scene: ArrayScene, reason: str, tolerance: float, *, lenient: bool) -> Answer:
    """Solve all loops together, on finer and finer meshes."""
    solve = partial(_array, scene)
    found = _refined(solve, range(1, FINEST_ARRAY + 1), scene, tolerance, lenient=lenient)
    return _mesh_answer(found, reason, tolerance, lenient=lenient)


def by_sheet_mesh(scene: SheetScene, reason: str, tolerance: float, *, lenient: bool) -> Answer:
    """Solve any plane scene, on finer and finer meshes."""
    solve = partial(_sheet, scene)
    found = _refined(solve, range(1, FINEST_ARRAY + 1), scene, tolerance, lenient=lenient)
    return _mesh_answer(found, reason, tolerance, lenient=lenient)


def _loop(scene: LoopScene, refinement: int, *, field: bool, lenient: bool) -> MeshEquilibrium:
    return solve_loop_mesh(
        scene, refinement=refinement, tension_field=field, allow_unreliable=lenient
    )


def _array(scene: ArrayScene, refinement: int, *, field: bool, lenient: bool) -> MeshEquilibrium:
    return solve_array(scene, refinement=refinement, tension_field=field, allow_unreliable=lenient)


def _sheet(scene: SheetScene, refinement: int, *, field: bool, lenient: bool) -> MeshEquilibrium:
    return solve_sheet(scene, refinement=refinement, tension_field=field, allow_unreliable=lenient)


def _refined(
    solve: _Solve,
    refinements: range,
    scene: MeshScene,
    tolerance: float,
    *,
    lenient: bool,
) -> MeshEquilibrium:
    """Solve on finer and finer meshes; from where plain fabric goes slack, with a tension field."""
    loop = fabric_of(scene)
    knows_field = loop.modulus_ratio == 1
    contact = _InContact(scene)
    field = False
    found = None
    for refinement in refinements:
        if not field:
            # a plain solve that fails may be one that wrinkles: the tension field has its turn
            found = solve(refinement, field=False, lenient=lenient or knows_field)
            slack = found.smallest_stress < 0 < loop.strain
            field = knows_field and (slack or found.status != "converged")
        if field:
            # and so may one be that meets itself: contact has its turn
            found = solve(refinement, field=True, lenient=True)
        if found is not None:
            found = contact.solved(found, refinement, lenient=lenient)
            _check_converged(found, lenient=lenient)
        first_of_array = refinement == 1
        if found is not None and not first_of_array and _mesh_error(found) <= tolerance:
            break
        if field and refinement >= FINEST_SLACK:
            break
        if found is not None and _finest_in_contact(found):
            break
    if found is None:
        raise NotConvergedError("no mesh to solve on")
    return found


def _check_converged(found: MeshEquilibrium, *, lenient: bool) -> None:
    # what meets itself is refused for that, with what would mend it
    if not (lenient or found.status == "converged" or found.meets_itself):
        raise NotConvergedError(found.status)


def _finest_in_contact(found: MeshEquilibrium) -> bool:
    """Whether two meshes were solved with contact, and the next one would be too fine for it."""
    told = found.contact is not None and not math.isnan(found.coarser_height)
    return told and 4 * len(found.mesh.triangles) > MOST_IN_CONTACT


def _mesh_error(found: MeshEquilibrium) -> float:
    """Error of the height, relative to it; infinite when there is no other mesh to tell it."""
    if math.isnan(found.coarser_height):
        return math.inf
    change = abs(found.height - found.coarser_height) / _SHARES_OF_ERROR
    if found.contact is not None:  # parts keep no more apart than this beyond their thickness
        change = max(change, REACH * found.wire_diameter)
    return change / found.height if found.height > 1e-6 else change


def _contact_remedy() -> str:
    if not contact_available():
        return f"to add contact: {REMEDY}"
    return f"contact is solved on up to {LARGEST_IN_CONTACT} triangles: solve fewer loops"


def _mesh_answer(found: MeshEquilibrium, reason: str, tolerance: float, *, lenient: bool) -> Answer:
    omitted = mesh_omissions(found)
    error = _mesh_error(found)
    faults = [f"{o.term} is left out, and the shape is wrong without" for o in omitted if o.fatal]
    if any(o.fatal and o.term == CONTACT for o in omitted):
        faults.append(_contact_remedy())
    if found.contact is not None and found.distances.crossings:
        faults.append("the shape still passes through itself; raise beta or lower strain")
    if error > tolerance:
        faults.append(
            f"the finest mesh still errs by {error:.1e} in the height; allow a larger tolerance"
        )
    if faults and not lenient:
        raise NotConvergedError("; ".join(faults))
    if found.contact is not None:
        reason += "; the shape met itself: contact was added"
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
