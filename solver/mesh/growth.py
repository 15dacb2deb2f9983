"""Solve a grid from a smaller one, which is solved from a smaller one, and so on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from solver.mesh.array_mesh import Grid
from solver.mesh.descent import Solved, among_all, descend, from_start, nearly_solved
from solver.mesh.grown_start import grown_start, smaller
from solver.mesh.problem import MeshProblem
from solver.mesh.start import array_start

_ROUGHLY = 1e-5
"""Part of the energy that the first rough shape may lack."""


@dataclass(frozen=True)
class _Grown:
    """A grid's minima, in the order in which they were found, and those on its last two meshes."""

    grid: Grid
    problem: MeshProblem
    solved: list[Solved]
    last: dict[int, Solved]


def _grown(
    grid: Grid,
    problem_of: Callable[[Grid], MeshProblem],
    backend: str | None,
    most_steps: int,
) -> _Grown:
    problem = problem_of(grid)
    finest = len(problem.meshes) - 1
    levels = range(max(0, finest - 1), finest + 1)
    if smaller(grid) == grid:
        flat = array_start(problem.meshes[0])
        solved = from_start(problem, flat, _ROUGHLY, backend, most_steps)
        sizes = {len(problem.meshes[level].points): level for level in levels}
        last = {sizes[n]: s for s in solved if (n := len(s.minimum.positions)) in sizes}
        return _Grown(grid, problem, solved, last)
    small = _grown(smaller(grid), problem_of, backend, most_steps)
    solved, last = list(small.solved), dict[int, Solved]()
    for level in levels:
        before = small.last[level].minimum.positions
        meshes = small.problem.meshes[level], problem.meshes[level]
        start = grown_start(meshes[0], small.grid, before, meshes[1], grid)
        if level < finest:
            found = nearly_solved(problem, level, start, backend)
        else:
            found = descend(problem, level, start, backend, most_steps)[-1]
        solved.append(found)
        last[level] = found
    return _Grown(grid, problem, solved, last)


def solved_by_growth(
    problem: MeshProblem,
    grid: Grid,
    problem_of: Callable[[Grid], MeshProblem],
    backend: str | None,
    most_steps: int,
) -> list[Solved]:
    """Minima on the way to one on a grid's finest mesh, which is the last.

    Parameters
    ----------
    problem_of : callable
        Problem of a smaller grid with as many meshes. Where it is mirrored only the last minimum
        is one among all shapes.
    """
    grown = _grown(grid, problem_of, backend, most_steps)
    mirrored = grown.last[len(problem.meshes) - 1]
    return [*grown.solved, among_all(problem, mirrored, backend, most_steps)]
