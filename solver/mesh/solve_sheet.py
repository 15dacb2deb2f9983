"""Solve any plane scene on a mesh, from several starts and from coarse to fine."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from solver.errors import SceneError
from solver.mesh.account import account
from solver.mesh.descent import Solved, descend, mass_of, roughly_solved, solved_on
from solver.mesh.drawing import SEGMENTS
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.problem import MeshProblem, sheet_problem
from solver.mesh.rigid import rigid_motions
from solver.mesh.search import SearchLimits
from solver.mesh.sheet import SheetScene
from solver.mesh.sheet_start import sheet_starts
from solver.mesh.sheet_unit import in_unit_of

Vectors = NDArray[np.float64]

LARGEST_FREE = 2e-3
"""Stiffness, in units of E_f t, below which a motion counts as free.

The slight pushes of a minimum found to within rounding may lend a hinge half of it.
"""

_ROUGHLY = 1e-5
_PRESSED = 1e-2
"""Levelling under which free hinges come to rest; it bends the loops themselves little."""
_MOST_STARTS = 20
_GRADES = (30.0, 100.0, 300.0)
"""Axial stiffness of the wires, step by step."""
_ALL_BUT_NOTHING = 1e-9
_PARTS_OF_STRAIN = (0.4, 0.7)
"""Through which the strain is raised where a solve at once does not settle."""


def solve_sheet(
    scene: SheetScene,
    *,
    refinement: int = 2,
    segments: int = SEGMENTS,
    starts: int = 3,
    backend: str | None = None,
    most_steps: int = 200,
    tension_field: bool = False,
    allow_unreliable: bool = False,
) -> MeshEquilibrium:
    """Find a minimum of the energy of any plane scene; see `solver.mesh.solve.solve_loop_mesh`.

    The solve itself is in units of the scene's ``size``, so that the unit of its numbers plays no
    part. Of several starts, solved roughly on the coarsest mesh, the lowest is carried on: loops
    that do not fit have more than one minimum, and a lower one than all that were tried may exist.

    Parts that hang together by joints alone are free to hinge. Of the shapes that differ by this
    one near the plane is taken: the term ``levelling``, of 1e-4 E_f t, draws all to it.

    Parameters
    ----------
    refinement : int
        0 to 7.
    segments : int
        Edges of a loop of mean size on the unrefined mesh, 12 to 80.
    starts : int
        1 to 20.

    Raises
    ------
    NotConvergedError
        When no minimum is reached.
    SceneError
        When the scene cannot be meshed, or a number is out of its range.
    """
    if not 1 <= starts <= _MOST_STARTS:
        raise SceneError(f"starts = {starts}: must be from 1 to {_MOST_STARTS}")
    natural = scene.in_units_of(scene.size)
    problem = sheet_problem(natural, refinement, segments, tension_field=tension_field)
    solved = _solved(natural, problem, starts, backend, most_steps)
    found = account(natural, problem, solved, lenient=allow_unreliable)
    found = replace(found, free_motions=free_motions(solved[-1], problem))
    return in_unit_of(scene, found)


def _solved(
    scene: SheetScene, problem: MeshProblem, starts: int, backend: str | None, most_steps: int
) -> list[Solved]:
    rough = [
        roughly_solved(problem, 0, start, backend, _ROUGHLY)
        for start in sheet_starts(scene, problem.meshes[0], starts)
    ]
    rough.sort(key=lambda one: one.minimum.value)
    solved = [*rough, *descended(problem, rough[0], backend, most_steps)]
    if solved[-1].minimum.converged:
        return solved
    solved += stiffened(problem, solved[-1].minimum.positions, backend, most_steps)
    if solved[-1].minimum.converged:
        return solved
    # little strain makes a smooth shape, which more of it bends further
    start = next(sheet_starts(scene, problem.meshes[0], 1))
    for part in _PARTS_OF_STRAIN:
        eased = replace(problem, strain=part * problem.strain)
        solved.append(roughly_solved(eased, 0, start, backend, _ROUGHLY))
        start = solved[-1].minimum.positions
    return [*solved, *descended(problem, solved[-1], backend, most_steps)]


def stiffened(
    problem: MeshProblem, start: Vectors, backend: str | None, most_steps: int
) -> list[Solved]:
    """Minimise on the finest mesh with wires that get stiffer step by step.

    A round loop's saddle turns in its fabric all but freely, along a valley that a stiff wire
    curves sharply: a softer one is followed to its end in fewer, longer steps.
    """
    last = len(problem.meshes) - 1
    solved: list[Solved] = []
    for stiffness in _GRADES:
        limits = SearchLimits(decrease=_ALL_BUT_NOTHING, steps=most_steps)
        soft = problem.softened(stiffness)
        solved.append(solved_on(soft, last, start, backend, limits))
        start = solved[-1].minimum.positions
    return [*solved, *descend(problem, last, start, backend, most_steps)]


def descended(
    problem: MeshProblem, rough: Solved, backend: str | None, most_steps: int
) -> list[Solved]:
    """Minimise from coarse to fine; first of all lay flat what hinges freely."""
    solved: list[Solved] = []
    start = rough.minimum.positions
    if problem.levelling > 0:
        pressed = replace(problem, meshes=problem.meshes[:1], levelling=_PRESSED)
        solved = descend(pressed, 0, start, backend, most_steps)
        start = solved[-1].minimum.positions
    return [*solved, *descend(problem, 0, start, backend, most_steps)]


def free_motions(solved: Solved, problem: MeshProblem) -> int:
    """Motions, beside rigid ones, softer than `LARGEST_FREE`: negative pivots of H − λ M."""
    mesh = problem.meshes[-1]
    mass = mass_of(mesh)
    entries = solved.minimum.entries.copy()
    entries[solved.energy.pattern.diagonal] -= LARGEST_FREE * np.repeat(mass, 3)
    rigid = rigid_motions(solved.minimum.positions, mass).shape[1]
    return max(0, solved.factoriser.factorise(entries).negative - rigid)
