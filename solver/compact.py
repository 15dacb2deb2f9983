"""Solve one loop in a compact global basis: flat if flat is stable, else the saddle.

The bases are nested, so that each solve starts from the one before it; most steps are spent on the
smallest. The height's change from basis to basis is the estimate of the error.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from solver.checks import looked_back
from solver.disc_basis import DiscBasis, disc_basis
from solver.disc_functions import DiscFunction
from solver.equilibrium import Equilibrium
from solver.errors import NotConvergedError
from solver.flat import flat_radius, flat_shape
from solver.loop_energy import LoopEnergy, loop_energy
from solver.newton import Minimum, minimise
from solver.omitted import OmittedTerm
from solver.scene import LoopScene
from solver.shape import Expansion, LoopShape, from_expansion
from solver.stability import lowest_eigenvalue

Vectors = NDArray[np.float64]

DEGREES = (5, 7, 9, 11, 13, 17, 21, 25)
"""Degrees of the successive bases, 10 to 140 unknowns."""

_START_HEIGHT = 0.25
_SOFT_WIRE = 30.0
_ROUGHLY = 1e-2
_GRADIENT_TOLERANCE = 1e-8
_STABILITY_FLOOR = 1e-9


def solve_loop(
    scene: LoopScene, *, tolerance: float = 1e-4, allow_unreliable: bool = False
) -> Equilibrium:
    """Find the minimum of one loop's energy.

    Parameters
    ----------
    tolerance : float
        The basis grows until the height changes by less than this fraction.
    allow_unreliable : bool
        Give the shape, with a ``status`` that says what is wrong, where this would raise.

    Raises
    ------
    NotConvergedError
        When no basis meets the tolerance, when the saddle is not a minimum among all shapes, or
        when the wire runs through itself. Lesser omissions are told in `Equilibrium.omitted`.
    """
    flat = flat_shape(scene, DEGREES[0])
    flat_eigenvalue = lowest_eigenvalue(scene, flat, DEGREES[0])
    if flat_eigenvalue >= -_STABILITY_FLOOR * max(1.0, scene.beta):
        found = _flat_equilibrium(scene, flat, flat_eigenvalue)
    else:
        found = _saddle_equilibrium(scene, tolerance)
    if found.status != "converged" and not allow_unreliable:
        raise NotConvergedError(found.status)
    return found


def _gradient_tolerance(scene: LoopScene) -> float:
    """Smallest gradient that can be told from the rounding of the wire's stiff terms."""
    return max(_GRADIENT_TOLERANCE, 1e-11 * max(scene.beta, scene.axial_stiffness))


def _flat_equilibrium(scene: LoopScene, flat: LoopShape, eigenvalue: float) -> Equilibrium:
    energy = loop_energy(scene, disc_basis(DEGREES[0], "saddle"))
    slope = energy.derivatives(flat.coefficients)[1]
    return Equilibrium(
        scene=scene,
        shape=flat,
        buckled=False,
        status="converged",
        energy_terms=energy.terms(flat.coefficients),
        gradient_norm=float(np.linalg.norm(slope)),
        lowest_eigenvalue=eigenvalue,
        steps=0,
        factorizations=0,
        unknowns=1,
        height_change=0.0,
        omitted=looked_back(scene, flat, DEGREES[0]),
    )


def inextensional_saddle(height: float, radius: float) -> Expansion:
    """Saddle of amplitude ``height`` whose edge keeps its length to second order.

    With z = c cos 2θ on the edge, a uniform contraction c² and a slip ¼ c² sin 4θ along the edge
    make up for the slope's lengthening 2 c² sin² 2θ.
    """
    edge = {1: radius - height**2, 3: -(height**2) / 8, 5: height**2 / 8}
    one = np.ones(1)
    out: Expansion = {}
    for m, value in edge.items():
        scale = float(DiscFunction(m, 0, "cos").radial(one)[0][0])
        out[0, DiscFunction(m, 0, "cos")] = value / scale
        out[1, DiscFunction(m, 0, "sin")] = (value if m % 4 == 1 else -value) / scale
    rise = DiscFunction(2, 0, "cos")
    out[2, rise] = height / float(rise.radial(one)[0][0])
    return out


def _start(scene: LoopScene, basis: DiscBasis) -> Minimum:
    """Minimise roughly with a wire that may stretch a little.

    The curved valley along which a stiff wire keeps its length takes many steps to follow; across a
    soft one the way is short, and Newton's steps do the rest.
    """
    soft = replace(scene, axial_stiffness=min(scene.axial_stiffness, _SOFT_WIRE))
    start = inextensional_saddle(_START_HEIGHT, flat_radius(scene))
    return minimise(
        loop_energy(soft, basis).derivatives,
        from_expansion(basis.unknowns, start),
        tolerance=_ROUGHLY,
        radius=0.5,
    )


@dataclass(frozen=True)
class _Refined:
    """The last of a sequence of nested bases, and what all of them took."""

    energy: LoopEnergy
    shape: LoopShape
    minimum: Minimum
    degree: int
    height_change: float
    steps: int
    factorizations: int


def _refine(scene: LoopScene, tolerance: float) -> _Refined:
    """Solve in one basis after the other until the height stands still."""
    rough = _start(scene, disc_basis(DEGREES[0], "saddle"))
    unknowns = disc_basis(DEGREES[0], "saddle").unknowns
    shape = LoopShape(unknowns, rough.unknowns)
    steps, factorizations = rough.steps, rough.factorizations
    refined: list[_Refined] = []
    for degree in DEGREES:
        energy = loop_energy(scene, disc_basis(degree, "saddle"))
        start = from_expansion(energy.basis.unknowns, shape.expansion)
        minimum = minimise(
            energy.derivatives, start, tolerance=_gradient_tolerance(scene), radius=0.5
        )
        steps += minimum.steps
        factorizations += minimum.factorizations
        height = shape.height
        shape = _upright(LoopShape(energy.basis.unknowns, minimum.unknowns))
        change = abs(shape.height - height) / max(shape.height, 1e-300)
        refined.append(_Refined(energy, shape, minimum, degree, change, steps, factorizations))
        if degree > DEGREES[0] and minimum.converged and change <= tolerance:
            break
    return refined[-1]


def _saddle_equilibrium(scene: LoopScene, tolerance: float) -> Equilibrium:
    refined = _refine(scene, tolerance)
    eigenvalue = lowest_eigenvalue(scene, refined.shape, refined.degree)
    omitted = looked_back(scene, refined.shape, refined.degree)
    faults = [*_faults_of_solve(refined, eigenvalue, tolerance), *_faults_of_model(omitted)]
    return Equilibrium(
        scene=scene,
        shape=refined.shape,
        buckled=True,
        status="; ".join(faults) or "converged",
        energy_terms=refined.energy.terms(refined.shape.coefficients),
        gradient_norm=refined.minimum.gradient_norm,
        lowest_eigenvalue=eigenvalue,
        steps=refined.steps,
        factorizations=refined.factorizations,
        unknowns=refined.energy.basis.size,
        height_change=refined.height_change,
        omitted=omitted,
    )


def _faults_of_solve(refined: _Refined, eigenvalue: float, tolerance: float) -> list[str]:
    """Say what keeps the last basis' stationary point from being the answer."""
    minimum = refined.minimum
    faults: list[str] = []
    if not minimum.converged:
        faults.append(
            f"not converged: gradient norm {minimum.gradient_norm:.1e} after {refined.steps} steps;"
            " raise beta or lower strain"
        )
    elif refined.height_change > tolerance:
        faults.append(
            f"not converged: the height still changes by {refined.height_change:.1e} from basis to "
            f"basis ({refined.energy.basis.size} unknowns); a tolerance above that would pass"
        )
    if eigenvalue < -_STABILITY_FLOOR * max(1.0, refined.energy.rod.axial_stiffness):
        faults.append(
            f"the saddle is not a minimum (lowest eigenvalue {eigenvalue:.1e}): the fabric "
            "wrinkles or the loop folds; raise beta or lower strain"
        )
    return faults


def _faults_of_model(omitted: tuple[OmittedTerm, ...]) -> list[str]:
    """Say which omissions the shape does not bear."""
    return [
        f"{left.term} is left out, and the shape is wrong without ({left.measure}: "
        f"{left.value:.2g}); "
        "raise beta or lower strain"
        for left in omitted
        if left.fatal
    ]


def _upright(shape: LoopShape) -> LoopShape:
    """Mirror the saddle in z = 0, if need be, so that its crests lie on the x axis."""
    if shape.height >= 0:
        return shape
    mirrored = {
        (component, f): value if component < 2 else -value
        for (component, f), value in shape.expansion.items()
    }
    return LoopShape(shape.unknowns, from_expansion(shape.unknowns, mirrored))
