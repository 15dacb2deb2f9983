"""Solve one loop in a compact global basis: flat if flat is stable, else the lowest saddle."""

from __future__ import annotations

from solver.branches import flat_state, lowest_branch, stability_floor
from solver.checks import looked_back, smallest_principal_stress, writhe_strays
from solver.circle import flat_circle, saddle_circle, stays_flat, telling_degree
from solver.disc_basis import Space
from solver.equilibrium import Equilibrium, Kind
from solver.errors import NotConvergedError
from solver.first_guess import inextensional_saddle
from solver.loop_energy import scene_membrane
from solver.omitted import OmittedTerm
from solver.refine import DEGREES, Refined
from solver.scene import LoopScene
from solver.shape import LoopShape
from solver.stability import weakest_motion
from solver.symmetry import ALIGNED, DIAGONAL
from solver.tolerance import check_tolerance

__all__ = ["DEGREES", "inextensional_saddle", "solve_loop"]

_KINDS: dict[Space, Kind] = {
    "saddle": Kind.SADDLE,
    "oblique": Kind.OBLIQUE,
    ALIGNED: Kind.ALIGNED,
    DIAGONAL: Kind.DIAGONAL,
}


def solve_loop(
    scene: LoopScene,
    *,
    tolerance: float = 1e-4,
    allow_unreliable: bool = False,
    start: Equilibrium | None = None,
    highest_degree: int = DEGREES[-1],
) -> Equilibrium:
    """Find the minimum of one loop's energy.

    Parameters
    ----------
    tolerance : float
        The basis grows until the height changes by less than this fraction.
    allow_unreliable : bool
        Give the shape, with a ``status`` that says what is wrong, where this would raise.
    start : Equilibrium, optional
        That of a neighbouring scene, from which a circular loop on isotropic fabric is solved in
        less time.
    highest_degree : int
        Of the bases that are tried on a circular loop on isotropic fabric, one of `DEGREES`.

    Raises
    ------
    SceneError
        When the tolerance is not greater than 0 and finite.
    NotConvergedError
        When no basis meets the tolerance, when the shape is not a minimum among all shapes, or when
        the wire runs through itself. Lesser omissions are told in `Equilibrium.omitted`.
    """
    check_tolerance(tolerance)
    if scene.isotropic_circle:
        found = _circle(scene, tolerance, start, highest_degree)
    else:
        found = _lowest_of_branches(scene, tolerance)
    if found.status != "converged" and not allow_unreliable:
        raise NotConvergedError(found.status)
    return found


def _circle(
    scene: LoopScene, tolerance: float, start: Equilibrium | None, highest_degree: int
) -> Equilibrium:
    if stays_flat(scene):
        refined = flat_circle(scene)
    else:
        refined = saddle_circle(scene, tolerance, start, highest_degree)
    basis, q = refined.basis, refined.unknowns
    stress = smallest_principal_stress(scene_membrane(scene), basis.gradient @ q)
    highest = telling_degree(scene, stress, basis.degree)
    eigenvalue = weakest_motion(scene, refined.space, basis, q, highest).eigenvalue
    return _equilibrium(scene, refined, eigenvalue, stress, tolerance)


def _lowest_of_branches(scene: LoopScene, tolerance: float) -> Equilibrium:
    refined, weakest = flat_state(scene)
    if weakest.eigenvalue < -stability_floor(scene):
        refined, weakest = lowest_branch(scene, refined, tolerance)
    gradient = refined.basis.gradient @ refined.unknowns
    stress = smallest_principal_stress(scene_membrane(scene), gradient)
    return _equilibrium(scene, refined, weakest.eigenvalue, stress, tolerance)


def _equilibrium(
    scene: LoopScene, refined: Refined, eigenvalue: float, stress: float, tolerance: float
) -> Equilibrium:
    basis, q = refined.basis, refined.unknowns
    shape = LoopShape(basis.unknowns, q)
    terms = refined.energy.terms(q)
    omitted = looked_back(scene, basis, q, stress, sum(terms.values()))
    faults = _faults_of_solve(scene, refined, eigenvalue, tolerance)
    buckled = refined.height != 0
    return Equilibrium(
        scene=scene,
        shape=shape,
        buckled=buckled,
        status="; ".join([*faults, *_faults_of_model(scene, omitted)]) or "converged",
        energy_terms=terms,
        gradient_norm=refined.minimum.gradient_norm,
        lowest_eigenvalue=eigenvalue,
        steps=refined.steps,
        factorizations=refined.factorizations,
        unknowns=basis.size,
        height_change=refined.height_change,
        omitted=omitted,
        kind=_KINDS[refined.space] if buckled else Kind.FLAT,
        degree=basis.degree,
    )


def _remedy(scene: LoopScene) -> str:
    """Say what would bring a scene nearer to those that can be solved."""
    lower = ["strain", "axial_stiffness"]
    lower += ["axis_ratio"] if scene.axis_ratio > 1 else []
    lower += ["natural_curvature"] if scene.natural_curvature > 0 else []
    return f"raise beta, or lower {' or '.join(lower)}"


def _faults_of_solve(
    scene: LoopScene, refined: Refined, eigenvalue: float, tolerance: float
) -> list[str]:
    """Say what keeps the last basis' stationary point from being the answer."""
    minimum, remedy = refined.minimum, _remedy(scene)
    faults: list[str] = []
    if not minimum.converged:
        faults.append(
            f"not converged: gradient norm {minimum.gradient_norm:.1e} after {refined.steps} "
            f"steps; {remedy}"
        )
    elif refined.height_change > tolerance:
        faults.append(
            f"not converged: the height still changes by {refined.height_change:.1e} from basis to "
            f"basis ({refined.basis.size} unknowns); a tolerance above that would pass, or {remedy}"
        )
    if eigenvalue < -stability_floor(scene):
        faults.append(
            f"the shape is not a minimum (lowest eigenvalue {eigenvalue:.1e}): the fabric "
            f"wrinkles or the loop folds; {remedy}"
        )
    if writhe_strays(refined.energy, refined.unknowns):
        faults.append(
            f"the wire's twist is wrong: the loop has turned inside out on its way from the flat "
            f"one; {remedy}"
        )
    return faults


def _faults_of_model(scene: LoopScene, omitted: tuple[OmittedTerm, ...]) -> list[str]:
    """Say which omissions the shape does not bear."""
    return [
        f"{left.term} is left out, and the shape is wrong without ({left.measure}: "
        f"{left.value:.2g}); {_remedy(scene)}"
        for left in omitted
        if left.fatal
    ]
