"""Minimise on a sequence of meshes, from coarse to fine.

Most steps are spent on the coarsest mesh, first with a wire that may stretch a little: the curved
valley along which a stiff wire keeps its length takes many steps to follow. Each finer mesh starts
from the shape of the one before and takes a few.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from solver.mesh.factorization import Factoriser, factoriser
from solver.mesh.mesh_energy import Energy
from solver.mesh.mirror import mirrors
from solver.mesh.mirrored_energy import MirroredEnergy
from solver.mesh.newton_sparse import minimise_sparse
from solver.mesh.problem import MeshProblem
from solver.mesh.search import SearchLimits, SparseMinimum
from solver.mesh.triangulation import Mesh, prolonged

Vectors = NDArray[np.float64]

_SOFT_WIRE = 30.0
_NEARLY = 1e-6
"""Part of the energy that a coarse mesh's shape may lack: it is only where the next one starts."""
_MANY_WIRES = 9
_NEAR = 1e-2
"""Part of the energy that is left to gain when a finer mesh has lost its kinks."""
_SMALLEST_GRADIENT = 1e-8
_LIMP_FABRIC = 1e-3
"""α with which a finer mesh loses the kinks that linear interpolation leaves in it.

Fabric much stiffer would rather crush triangles than wait for that.
"""
_SMOOTHLY = 1e-5
_LITTLE_OF_MANY = 1e-8
"""Part of the energy that a way down may still gain where loops hinge: it takes little to lift
the whole much. A millionth left 3 % of the height of two by two loops open."""


@dataclass(frozen=True)
class Solved:
    """The minimum on one mesh, and what it was found with.

    Positions are those of all vertices, derivatives by what was free to move.
    """

    energy: Energy
    factoriser: Factoriser
    minimum: SparseMinimum


def mass_of(mesh: Mesh) -> Vectors:
    """Weight (n,) of each vertex in mean squares: its share of fabric over that of one loop."""
    return mesh.vertex_weights / np.pi


def solved_on(
    problem: MeshProblem, level: int, start: Vectors, backend: str | None, limits: SearchLimits
) -> Solved:
    """Minimise on one of the meshes, within limits."""
    mass = mass_of(problem.meshes[level])
    if not limits.steady:
        little = _LITTLE_OF_MANY if len(problem.wires) > 1 else limits.little
        limits = replace(limits, steady=problem.tension_field, little=little)
    planes = mirrors(problem.meshes[level]) if problem.mirrored else None
    if planes is not None:
        energy = problem.mirrored_energy(level, planes)
        return _solved_mirrored(energy, start, mass, backend, limits)
    energy = problem.energy(level)
    factors = factoriser(energy.pattern, backend)
    return Solved(energy, factors, minimise_sparse(energy, start, mass, factors, limits))


def _solved_mirrored(
    energy: MirroredEnergy, start: Vectors, mass: Vectors, backend: str | None, limits: SearchLimits
) -> Solved:
    planes = energy.mirrors
    factors = factoriser(energy.pattern, backend)
    few = planes.few(planes.settled(start))
    found = minimise_sparse(energy, few, planes.sums(mass), factors, limits)
    return Solved(energy, factors, replace(found, positions=planes.all(found.positions)))


def roughly_solved(
    problem: MeshProblem, level: int, start: Vectors, backend: str | None, decrease: float
) -> Solved:
    """Minimise with a soft wire, until little is left to gain."""
    limits = SearchLimits(decrease=decrease)
    return solved_on(problem.softened(_SOFT_WIRE), level, start, backend, limits)


def gradient_limit(problem: MeshProblem) -> float:
    """Largest component of the gradient at what counts as a minimum.

    A smaller one could not be told from the rounding of the wires' stiff terms.
    """
    stiffest = max(max(100 * w.beta, w.axial_stiffness) for w in problem.wires)
    return max(_SMALLEST_GRADIENT, 1e-11 * stiffest)


def nearly_solved(problem: MeshProblem, level: int, start: Vectors, backend: str | None) -> Solved:
    """Minimise until next to nothing is left to gain; a saddle point may be such a shape."""
    return solved_on(problem, level, start, backend, SearchLimits(decrease=_NEARLY))


def _led_on(
    problem: MeshProblem, level: int, start: Vectors, backend: str | None, limits: SearchLimits
) -> list[Solved]:
    """Follow on a finer mesh, with wires that may stretch a little, the valleys of a large array.

    Finer meshes of many loops have softer motions, on which stiff wires spend many short steps.
    First those wires take out the kinks that interpolation leaves: softer ones would spread them.
    """
    smooth = solved_on(problem, level, start, backend, replace(limits, decrease=_NEAR))
    soft = roughly_solved(problem, level, smooth.minimum.positions, backend, _NEARLY)
    return [smooth, soft]


def descend(
    problem: MeshProblem, first: int, start: Vectors, backend: str | None, most_steps: int
) -> list[Solved]:
    """Minimise on one mesh after the other, from the one numbered ``first`` on."""
    limits = SearchLimits(gradient=gradient_limit(problem), steps=most_steps)
    meshes = problem.meshes
    found: list[Solved] = []
    for k in range(first, len(meshes)):
        if k > first:
            start = prolonged(meshes[k - 1], meshes[k], found[-1].minimum.positions)
            if len(problem.wires) >= _MANY_WIRES:
                found += _led_on(problem, k, start, backend, limits)
                start = found[-1].minimum.positions
            if problem.alpha > _LIMP_FABRIC:
                limp = replace(problem, alpha=_LIMP_FABRIC)
                found.append(
                    solved_on(limp, k, start, backend, replace(limits, decrease=_SMOOTHLY))
                )
                start = found[-1].minimum.positions
        finest = k == len(meshes) - 1
        asked = limits if finest else replace(limits, decrease=_NEARLY)
        found.append(solved_on(problem, k, start, backend, asked))
    return found


def from_start(
    problem: MeshProblem,
    start: Vectors,
    decrease: float,
    backend: str | None,
    most_steps: int,
    *,
    first: int = 0,
) -> list[Solved]:
    """Minimise roughly with a soft wire on the mesh numbered ``first``, then from there on."""
    rough = roughly_solved(problem, first, start, backend, decrease)
    return [rough, *descend(problem, first, rough.minimum.positions, backend, most_steps)]


def among_all(problem: MeshProblem, found: Solved, backend: str | None, most_steps: int) -> Solved:
    """Go on, among all shapes, from a minimum on the finest mesh among mirrored ones.

    Where the full Hessian has no way down either, this takes no step.
    """
    limits = SearchLimits(
        gradient=gradient_limit(problem), steps=most_steps, before=found.minimum.way
    )
    whole, last = replace(problem, mirrored=False), len(problem.meshes) - 1
    return solved_on(whole, last, found.minimum.positions, backend, limits)
