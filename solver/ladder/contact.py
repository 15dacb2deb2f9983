"""When the last rung adds contact, how much it can do, and what it says where it cannot."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from enum import StrEnum

import numpy as np

from solver.errors import NotConvergedError
from solver.ladder.budget import MOST_WORK, Budget
from solver.mesh.any_scene import MeshScene, fabric_of
from solver.mesh.array_mesh import array_fan
from solver.mesh.barrier import REMEDY, contact_available
from solver.mesh.contact_solve import solve_in_contact
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.scene import ArrayScene
from solver.mesh.sheet import SheetScene

MOST_IN_CONTACT = 1700
"""Triangles of the finest mesh that is solved with contact, of which a step takes many times
longer: at the least two meshes are, to tell the error."""
LARGEST_IN_CONTACT = 6000
"""Triangles of a mesh on which contact is not even begun."""
WITHOUT = "take the shape without contact (--contact off), which tells how often it crosses itself"

_MOST_STEPS = 1500
"""With contact on one mesh, where the budget allows as many."""
_SAMPLE = 2
"""Rows and columns, at most, of the array that tells whether a large one meets itself."""


class ContactChoice(StrEnum):
    """Whether a shape that meets itself is solved with contact, or given as it is."""

    AUTO = "auto"
    OFF = "off"


class InContact:
    """Solves again, with contact, what meets itself; from then on every mesh."""

    def __init__(self, scene: MeshScene, choice: ContactChoice, budget: Budget) -> None:
        self._scene = scene
        self._budget = budget
        self._wanted = choice is ContactChoice.AUTO
        self._last: MeshEquilibrium | None = None

    def solved(self, found: MeshEquilibrium, refinement: int, *, lenient: bool) -> MeshEquilibrium:
        """Give the shape as it is, or solved with contact where that is needed and can be had."""
        needed = self._wanted and (self._last is not None or found.meets_itself)
        small = len(found.mesh.triangles) <= LARGEST_IN_CONTACT
        if not (needed and small and contact_available()):
            return found
        try:
            solved = self._kept_apart(found, refinement, lenient=lenient)
        except NotConvergedError:
            if lenient:
                return found
            raise
        last = self._last
        self._last = replace(
            solved,
            coarser_height=math.nan if last is None else last.height,
            coarser_loop_heights=np.zeros(0) if last is None else last.loop_heights,
        )
        return self._last

    def _kept_apart(
        self, found: MeshEquilibrium, refinement: int, *, lenient: bool
    ) -> MeshEquilibrium:
        before = self._last.contact if self._last else None
        vertices, alpha = len(found.mesh.points), fabric_of(self._scene).alpha
        solved = solve_in_contact(
            self._scene,
            refinement=refinement,
            most_steps=self._budget.steps(_MOST_STEPS, vertices, alpha, contact=True),
            tension_field=found.tension_field,
            allow_unreliable=True,
            before=found.distances,
            largest_part=before.begun_at if before else 1.0,
        )
        self._budget.spend(solved.work, alpha, contact=True)
        if not (lenient or solved.status == "converged"):
            raise NotConvergedError(_unsettled(solved))
        return solved


def _unsettled(found: MeshEquilibrium) -> str:
    """Say what keeps a shape with contact from being an answer."""
    if not found.status.startswith("not converged"):
        return found.status
    vertices = len(found.mesh.points)
    return (
        f"contact: not settled after {found.work // vertices} steps on {vertices} vertices "
        f"(gradient {found.gradient_norm:.1e}), of {MOST_WORK} steps times vertices that one "
        f"answer may take; raise beta or lower strain, or {WITHOUT}"
    )


def finest_in_contact(found: MeshEquilibrium) -> bool:
    """Whether two meshes were solved with contact, and the next one would be too fine for it."""
    told = found.contact is not None and not math.isnan(found.coarser_height)
    return told and 4 * len(found.mesh.triangles) > MOST_IN_CONTACT


def contact_remedy(scene: MeshScene) -> str:
    """Say what helps a shape that meets itself and could not be solved with contact."""
    remedies = [
        f"contact is solved on up to {LARGEST_IN_CONTACT} triangles: solve fewer loops"
        if contact_available()
        else f"to add contact: {REMEDY}"
    ]
    if not isinstance(scene, SheetScene):
        remedies.append(WITHOUT)
    return ", or ".join(remedies)


def refuse_what_meets_itself(
    scene: MeshScene, refinement: int, solve: Callable[[ArrayScene, int], MeshEquilibrium]
) -> None:
    """Refuse early an array too large for contact if a corner of it already meets itself.

    Parameters
    ----------
    refinement : int
        Of the coarsest mesh that would be solved.
    solve : callable
        Gives an array's shape on a mesh refined so many times, without contact, whatever it is.

    Raises
    ------
    NotConvergedError
        With the number of triangles, and what helps.
    """
    if not isinstance(scene, ArrayScene) or (loop := scene.equal_loop) is None:
        return
    rows, columns = min(scene.rows, _SAMPLE), min(scene.columns, _SAMPLE)
    corner = replace(scene, loop=loop, rows=rows, columns=columns, wires=())
    coarsest = array_fan(scene.grid, scene.between, scene.loop.axis_ratio)
    triangles = len(coarsest.triangles) * 4**refinement
    if triangles <= LARGEST_IN_CONTACT:
        return
    if solve(corner, refinement).meets_itself:
        size = f"{scene.rows} × {scene.columns} loops have {triangles} triangles or more"
        raise NotConvergedError(
            f"{corner.rows} × {corner.columns} of these loops already meet, and {size}; "
            f"{contact_remedy(scene)}"
        )
