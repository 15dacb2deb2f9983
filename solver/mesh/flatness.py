"""Whether an array stays flat: its shape in the plane, and what it gains by leaving that.

Where nothing but rounding is gained by leaving the plane, as on fabric that is not stretched, a
solve would follow motions without stiffness to shapes that mean nothing.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from solver.mesh.descent import Solved, gradient_limit, mass_of, solved_on
from solver.mesh.factorization import factoriser
from solver.mesh.measures import total_height
from solver.mesh.problem import MeshProblem
from solver.mesh.search import SearchLimits
from solver.mesh.triangulation import embedded

Vectors = NDArray[np.float64]

_HELD = 1e3
"""Stiffness, in units of E_f t, that keeps all in the plane: beyond that of any buckling."""
_ALL_BUT_STABLE = 1e-3
"""The same, that at the most is lacked by a flat state from which a solve begins."""
_LITTLE = 1e-9
"""Part of the energy that a shape must have gained by leaving the plane.

A rise of less than about a hundredth of R gains no more: the gain goes with its fourth power.
"""
_LOW = 0.03
"""Total height, in units of R, above which a shape is not flat and need not be compared."""


def in_plane(
    problem: MeshProblem, level: int, radius: float, backend: str | None, most_steps: int
) -> Solved:
    """Minimise on one of the meshes among flat shapes.

    Parameters
    ----------
    radius : float
        Factor by which the flat loops have contracted, roughly.
    """
    held = replace(problem, levelling=_HELD)
    start = embedded(radius * problem.meshes[level].points)
    limits = SearchLimits(gradient=gradient_limit(problem), steps=most_steps)
    return solved_on(held, level, start, backend, limits)


def all_but_stable_flat(
    problem: MeshProblem, radius: float, backend: str | None, most_steps: int
) -> Vectors | None:
    """Positions of the flat shape on the coarsest mesh, unless it is far from stable."""
    flat = in_plane(problem, 0, radius, backend, most_steps).minimum
    if not flat.converged:
        return None
    energy = problem.energy(0)
    entries = energy.derivatives(flat.positions)[2].copy()
    mass = np.repeat(mass_of(problem.meshes[0]), 3)
    entries[energy.pattern.diagonal] += _ALL_BUT_STABLE * mass
    stable = factoriser(energy.pattern, backend).factorise(entries).negative == 0
    return flat.positions if stable else None


def settled_flat(
    problem: MeshProblem,
    solved: list[Solved],
    radius: float,
    backend: str | None,
    most_steps: int,
) -> list[Solved]:
    """Add the flat shape to minima of which the last gains next to nothing over it.

    Its minimum tells the negative eigenvalues that are left, and what the last one has gained.
    """
    last, finest = solved[-1].minimum, len(problem.meshes) - 1
    height = total_height(last.positions, problem.meshes[-1].wires)
    if not 0 < height < _LOW:
        return solved
    flat = in_plane(problem, finest, radius, backend, most_steps).minimum
    if not flat.converged or flat.value - last.value > _LITTLE * abs(flat.value):
        return solved
    # the model at the flat shape itself, with no step from there
    at_rest = solved_on(problem, finest, flat.positions, backend, SearchLimits(steps=0))
    gained = max(0.0, (flat.value - last.value) / flat.value)
    minimum = replace(at_rest.minimum, converged=True, way_down=gained)
    return [*solved, replace(at_rest, minimum=minimum)]
