"""Solve a scene whose parts meet: follow it from a prestrain at which they do not.

A shape that already passes through itself could not be mended. So the solve begins at a smaller
prestrain, whose shape is found without contact and comes nowhere near itself, and raises the
prestrain from there, with barriers and with steps that pass through nothing.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from solver.errors import NotConvergedError
from solver.mesh.account import account
from solver.mesh.any_scene import (
    MeshScene,
    fabric_of,
    thickest_wire,
    wires_of,
    with_strain,
)
from solver.mesh.contact_energy import CONTACT_TERM, ContactEnergy, ContactFactoriser
from solver.mesh.descent import Solved, gradient_limit, mass_of
from solver.mesh.drawing import SEGMENTS
from solver.mesh.equilibrium import ContactAccount, MeshEquilibrium
from solver.mesh.newton_sparse import minimise_sparse
from solver.mesh.problem import MeshProblem, array_problem, loop_problem, sheet_problem
from solver.mesh.scene import ArrayScene
from solver.mesh.search import SearchLimits
from solver.mesh.self_contact import SelfContact
from solver.mesh.sheet import SheetScene
from solver.mesh.sheet_unit import in_unit_of
from solver.mesh.solve_any import solve_on_mesh
from solver.mesh.solve_sheet import free_motions
from solver.mesh.thickness import thickness_barriers
from solver.round_wire import solid_diameter
from solver.scene import LoopScene

Vectors = NDArray[np.float64]

_FREE_PARTS = (0.5, 0.25, 0.1, 0.03, 0.01, 0.0)
"""Of the prestrain: where to begin, the largest that will do."""
_FREE_PARTS_OF_MANY = (0.1, 0.03, 0.01, 0.0)
"""The same where loops act on each other and soon meet: what meets itself takes long to solve."""
_ROUNDING = 1e-9
_RAISES = 4
"""Steps from there to the whole prestrain."""
_STEPS_ON_THE_WAY = 100
"""Of each search before the last; where they end is no more than where the next begins."""
_ON_THE_WAY = SearchLimits(decrease=1e-4)


def _problem(scene: MeshScene, refinement: int, *, field: bool) -> MeshProblem:
    if isinstance(scene, SheetScene):
        return sheet_problem(scene, refinement, SEGMENTS, tension_field=field)
    if isinstance(scene, ArrayScene):
        return array_problem(scene, refinement, tension_field=field)
    return loop_problem(scene, refinement, tension_field=field)


def _energy(problem: MeshProblem, diameter: float, strain: float) -> ContactEnergy:
    last = len(problem.meshes) - 1
    barriers = thickness_barriers(problem.meshes[last], diameter, strain)
    return ContactEnergy(problem.energy(last), barriers)


def _free_parts(scene: MeshScene, largest: float) -> list[float]:
    """Parts of the prestrain at which to look for a shape that comes nowhere near itself."""
    parts = _FREE_PARTS if isinstance(scene, LoopScene) else _FREE_PARTS_OF_MANY
    return [part for part in parts if part <= largest]


class _Steps:
    """Steps on the finest mesh that are left; those on coarser ones count as their part of one."""

    def __init__(self, most: int, vertices: int) -> None:
        self._most, self._vertices = most, vertices
        self.work = 0

    def at_most(self, asked: int) -> int:
        """Give the steps of so many that are left.

        Raises
        ------
        NotConvergedError
            When none is.
        """
        left = self._most - self.work // self._vertices
        if left <= 0:
            raise NotConvergedError(
                f"contact: not at the whole prestrain after {self._most} steps on "
                f"{self._vertices} vertices, the most that it may take; raise beta or lower strain"
            )
        return min(asked, left)

    def spend(self, work: int) -> None:
        """Count steps times vertices."""
        self.work += work


def _free_shape(
    scene: MeshScene,
    energy: ContactEnergy,
    refinement: int,
    largest: float,
    steps: _Steps,
    *,
    field: bool,
) -> tuple[float, Vectors]:
    """Give a part of the prestrain at which the shape keeps its thickness, and its positions."""
    strain = fabric_of(scene).strain
    no_wire = _thicker_than_a_wire(scene)
    for part in [0.0] if no_wire else _free_parts(scene, largest):
        found = solve_on_mesh(
            with_strain(scene, part * strain),
            refinement,
            tension_field=field,
            allow_unreliable=True,
            most_steps=steps.at_most(_STEPS_ON_THE_WAY),
        )
        steps.spend(found.work)
        clear = math.isfinite(energy.value(found.positions))
        if clear and found.distances.crossings == 0:
            return part, found.positions
    remedy = no_wire or "lower beta or raise axial_stiffness"
    raise NotConvergedError(
        f"contact: a wire of diameter √(32 beta / axial_stiffness) = {thickest_wire(scene):.2g}, "
        f"over R, meets itself at every prestrain; {remedy}"
    )


def _thicker_than_a_wire(scene: MeshScene) -> str:
    """Say that a β and k are those of no wire, which cannot be bent into such a loop."""
    solid = max(solid_diameter(wire.beta, wire.axial_stiffness) for wire in wires_of(scene))
    if solid <= (1 + _ROUNDING) * thickest_wire(scene):
        return ""
    return (
        f"a solid wire with this beta and axial stiffness is {solid:.2g} R thick: "
        "lower beta or raise the axial stiffness"
    )


def _raised(
    energy: ContactEnergy,
    start: Vectors,
    mass: Vectors,
    limits: SearchLimits,
    backend: str | None,
) -> Solved:
    factoriser = ContactFactoriser(energy, backend)
    minimum = minimise_sparse(energy, start, mass, factoriser, limits)
    return Solved(energy, factoriser, minimum)


def _contact_account(
    energy: ContactEnergy, found: MeshEquilibrium, before: SelfContact | None, begun_at: float
) -> ContactAccount:
    forces = np.linalg.norm(energy.forces(found.positions), axis=1)
    return ContactAccount(
        wire_diameter=found.wire_diameter,
        before=before,
        touching=energy.touching(found.positions),
        largest_force=float(forces.max()),
        begun_at=begun_at,
        energy_share=found.energy_terms[CONTACT_TERM] / found.energy,
    )


def solve_in_contact(
    scene: MeshScene,
    *,
    refinement: int = 2,
    tension_field: bool = False,
    backend: str | None = None,
    most_steps: int = 1500,
    allow_unreliable: bool = False,
    before: SelfContact | None = None,
    largest_part: float = 1.0,
) -> MeshEquilibrium:
    """Find a minimum whose wires and fabric keep apart; see `solver.mesh.solve` for the options.

    Parameters
    ----------
    before : SelfContact, optional
        How near the shape comes to itself without contact, in the scene's unit, for the account.
    most_steps : int
        On all the way; a step on a coarser mesh counts as the vertices that it moves.
    largest_part : float
        Of the prestrain, at which to begin: a coarser mesh tells it in its account.

    Raises
    ------
    NotConvergedError
        When no minimum is reached.
    SceneError
        When the library for contact is not installed, or as `solve_loop_mesh` and `solve_array`.
    """
    asked = scene
    if isinstance(scene, SheetScene):
        scene = scene.in_units_of(scene.size)
    whole, diameter = fabric_of(scene).strain, thickest_wire(scene)
    problem = _problem(scene, refinement, field=tension_field)
    mass = mass_of(problem.meshes[-1])
    energy = _energy(problem, diameter, whole)
    left = _Steps(most_steps, len(problem.meshes[-1].points))
    part, positions = _free_shape(
        scene, energy, refinement, largest_part, left, field=tension_field
    )
    solved: list[Solved] = []
    for between in np.linspace(part * whole, whole, _RAISES + 1)[1:-1]:
        partial = _energy(replace(problem, strain=float(between)), diameter, whole)
        most = left.at_most(_STEPS_ON_THE_WAY)
        limits = replace(_ON_THE_WAY, steps=most, steady=tension_field)
        solved.append(_raised(partial, positions, mass, limits, backend))
        positions = solved[-1].minimum.positions
        left.spend(solved[-1].minimum.steps * len(positions))
    most = left.at_most(most_steps)
    limits = SearchLimits(gradient_limit(problem), steps=most, steady=tension_field)
    solved.append(_raised(energy, positions, mass, limits, backend))
    left.spend(solved[-1].minimum.steps * len(positions))
    found = account(scene, problem, solved[-1:], lenient=allow_unreliable)
    found = replace(
        found,
        steps=sum(s.minimum.steps for s in solved),
        factorizations=sum(s.minimum.factorizations for s in solved),
        work=left.work,
        contact=_contact_account(energy, found, before, part),
    )
    if not isinstance(asked, SheetScene):
        return found
    return in_unit_of(asked, replace(found, free_motions=free_motions(solved[-1], problem)))
