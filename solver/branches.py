"""Shapes of loops that are not alike in all directions: ellipses, and orthotropic fabric.

Saddles may lie along the axes or at 45° to them; which is lower depends on the scene. Between them
lie shapes with no more than a half-turn.
"""

from __future__ import annotations

from dataclasses import replace

from solver.disc_basis import disc_basis, transfer
from solver.disc_functions import DiscFunction
from solver.loop_energy import loop_energy
from solver.newton import minimise
from solver.refine import Refined, gradient_tolerance, refine, settle
from solver.scene import LoopScene
from solver.shape import Expansion, LoopShape, from_expansion
from solver.stability import WeakestMotion, weakest_motion
from solver.symmetry import ALIGNED, DIAGONAL, FLAT, Symmetry, mirror_symmetry

BRANCH_DEGREES = (5, 7, 9, 11, 13, 17)
"""Degrees of the successive bases, 20 to 155 unknowns."""

OBLIQUE_DEGREES = (9, 11, 13)
"""For shapes with no more than a half-turn, 95 to 175 unknowns.

Smaller bases tell too little of shapes between two saddles of nearly the same energy.
"""

_RISES = {ALIGNED: DiscFunction(2, 0, "cos"), DIAGONAL: DiscFunction(2, 0, "sin")}
_START_HEIGHT = 0.25
_SOFT_WIRE = 30.0
_ROUGHLY = 1e-2
_KEEPING_A_HALF_TURN = (ALIGNED, DIAGONAL, mirror_symmetry(1, 1), Symmetry(((1, 1),), ((0, 0),)))
_MOST_STEPS = 600
_SAME_ENERGY = 1e-7
"""By which a stable branch may lie above an unstable one that has another basis."""
_PUSH = 0.1
"""How far an unstable shape is left along its weakest motion, in the mean square over the disc."""


def _undeformed(scene: LoopScene) -> Expansion:
    """Coordinates of the flat loop as it was laid; x itself has mean square 1/4 over the disc."""
    a, b = scene.semi_axes
    return {(0, DiscFunction(1, 0, "cos")): a / 2, (1, DiscFunction(1, 0, "sin")): b / 2}


def flat_state(scene: LoopScene) -> tuple[Refined, WeakestMotion]:
    """Solve within the plane until the stiffness against leaving it stands still."""
    basis = disc_basis(BRANCH_DEGREES[0], FLAT)
    q = from_expansion(basis.unknowns, _undeformed(scene))
    steps = factorizations = 0
    solved: list[tuple[Refined, WeakestMotion]] = []
    for degree in BRANCH_DEGREES:
        energy = loop_energy(scene, disc_basis(degree, FLAT))
        start = transfer(basis, energy.basis) @ q
        minimum = settle(scene, energy, start, (basis, q) if solved else None)
        basis, q = energy.basis, minimum.unknowns
        steps, factorizations = steps + minimum.steps, factorizations + minimum.factorizations
        refined = Refined(FLAT, energy, minimum, 0.0, 0.0, steps, factorizations)
        solved.append((refined, weakest_of(scene, refined)))
        if not minimum.converged or (len(solved) > 1 and _alike(*(w for _, w in solved[-2:]))):
            break
    return solved[-1]


def _alike(one: WeakestMotion, other: WeakestMotion) -> bool:
    return abs(one.eigenvalue - other.eigenvalue) <= _ROUGHLY * abs(other.eigenvalue)


def _branch_start(scene: LoopScene, flat: Refined, space: Symmetry) -> Refined:
    """Solve one branch in the smallest basis, a soft wire first."""
    basis = disc_basis(BRANCH_DEGREES[0], space)
    f = _RISES[space]
    rise = from_expansion(basis.unknowns, {(2, f): _START_HEIGHT / f.edge_value})
    start = transfer(flat.basis, basis) @ flat.unknowns + rise
    soft = replace(scene, axial_stiffness=min(scene.axial_stiffness, _SOFT_WIRE))
    rough = minimise(loop_energy(soft, basis).derivatives, start, tolerance=_ROUGHLY, radius=0.5)
    energy = loop_energy(scene, basis)
    minimum = settle(scene, energy, rough.unknowns)
    height = LoopShape(basis.unknowns, minimum.unknowns).height
    steps, factorizations = rough.steps + minimum.steps, rough.factorizations
    factorizations += minimum.factorizations
    return Refined(space, energy, minimum, height, 1.0, steps, factorizations)


def finished(
    scene: LoopScene, branch: Refined, tolerance: float, degrees: tuple[int, ...]
) -> Refined:
    """Refine a branch that was solved in a small basis."""
    start = branch.basis, branch.unknowns
    refined = refine(scene, branch.space, start, tolerance, degrees)
    return replace(
        refined,
        steps=refined.steps + branch.steps,
        factorizations=refined.factorizations + branch.factorizations,
    )


def solve_branch(scene: LoopScene, space: Symmetry, tolerance: float) -> Refined:
    """Solve for the saddle along the axes (`ALIGNED`) or at 45° to them (`DIAGONAL`).

    It is stationary, and a minimum among shapes of its symmetry; whether also among all,
    `weakest_of` tells.
    """
    start = _branch_start(scene, flat_state(scene)[0], space)
    return finished(scene, start, tolerance, BRANCH_DEGREES)


def lowest_branch(
    scene: LoopScene, flat: Refined, tolerance: float
) -> tuple[Refined, WeakestMotion]:
    """Find the lower of the saddles along the axes and at 45° to them, if it is a minimum.

    Where it is not, and the other one is not a lower minimum, it is left along its weakest motion,
    if that keeps a half-turn. What is still unstable then, wrinkled or folded, is told by its
    weakest motion.
    """
    rough = [_branch_start(scene, flat, space) for space in (DIAGONAL, ALIGNED)]
    rough.sort(key=lambda branch: branch.minimum.value)
    found: list[tuple[Refined, WeakestMotion]] = []
    for branch in rough:
        refined = finished(scene, branch, tolerance, BRANCH_DEGREES)
        found.append((refined, weakest_of(scene, refined)))
        stable = found[-1][1].eigenvalue >= -stability_floor(scene)
        lower = refined.minimum.value <= found[0][0].minimum.value + _SAME_ENERGY
        if (stable and lower) or found[0][1].symmetry not in _KEEPING_A_HALF_TURN:
            return found[-1]
    left = leave(scene, *found[0], tolerance)
    return left, weakest_of(scene, left)


def weakest_of(scene: LoopScene, refined: Refined) -> WeakestMotion:
    """Weakest of all motions of the degree of a shape's basis."""
    return weakest_motion(scene, refined.space, refined.basis, refined.unknowns)


def stability_floor(scene: LoopScene) -> float:
    """How far below 0 an eigenvalue may be by rounding and by what the basis lacks."""
    return 1e-6 + 1e-12 * max(scene.axial_stiffness, scene.beta)


def leave(scene: LoopScene, refined: Refined, weakest: WeakestMotion, tolerance: float) -> Refined:
    """Go downhill from an unstable shape, among all that have a half-turn about z."""
    small = disc_basis(OBLIQUE_DEGREES[0], "oblique")
    push = transfer(weakest.basis, small) @ weakest.direction
    start = transfer(refined.basis, small) @ refined.unknowns + _PUSH * push
    energy = loop_energy(scene, small)
    minimum = minimise(
        energy.derivatives,
        start,
        tolerance=gradient_tolerance(scene),
        radius=_PUSH,
        most_steps=_MOST_STEPS,
    )
    steps = refined.steps + minimum.steps
    factorizations = refined.factorizations + minimum.factorizations
    branch = Refined("oblique", energy, minimum, 0.0, 1.0, steps, factorizations)
    return finished(scene, branch, tolerance, OBLIQUE_DEGREES)
