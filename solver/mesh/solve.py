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
from solver.mesh.descent import Solved, among_all, descend, roughly_solved
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.growth import solved_by_growth
from solver.mesh.loop_mesh import SEGMENTS
from solver.mesh.lower_saddle import rough_saddles
from solver.mesh.problem import MeshProblem, array_problem, loop_problem
from solver.mesh.scene import ArrayScene
from solver.mesh.start import aligned_saddle, array_start, loop_start, tiled_start
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
        solved = _descended(mirrored, first, lifted, backend, most_steps)
        solved.append(among_all(problem, solved[-1], backend, most_steps))
        if solved[-1].minimum.converged:
            return solved
    return [*solved, *_descended(problem, first, lifted, backend, most_steps)]


def _descended(
    problem: MeshProblem, first: int, start: Vectors, backend: str | None, most_steps: int
) -> list[Solved]:
    rough = roughly_solved(problem, first, start, backend, _ROUGHLY)
    return [rough, *descend(problem, first, rough.minimum.positions, backend, most_steps)]


def _tiles(scene: ArrayScene) -> bool:
    """Whether copies of one loop's saddle fit together."""
    return not scene.gaps_kept and scene.loop.isotropic_circle


def _repeats(scene: ArrayScene) -> bool:
    """Whether a grid is alike in its middle, and buckles with crests along its rows."""
    return scene.gaps_kept and scene.loop.isotropic_circle and not scene.wires


def _mirrored_problem(
    scene: ArrayScene, refinement: int, segments: int, tension_field: bool, grid: Grid
) -> MeshProblem:
    scene = replace(scene, rows=grid.rows, columns=grid.columns)
    problem = array_problem(scene, refinement, tension_field=tension_field, segments=segments)
    return replace(problem, mirrored=True)


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
    tangent. Of the shapes that differ by them it is the one in which the loops lie level.
    """
    problem = array_problem(scene, refinement, tension_field=tension_field, segments=segments)
    last = len(problem.meshes) - 1
    if start is not None:
        _check_start(problem, start)
        solved = descend(problem, last, start, backend, most_steps)
    elif _tiles(scene):
        loop = solve_loop_mesh(
            scene.loop,
            refinement=refinement,
            segments=segments,
            backend=backend,
            tension_field=tension_field,
        )
        tile = aligned_saddle(loop.mesh, loop.positions)
        tiles = tiled_start(problem.meshes[-1], loop.mesh, tile)
        solved = descend(problem, last, tiles, backend, most_steps)
        tiled = account(scene, problem, solved, lenient=allow_unreliable)
        # tiles that lie level are as high as one of them, on a coarser mesh too
        coarser = np.full_like(tiled.loop_heights, loop.coarser_height)
        return replace(tiled, coarser_height=loop.coarser_height, coarser_loop_heights=coarser)
    elif _repeats(scene):
        grown = partial(_mirrored_problem, scene, refinement, segments, tension_field)
        solved = solved_by_growth(problem, scene.grid, grown, backend, most_steps)
    else:
        first = _COARSEST_ARRAY
        flat = array_start(problem.meshes[first])
        rough = roughly_solved(problem, first, flat, backend, _LESS_ROUGHLY)
        solved = [rough, *descend(problem, first, rough.minimum.positions, backend, most_steps)]
    return account(scene, problem, solved, lenient=allow_unreliable)
