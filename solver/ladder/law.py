"""The first rung: height in closed form, in microseconds."""

from __future__ import annotations

import math

from solver.errors import SceneError
from solver.ladder.answer import Answer, Rung
from solver.omitted import OmittedTerm
from solver.scaling_law import LawLoop, scaling_loop
from solver.scene import LoopScene

ASKED = "asked for"
TILED = "equal loops without fabric between them tile: one is solved"

_LARGEST_WIRE_STRAIN = 0.01
"""As `solver.checks.LARGEST_WIRE_STRAIN`, which loads more than the law must."""


def _law_applies(scene: LoopScene) -> bool:
    return scene.isotropic_circle and scene.natural_curvature == 0 and scene.alpha == 0


def _compared(scene: LoopScene) -> bool:
    """Whether loops like this were compared with the compact solve, see `LawLoop.error`."""
    return (
        _law_applies(scene)
        and 0.01 <= scene.beta <= 0.25
        and scene.strain <= 0.5
        and 0 <= scene.poisson <= 0.49
        and scene.axial_stiffness >= 1
    )


def _solved(scene: LoopScene) -> LawLoop:
    return scaling_loop(
        scene.strain, scene.beta, scene.poisson, scene.reading, scene.axial_stiffness
    )


def law_error(scene: LoopScene) -> float:
    """Largest relative error of the law for a scene.

    Infinite where it is not known: where the law was never compared, where the wire shortens by
    more than 3 % and where the fabric may be slack, which is also where loops meet themselves.
    """
    return _relative_error(_solved(scene)) if _compared(scene) else math.inf


def _relative_error(found: LawLoop) -> float:
    if found.height == 0:
        return found.error
    return math.inf if found.may_be_slack else found.error / found.height


def by_law(scene: LoopScene, reason: str) -> Answer:
    """Answer from the law alone.

    Raises
    ------
    SceneError
        When the law does not know such loops.
    """
    if not _law_applies(scene):
        raise SceneError(
            "the scaling law knows circular loops of isotropic fabric without bending stiffness "
            "(alpha = 0) and straight wire; use the compact rung"
        )
    found = _solved(scene)
    return Answer(
        rung=Rung.SCALING,
        reason=reason,
        buckled=found.height > 0,
        height_over_perimeter=found.height,
        height_error=_relative_error(found) if _compared(scene) else math.inf,
        terms=("fabric stretch", "wire bending", "wire stretch"),
        omitted=_left_out(found),
        equilibrium=None,
    )


def _left_out(found: LawLoop) -> tuple[OmittedTerm, ...]:
    slack, soft = found.taut_above / found.below_threshold, found.shortening
    return (
        OmittedTerm(
            "slack fabric (tension field)",
            "β below which fabric may be slack / β",
            slack,
            matters=found.height > 0 and found.may_be_slack,
        ),
        OmittedTerm(
            "contact across the loop", "not looked at by the scaling law", math.nan, matters=False
        ),
        OmittedTerm(
            "wire's softness beyond small stretch",
            "part of its length by which the wire shortens",
            soft,
            matters=soft > _LARGEST_WIRE_STRAIN,
        ),
    )
