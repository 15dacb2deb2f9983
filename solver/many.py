"""Many circular loops on isotropic fabric solved at once, each to the same minimum as alone.

All loops take their steps together, as far as they still need any. What the batch cannot settle,
where a step leads elsewhere or a saddle is no minimum, is solved again alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solver.batch import Indices, LoopBatch
from solver.branches import stability_floor
from solver.checks import CONTACT, smallest_principal_stress
from solver.circle import stays_flat, telling_degree
from solver.compact import DEGREES, solve_loop
from solver.disc_basis import DiscBasis, disc_basis, transfer
from solver.disc_functions import DiscFunction
from solver.first_guess import GUESS_DEGREE, energy_weights, saddle_family
from solver.flat import flat_radius
from solver.loop_energy import scene_membrane
from solver.meeting import meeting
from solver.reading import Reading
from solver.saddle_rows import crest_distance, crest_less_valley
from solver.scene import LoopScene
from solver.shape import from_expansion
from solver.tolerance import check_tolerance

Vectors = NDArray[np.float64]
Flags = NDArray[np.bool_]

_DEGREES = (5, 7, 9)
_MOST_STEPS = 14
_LONGEST_STEP = 1.0
_SHORTEST_STEP = 1e-6
"""The next step would be of its square."""

_GROUP = 128
"""Loops that step together: as many as the processor's cache holds."""


@dataclass(frozen=True)
class Equilibria:
    """Minima of many loops, arrays of the shape to which the parameters broadcast.

    Attributes
    ----------
    status : array of str
        ``"converged"``, or why the shape must not be relied on.
    buckled : array of bool
        False where the flat loop is itself the minimum.
    height_over_perimeter : array
    width : array
        Distance of opposite crests, in units of R.
    energy : array
        In units of E_f t R².
    smallest_stress : array
        Smallest principal stress of the fabric, in units of E_f; slack where it is negative.
    lowest_eigenvalue : array
        Of the second variation among all smooth shapes, free motions taken out.
    meets : array of bool
        Where the wire touches itself across the loop, or has passed through itself: a shape that
        no real loop has.
    """

    status: NDArray[np.object_]
    buckled: Flags
    height_over_perimeter: Vectors
    width: Vectors
    energy: Vectors
    smallest_stress: Vectors
    lowest_eigenvalue: Vectors
    meets: Flags

    @property
    def slack(self) -> Flags:
        """Where the fabric would wrinkle."""
        return self.smallest_stress < 0


@dataclass(frozen=True, eq=False)
class _Solved:
    """Shapes (B, n) of the loops ``index`` (B,) in one basis."""

    index: Indices
    basis: DiscBasis
    coefficients: Vectors


def solve_many(
    strain: ArrayLike,
    beta: ArrayLike,
    poisson: ArrayLike,
    reading: Reading = Reading.PLANE_STRESS,
    axial_stiffness: ArrayLike = 1000.0,
    *,
    tolerance: float = 1e-3,
    highest_degree: int = DEGREES[-1],
) -> Equilibria:
    """Find the minima of many loops; the parameters are those of `LoopScene`, and broadcast.

    Parameters
    ----------
    highest_degree : int
        Of the bases that are tried on loops that are solved alone, as slack ones are: each may
        take a second in the largest. Where that is too low the status says so.

    Raises
    ------
    SceneError
        When a number is out of its range.
    """
    check_tolerance(tolerance)
    listed = np.broadcast_arrays(
        *(np.asarray(value, float) for value in (strain, beta, poisson, axial_stiffness))
    )
    scenes = [
        LoopScene(e, b, nu, reading, k)
        for e, b, nu, k in zip(*(values.ravel().tolist() for values in listed), strict=True)
    ]
    flat = np.array([stays_flat(scene) for scene in scenes], dtype=bool)
    table = _Table(scenes, tolerance, highest_degree)
    table.fill(_flat_states(scenes, np.flatnonzero(flat)))
    for solved in _saddles(scenes, np.flatnonzero(~flat), tolerance):
        table.fill(solved)
    table.solve_the_rest_alone()
    return table.shaped(listed[0].shape)


def _flat_states(scenes: Sequence[LoopScene], index: Indices) -> _Solved:
    basis = disc_basis(GUESS_DEGREE, "saddle")
    disc = {(0, DiscFunction(1, 0, "cos")): 0.5, (1, DiscFunction(1, 0, "sin")): 0.5}
    radius = np.array([flat_radius(scenes[i]) for i in index.tolist()])
    return _Solved(index, basis, np.outer(radius, from_expansion(basis.unknowns, disc)))


def _saddles(scenes: Sequence[LoopScene], index: Indices, tolerance: float) -> list[_Solved]:
    """Solve in one basis after the other, each loop until its height stands still."""
    if not len(index):
        return []
    everything = LoopBatch.of(scenes)
    batch = everything.part(index)
    basis = disc_basis(GUESS_DEGREE, "saddle")
    weights = energy_weights(batch.strain, batch.a, batch.b, batch.beta, 0.0)
    q = saddle_family().nearest(weights)
    height = np.zeros(len(index))
    out: list[_Solved] = []
    for degree in _DEGREES:
        finer = disc_basis(degree, "saddle")
        q, converged = _settle(everything.part(index), finer, q @ transfer(basis, finer).T)
        basis = finer
        index, q, before = index[converged], q[converged], height[converged]
        height = q @ crest_less_valley(basis)
        done = np.abs(height - before) <= tolerance * np.abs(height)
        if degree > _DEGREES[0]:
            out.append(_Solved(index[done], basis, q[done]))
            index, q, height = index[~done], q[~done], height[~done]
    return out


def _settle(batch: LoopBatch, basis: DiscBasis, q: Vectors) -> tuple[Vectors, Flags]:
    """Minima (B, n) near first guesses, and where there is one."""
    q, converged = q.copy(), np.zeros(len(q), dtype=bool)
    for first in range(0, len(q), _GROUP):
        group = np.arange(first, min(first + _GROUP, len(q)))
        q[group], converged[group] = _settle_group(batch.part(group), basis, q[group])
    return q, converged


def _settle_group(batch: LoopBatch, basis: DiscBasis, q: Vectors) -> tuple[Vectors, Flags]:
    """Newton's steps as those of `stiff_minimum`, for many loops at once."""
    q, converged = q.copy(), np.zeros(len(q), dtype=bool)
    active = np.arange(len(q))
    force = np.zeros((len(q), len(basis.arc)))
    for step in range(_MOST_STEPS):
        some = batch.part(active)
        at = q[active]
        _, slope, hessian = some.derivatives(basis, at, force)
        try:
            p = np.asarray(np.linalg.solve(hessian, -slope[..., None])[..., 0], float)
        except np.linalg.LinAlgError:
            break
        length = np.sqrt(np.sum(p * p, axis=-1))
        tangent, change = basis.along_edge(at)[..., :3], basis.along_edge(p)[..., :3]
        force = some.rod.force_ahead(tangent, change)
        sane = length <= _LONGEST_STEP
        q[active[sane]] += p[sane]
        close = (length <= _SHORTEST_STEP) & (step > 0)
        converged[active[close]] = True
        going = sane & ~close
        active, force = active[going], force[going]
        if not len(active):
            break
    return q, converged


class _Table:
    """Results by loop, filled as they come."""

    def __init__(self, scenes: Sequence[LoopScene], tolerance: float, highest_degree: int) -> None:
        count = len(scenes)
        self._highest_degree = highest_degree
        self._scenes, self._tolerance = scenes, tolerance
        self._settled = np.zeros(count, dtype=bool)
        self._status = np.full(count, "converged", dtype=object)
        self._numbers = np.full((5, count), np.nan)
        self._meets = np.zeros(count, dtype=bool)

    def fill(self, solved: _Solved) -> None:
        """Enter shapes that are minima; leave out those of which that is not sure."""
        index, basis, q = solved.index, solved.basis, solved.coefficients
        if not len(index):
            return
        scenes = [self._scenes[i] for i in index.tolist()]
        batch = LoopBatch.of(scenes)
        stress = batch.smallest_stress(basis, q)
        highest = np.array(
            [telling_degree(s, t, basis.degree) for s, t in zip(scenes, stress, strict=True)]
        )
        stiffness = np.empty(len(index))
        for degree in np.unique(highest).tolist():
            same = np.flatnonzero(highest == degree)
            stiffness[same] = batch.part(same).weakest_stiffness(basis, q[same], degree)
        height = np.abs(q @ crest_less_valley(basis))
        width = 2 * q @ crest_distance(basis)
        energy = batch.derivatives(basis, q)[0]
        floor = np.array([stability_floor(scene) for scene in scenes])
        good = (stiffness >= -floor) & (width > 0) & np.isfinite(energy)
        numbers = np.stack([height / (2 * np.pi), width, energy, stress, stiffness])
        self._numbers[:, index[good]] = numbers[:, good]
        self._meets[index[good]] = meeting(scenes, basis, q, width)[good]
        self._settled[index[good]] = True

    def solve_the_rest_alone(self) -> None:
        """Solve what is still open one by one; a shape that is no minimum says so."""
        for index in np.flatnonzero(~self._settled).tolist():
            found = solve_loop(
                self._scenes[index],
                tolerance=self._tolerance,
                allow_unreliable=True,
                highest_degree=self._highest_degree,
            )
            basis = disc_basis(found.degree, "saddle")
            gradient = basis.gradient @ found.shape.coefficients
            self._status[index] = found.status
            self._meets[index] = any(left.term == CONTACT and left.fatal for left in found.omitted)
            self._numbers[:, index] = (
                found.shape.height_over_perimeter,
                found.shape.width,
                found.energy,
                smallest_principal_stress(scene_membrane(found.scene), gradient),
                found.lowest_eigenvalue,
            )

    def shaped(self, shape: tuple[int, ...]) -> Equilibria:
        """Give the results in the shape of the parameters."""
        height, width, energy, stress, stiffness = self._numbers.reshape(5, *shape)
        return Equilibria(
            self._status.reshape(shape),
            height != 0,
            height,
            width,
            energy,
            stress,
            stiffness,
            self._meets.reshape(shape),
        )
