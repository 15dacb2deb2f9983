"""The first rung: height in closed form, in microseconds."""

from __future__ import annotations

import math

from solver.errors import SceneError
from solver.ladder.answer import Answer, Rung
from solver.omitted import OmittedTerm
from solver.scaling_law import LARGEST_ERROR, scaling_height
from solver.scene import LoopScene
from solver.threshold import critical_beta


def _law_applies(scene: LoopScene) -> bool:
    return scene.isotropic_circle and scene.natural_curvature == 0 and scene.alpha == 0


def law_error(scene: LoopScene) -> float:
    """Largest relative error of the law for a scene; infinite where it was never compared."""
    fitted = (
        _law_applies(scene)
        and 0.01 <= scene.beta <= 0.25
        and scene.strain <= 0.5
        and 0 <= scene.poisson <= 0.49
    )
    if not fitted:
        return math.inf
    height = scaling_height(scene.strain, scene.beta, scene.poisson, scene.reading)
    return LARGEST_ERROR / height if height > 0 else 0.0


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
    height = scaling_height(scene.strain, scene.beta, scene.poisson, scene.reading)
    error = law_error(scene)
    unchecked = tuple(
        OmittedTerm(term, "not looked at by the scaling law", math.nan, matters=False)
        for term in ("slack fabric (tension field)", "contact across the loop", "wire stretch")
    )
    return Answer(
        rung=Rung.SCALING,
        reason=reason,
        buckled=scene.beta < critical_beta(scene.strain, scene.poisson, scene.reading),
        height_over_perimeter=height,
        height_error=error,
        terms=("fabric stretch", "wire bending"),
        omitted=unchecked,
        equilibrium=None,
    )
