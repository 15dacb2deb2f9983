"""Solve a scene on a mesh, from coarse to fine.

Most steps are spent on the coarsest mesh, first with a wire that may stretch a little: the curved
valley along which a stiff wire keeps its length takes many steps to follow. Each finer mesh starts
from the shape of the one before and takes a few.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from solver.errors import NotConvergedError, SceneError
from solver.flat import flat_radius
from solver.mesh.array_mesh import Between
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.factorization import Factoriser, factoriser
from solver.mesh.krylov import symmetric_product
from solver.mesh.measures import loop_heights, total_height
from solver.mesh.mesh_energy import MeshEnergy
from solver.mesh.newton_sparse import minimise_sparse
from solver.mesh.problem import MeshProblem, array_problem, loop_problem
from solver.mesh.rigid import lowest_eigenvalue
from solver.mesh.scene import ArrayScene
from solver.mesh.search import SearchLimits, SparseMinimum
from solver.mesh.start import aligned_saddle, array_start, loop_start, tiled_start
from solver.mesh.triangulation import Mesh, prolonged
from solver.scene import LoopScene

Vectors = NDArray[np.float64]

_SOFT_WIRE = 30.0
_ROUGHLY = 1e-3
_LESS_ROUGHLY = 1e-5
_NEARLY = 1e-6
"""Part of the energy that a coarse mesh's shape may lack: it is only where the next one starts."""
_SMALLEST_GRADIENT = 1e-8
_COARSEST_LOOP = 1
_COARSEST_ARRAY = 0
"""Refinements of the meshes on which a solve begins."""


@dataclass(frozen=True)
class _Solved:
    """The minimum on one mesh, and what it was found with."""

    energy: MeshEnergy
    factoriser: Factoriser
    minimum: SparseMinimum


def mass_of(mesh: Mesh) -> Vectors:
    """Weight (n,) of each vertex in mean squares: its share of fabric over that of one loop."""
    return mesh.vertex_areas / np.pi


def _solved(
    problem: MeshProblem, level: int, start: Vectors, backend: str | None, limits: SearchLimits
) -> _Solved:
    energy = problem.energy(level)
    factors = factoriser(energy.pattern, backend)
    mass = mass_of(problem.meshes[level])
    limits = replace(limits, steady=problem.tension_field)
    return _Solved(energy, factors, minimise_sparse(energy, start, mass, factors, limits))


def _roughly_solved(
    problem: MeshProblem, level: int, start: Vectors, backend: str | None, decrease: float
) -> _Solved:
    """Minimise with a soft wire, until little is left to gain."""
    limits = SearchLimits(decrease=decrease)
    return _solved(problem.softened(_SOFT_WIRE), level, start, backend, limits)


def _descend(
    problem: MeshProblem, first: int, start: Vectors, backend: str | None, most_steps: int
) -> list[_Solved]:
    """Minimise on one mesh after the other, from the one numbered ``first`` on."""
    stiffest = max(max(100 * w.beta, w.axial_stiffness) for w in problem.wires)
    # a smaller gradient could not be told from the rounding of the wires' stiff terms
    gradient = max(_SMALLEST_GRADIENT, 1e-11 * stiffest)
    limits = SearchLimits(gradient=gradient, steps=most_steps)
    meshes = problem.meshes
    found: list[_Solved] = []
    for k in range(first, len(meshes)):
        if k > first:
            start = prolonged(meshes[k - 1], meshes[k], found[-1].minimum.positions)
        finest = k == len(meshes) - 1
        asked = limits if finest else replace(limits, decrease=_NEARLY)
        found.append(_solved(problem, k, start, backend, asked))
    return found


def _fault(minimum: SparseMinimum) -> str:
    if minimum.converged:
        return "converged"
    saddle = f" with {minimum.negative} negative eigenvalues" if minimum.negative else ""
    return (
        f"not converged: gradient {minimum.gradient_norm:.1e}{saddle} after {minimum.steps} steps "
        "on the finest mesh; where fabric goes slack a mesh wrinkles at its own scale: "
        "take the tension field, refine less, raise beta or lower strain"
    )


def _equilibrium(
    scene: LoopScene | ArrayScene, problem: MeshProblem, solved: list[_Solved], *, lenient: bool
) -> MeshEquilibrium:
    """Look at the last of a sequence of minima, the first of which may be a rough one."""
    last = solved[-1]
    mesh, positions = problem.meshes[-1], last.minimum.positions
    status = _fault(last.minimum)
    if not (last.minimum.converged or lenient):
        raise NotConvergedError(status)
    energy = last.energy
    fabric = problem.fabric_on(len(problem.meshes) - 1)
    corners = positions[fabric.vertices]
    return MeshEquilibrium(
        scene=scene,
        mesh=mesh,
        positions=positions,
        status=status,
        energy_terms=energy.terms(positions),
        gradient_norm=last.minimum.gradient_norm,
        lowest_eigenvalue=_lowest_eigenvalue(last, mesh),
        steps=sum(s.minimum.steps for s in solved),
        factorizations=sum(s.minimum.factorizations for s in solved),
        height=total_height(positions, mesh.wires),
        loop_heights=loop_heights(positions, mesh.wires),
        coarser_height=_coarser_height(problem, solved),
        smallest_stress=float(fabric.smallest_stress(corners).min()),
        compressed_fraction=float(np.mean(fabric.compressed(corners))),
        tension_field=problem.tension_field,
    )


def _lowest_eigenvalue(solved: _Solved, mesh: Mesh) -> float:
    minimum = solved.minimum
    hessian = symmetric_product(solved.energy.pattern, minimum.entries)
    # the last matrix that a converged minimisation factorised is that of the minimum
    return lowest_eigenvalue(hessian, minimum.factored, minimum.positions, mass_of(mesh))


def _coarser_height(problem: MeshProblem, solved: list[_Solved]) -> float:
    before = problem.meshes[max(0, len(problem.meshes) - 2)]
    coarser = [s.minimum for s in solved[:-1] if len(s.minimum.positions) == len(before.points)]
    return total_height(coarser[-1].positions, before.wires) if coarser else math.nan


def _check_start(problem: MeshProblem, start: Vectors) -> None:
    expected = (len(problem.meshes[-1].points), 3)
    if start.shape != expected or not np.isfinite(start).all():
        raise SceneError(f"start: must be finite positions of shape {expected}")


def solve_loop_mesh(
    scene: LoopScene,
    *,
    refinement: int = 3,
    start: Vectors | None = None,
    backend: str | None = None,
    most_steps: int = 500,
    tension_field: bool = False,
    allow_unreliable: bool = False,
) -> MeshEquilibrium:
    """Find a minimum of one loop's energy on a fan of 20 triangles split in 4 so many times.

    Parameters
    ----------
    refinement : int
        0 to 6; the wire has 20 · 2^refinement edges. The error falls by 4 with each.
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
        When the refinement is out of range, or a tension field is asked of fabric whose directions
        are not alike.
    """
    problem = loop_problem(scene, refinement, tension_field=tension_field)
    if start is not None:
        _check_start(problem, start)
        solved = _descend(problem, refinement, start, backend, most_steps)
    else:
        first = min(_COARSEST_LOOP, refinement)
        lifted = loop_start(problem.energy(first), problem.meshes[first], flat_radius(scene))
        rough = _roughly_solved(problem, first, lifted, backend, _ROUGHLY)
        solved = [rough, *_descend(problem, first, rough.minimum.positions, backend, most_steps)]
    return _equilibrium(scene, problem, solved, lenient=allow_unreliable)


def _tiles(scene: ArrayScene) -> bool:
    """Whether copies of one loop's saddle fit together."""
    return scene.between is Between.CUT and scene.loop.isotropic_circle


def solve_array(
    scene: ArrayScene,
    *,
    refinement: int = 2,
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
    problem = array_problem(scene, refinement, tension_field=tension_field)
    last = len(problem.meshes) - 1
    if start is not None:
        _check_start(problem, start)
        solved = _descend(problem, last, start, backend, most_steps)
    elif _tiles(scene):
        loop = solve_loop_mesh(
            scene.loop, refinement=refinement, backend=backend, tension_field=tension_field
        )
        tile = aligned_saddle(loop.mesh, loop.positions)
        tiles = tiled_start(problem.meshes[-1], loop.mesh, tile)
        solved = _descend(problem, last, tiles, backend, most_steps)
    else:
        first = _COARSEST_ARRAY
        flat = array_start(problem.meshes[first])
        rough = _roughly_solved(problem, first, flat, backend, _LESS_ROUGHLY)
        solved = [rough, *_descend(problem, first, rough.minimum.positions, backend, most_steps)]
    return _equilibrium(scene, problem, solved, lenient=allow_unreliable)
