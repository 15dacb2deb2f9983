"""Which of two saddles a solve goes on with.

An ellipse has a saddle along its axes and one between them, and the wire's twist may make either
the lower one. From a saddle that is no minimum the way to the other is long: along it the wire
keeps its length. So both are solved on the coarsest mesh.
"""

from __future__ import annotations

from solver.mesh.descent import Solved, nearly_solved, roughly_solved
from solver.mesh.problem import MeshProblem
from solver.mesh.start import loop_starts


def rough_saddles(
    problem: MeshProblem, level: int, radius: float, backend: str | None, decrease: float
) -> list[Solved]:
    """Solve roughly for each saddle into which one flat loop may buckle; the lowest comes last.

    Parameters
    ----------
    radius : float
        Factor by which the flat loop has contracted.
    decrease : float
        Part of the energy that a rough shape may lack.
    """
    starts = loop_starts(problem.energy(level), problem.meshes[level], radius)
    rough = [roughly_solved(problem, level, start, backend, decrease) for start in starts]
    if len(rough) == 1:
        return rough
    nearly = [nearly_solved(problem, level, one.minimum.positions, backend) for one in rough]
    return rough + sorted(nearly, key=lambda one: -one.minimum.value)
