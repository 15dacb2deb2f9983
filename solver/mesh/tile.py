"""Grids whose gaps are cut, made of copies of one loop's saddle.

Saddles with their crests along x touch their copies crest to crest and valley to valley, where
tangents are parallel: they fit together at no cost. So do those on orthotropic fabric, whose axes
are the grid's; an ellipse's lowest saddle has its crests between the grid's axes, and does not.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from solver.mesh.descent import Solved, descend, gradient_limit, roughly_solved, solved_on
from solver.mesh.problem import MeshProblem, loop_problem
from solver.mesh.scene import ArrayScene
from solver.mesh.search import SearchLimits
from solver.mesh.start import lifted, tiled_start
from solver.scene import LoopScene

Vectors = NDArray[np.float64]

_ROUGHLY = 1e-3
_FEW_STEPS = 50
"""From tiles that lie at rest: more are spent where they are not the lowest way to lie."""
_NOISE = 1e-3
_LITTLE_TO_TURN = 1e-7
"""Part of the energy that a turn in the fabric may still gain: meshes themselves prefer some
directions, by more."""


def tile_of(scene: ArrayScene) -> LoopScene | None:
    """Give the loop whose copies fit together to an array, if they do."""
    loop = None if scene.gaps_kept else scene.equal_loop
    return loop if loop is not None and loop.axis_ratio == 1 else None


def solved_by_tile(
    problem: MeshProblem,
    loop: LoopScene,
    segments: int,
    backend: str | None,
    most_steps: int,
) -> list[Solved]:
    """Minima on the way to one of a grid of such loops, which is the last.

    The loop is solved between its mirror planes, where its saddle cannot turn in the fabric: that
    it does all but freely. Only the last minimum is one among all shapes.
    """
    finest = len(problem.meshes) - 1
    alone = loop_problem(loop, finest, tension_field=problem.tension_field, segments=segments)
    alone = replace(alone, mirrored=True)
    rough = roughly_solved(alone, 0, lifted(alone.meshes[0]), backend, _ROUGHLY)
    tiles = descend(alone, 0, rough.minimum.positions, backend, most_steps)
    tiled = [
        tiled_start(mesh, own, tile.minimum.positions)
        for mesh, own, tile in zip(problem.meshes, alone.meshes, tiles, strict=True)
    ]
    solved = [rough, *tiles]
    if finest > 0:
        coarser = tiles[-2]
        still = replace(coarser.minimum, positions=tiled[-2], steps=0, factorizations=0)
        solved.append(replace(coarser, minimum=still))
    solved += descend(problem, finest, tiled[-1], backend, min(most_steps, _FEW_STEPS))
    minimum = solved[-1].minimum
    if minimum.converged and not minimum.negative:
        return solved
    # on a coarse mesh another way to lie in the fabric may cost less; exact symmetry hides that
    noise = _NOISE * np.random.default_rng(0).normal(size=minimum.positions.shape)
    limits = SearchLimits(
        gradient=gradient_limit(problem), steps=most_steps, steady=True, little=_LITTLE_TO_TURN
    )
    return [*solved, solved_on(problem, finest, tiled[-1] + noise, backend, limits)]
