"""Solve a scene on a mesh, from coarse to fine."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from solver.errors import SceneError
from solver.flat import flat_radius
from solver.mesh.account import account
from solver.mesh.array_mesh import Grid
from solver.mesh.descent import Solved, among_all, descend, from_start, roughly_solved
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.flatness import all_but_stable_flat, settled_flat
from solver.mesh.growth import solved_by_growth
from solver.mesh.loop_mesh import SEGMENTS
from solver.mesh.lower_saddle import rough_saddles
from solver.mesh.problem import MeshProblem, array_problem, loop_problem
from solver.mesh.scene import ArrayScene
from solver.mesh.solve_sheet import descended, free_motions, stiffened
from solver.mesh.start import array_start, loop_start
from solver.mesh.tile import solved_by_tile, tile_of
from solver.mesh.triangulation import prolonged
from solver.scene import LoopScene

Vectors = NDArray[np.float64]

_ROUGHLY = 1e-3
_LESS_ROUGHLY = 1e-5
"""Part of the energy that the rough shape may lack."""
_COARSEST_LOOP = 1
_COARSEST_ARRAY = 0
"""Refinements of the meshes on which a solve begins."""


def _check_start(problem: MeshProblem, start: Vectors) -> None:
    expected = (len(problem.meshes[-1].points), 3)
    if start.shape != expected or not np.isfinite(start).all():
        raise SceneError(f"start: must be finite positions of shape {expected}")


def solve_loop_mesh(
    scene: LoopScene,
    *,
    refinement: int = 3,
    segments: int = SEGMENTS,
    start: Vectors | None = None,
    backend: str | None = None,
    most_steps: int = 500,
    tension_field: bool = False,
    allow_unreliable: bool = False,
) -> MeshEquilibrium:
    """Find a minimum of one loop's energy on a fan of triangles split in 4 so many times.

    Parameters
    ----------
    refinement : int
        0 to 7; the error falls by 4 with each.
    segments : int
        Triangles of the fan, and the wire's edges round it, before they are split: a multiple of 4.
    start : array (n, 3), optional
        Positions of the finest mesh's vertices near the minimum, such as those of a neighbouring
        scene; by default the solve begins on a coarse mesh, near the flat state.
    backend : str, optional
        One of `solver.mesh.factorization.BACKENDS`; by default the fastest that is there.
    most_steps : int
        On each mesh.
    tension_field : bool
        Let the fabric wrinkle instead of bearing compression; see `solver.mesh.tension_field`.
    allow_unreliable : bool
        Give the shape, with a ``status`` that says what is wrong, where this would raise.

    Raises
    ------
    NotConvergedError
        When no minimum is reached.
    SceneError
        When the refinement is out of range.
    """
    problem = loop_problem(scene, refinement, tension_field=tension_field, segments=segments)
    if start is not None:
        _check_start(problem, start)
        solved = descend(problem, refinement, start, backend, most_steps)
    else:
        solved = _loop_from_flat(scene, problem, backend, most_steps)
    return account(scene, problem, solved, lenient=allow_unreliable)


def _loop_from_flat(
    scene: LoopScene, problem: MeshProblem, backend: str | None, most_steps: int
) -> list[Solved]:
    first = min(_COARSEST_LOOP, len(problem.meshes) - 1)
    radius = flat_radius(scene)
    if scene.twist_ratio > 0 and not scene.isotropic_circle:
        rough = rough_saddles(problem, first, radius, backend, _ROUGHLY)
        return [*rough, *descend(problem, first, rough[-1].minimum.positions, backend, most_steps)]
    lifted = loop_start(problem.energy(first), problem.meshes[first], radius)
    solved: list[Solved] = []
    if scene.isotropic_circle:  # its crests lie on a mirror plane; an ellipse's do not
        mirrored = replace(problem, mirrored=True)
        solved = from_start(mirrored, lifted, _ROUGHLY, backend, most_steps, first=first)
        solved.append(among_all(problem, solved[-1], backend, most_steps))
        if solved[-1].minimum.converged:
            return solved
    return [*solved, *from_start(problem, lifted, _ROUGHLY, backend, most_steps, first=first)]


def _grows(scene: ArrayScene) -> bool:
    """Whether a grid is alike in its middle, and buckles with crests along its rows."""
    loop = scene.equal_loop
    return scene.gaps_kept and loop is not None and loop.axis_ratio == 1


def _mirrored_problem(
    scene: ArrayScene, refinement: int, segments: int, tension_field: bool, grid: Grid
) -> MeshProblem:
    wires = scene.stiffness[:1] * (grid.rows * grid.columns)
    scene = replace(scene, rows=grid.rows, columns=grid.columns, wires=wires)
    problem = array_problem(scene, refinement, tension_field=tension_field, segments=segments)
    return replace(problem, mirrored=True)


def _levelled(problem: MeshProblem, backend: str | None, most_steps: int) -> list[Solved]:
    """Minimise from coarse to fine, all but the last mesh to the end too.

    Hinges are so soft that the height of a coarser mesh would be open else.
    """
    meshes, first = problem.meshes, array_start(problem.meshes[0])
    rough = roughly_solved(problem, 0, first, backend, _LESS_ROUGHLY)
    coarse = replace(problem, meshes=meshes[:-1] or meshes)
    solved = [rough, *descended(coarse, rough, backend, most_steps)]
    if len(meshes) > 1:
        start = prolonged(meshes[-2], meshes[-1], solved[-1].minimum.positions)
        solved += descend(problem, len(meshes) - 1, start, backend, most_steps)
    if solved[-1].minimum.converged:
        return solved
    return [*solved, *stiffened(problem, solved[-1].minimum.positions, backend, most_steps)]


def _buckled(
    scene: ArrayScene, problem: MeshProblem, segments: int, backend: str | None, most_steps: int
) -> list[Solved]:
    refinement = len(problem.meshes) - 1
    tile = tile_of(scene)
    if tile is not None:
        return solved_by_tile(problem, tile, segments, backend, most_steps)
    if _grows(scene):
        grown = partial(_mirrored_problem, scene, refinement, segments, problem.tension_field)
        return solved_by_growth(problem, scene.grid, grown, backend, most_steps)
    if problem.levelling > 0:
        return _levelled(problem, backend, most_steps)
    flat = array_start(problem.meshes[_COARSEST_ARRAY])
    return from_start(problem, flat, _LESS_ROUGHLY, backend, most_steps, first=_COARSEST_ARRAY)


def solve_array(
    scene: ArrayScene,
    *,
    refinement: int = 2,
    segments: int = SEGMENTS,
    start: Vectors | None = None,
    backend: str | None = None,
    most_steps: int = 500,
    tension_field: bool = False,
    allow_unreliable: bool = False,
) -> MeshEquilibrium:
    """Find a minimum of the energy of a grid of loops; see `solve_loop_mesh`.

    A grid whose gaps are cut has hinges that cost nothing: bonded pairs turn about their common
    tangent. Of the shapes that differ by them it is one near the plane: the term ``levelling``, of
    1e-4 E_f t, draws all to it, and motions that are free without it are counted.
    """
    problem = array_problem(scene, refinement, tension_field=tension_field, segments=segments)
    if start is not None:
        _check_start(problem, start)
        solved = descend(problem, len(problem.meshes) - 1, start, backend, most_steps)
    else:
        radius = flat_radius(scene.equal_loop or scene.loop)
        flat = all_but_stable_flat(problem, radius, backend, most_steps)
        solved = [] if flat is None else descend(problem, 0, flat, backend, most_steps)
        # a flat shape that is exactly symmetric may hide its way down
        if not solved or solved[-1].minimum.negative:
            solved += _buckled(scene, problem, segments, backend, most_steps)
        solved = settled_flat(problem, solved, radius, backend, most_steps)
    found = account(scene, problem, solved, lenient=allow_unreliable)
    if problem.levelling == 0:
        return found
    return replace(found, free_motions=free_motions(solved[-1], problem))
