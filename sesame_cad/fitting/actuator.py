"""A loop that is heated: what it does, and how that changes with what a maker chooses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from sesame_cad.loop_response import (
    AXIAL_POWERS,
    BETA_POWERS,
    LoopDesign,
    LoopResponse,
    respond,
)
from sesame_cad.tolerances import half_widths
from solver.checks import SLACK
from solver.held import Pitch, solve_at_pitch
from solver.sensitivity_held import PITCH, force_sensitivities

Vectors = NDArray[np.float64]

CHOICES = ("loop_diameter_mm", "wire_diameter_mm", "prestrain")
"""What a maker chooses, in the order of the gradients."""

QUANTITIES = ("height_mm", "stroke_mm", "pitch_mm", "force_N")
"""What may be wanted: the cold height; how much of it heating takes; the cold pitch; and the force
with which a hot loop presses on neighbours or plates that keep it at the cold pitch."""


@dataclass(frozen=True, slots=True)
class Parts:
    """What is given: the fabric, and the kind of wire.

    Attributes
    ----------
    fabric_modulus_kPa, fabric_thickness_mm, poisson : float
    wire_modulus_cold_GPa, wire_modulus_hot_GPa : float
    reading : str
    """

    fabric_modulus_kPa: float  # noqa: N815 - the unit's own spelling
    fabric_thickness_mm: float
    poisson: float
    wire_modulus_cold_GPa: float  # noqa: N815
    wire_modulus_hot_GPa: float  # noqa: N815
    reading: str

    def loop(self, choice: Vectors) -> LoopDesign:
        """Give the cold loop of a choice (3,), in the order of `CHOICES`."""
        loop_mm, wire_mm, prestrain = choice.tolist()
        return LoopDesign(
            loop_mm,
            wire_mm,
            prestrain,
            self.fabric_modulus_kPa,
            self.fabric_thickness_mm,
            self.poisson,
            self.wire_modulus_cold_GPa,
            self.reading,
        )

    def hot(self, cold: LoopDesign) -> LoopDesign:
        """Give the same loop when its wire is hot."""
        return replace(cold, wire_modulus_GPa=self.wire_modulus_hot_GPa)


@dataclass(frozen=True)
class Action:
    """What one choice does.

    Attributes
    ----------
    values : dict
        Each wanted quantity.
    slopes : dict
        Its derivatives (3,) by `CHOICES`.
    cold : LoopResponse
    slack : bool
        Whether the cold fabric is slack somewhere, which the model bears but for small wrinkles.
    """

    values: dict[str, float]
    slopes: dict[str, Vectors]
    cold: LoopResponse
    slack: bool

    @property
    def height_spread(self) -> float:
        """Standard deviation of the height under the usual tolerances, over the height."""
        widths = half_widths(self.cold.design)
        parts = [self.cold.height_by[key] * width for key, width in widths.items()]
        height = self.cold.height_mm
        return float(np.sqrt(np.sum(np.square(parts)) / 3)) / height if height > 0 else np.inf


def action(parts: Parts, choice: Vectors, wanted: tuple[str, ...]) -> Action:
    """Solve a choice, cold and, where that is asked for, hot.

    Raises
    ------
    SceneError, NotConvergedError
        When a shape lies outside the model or cannot be relied on.
    """
    design = parts.loop(choice)
    cold = respond(design)
    values = {"height_mm": cold.height_mm, "pitch_mm": cold.pitch_mm}
    slopes = {"height_mm": _by_choices(cold.height_by), "pitch_mm": _by_choices(cold.pitch_by)}
    if "stroke_mm" in wanted:
        hot = respond(parts.hot(design))
        values["stroke_mm"] = cold.height_mm - hot.height_mm
        slopes["stroke_mm"] = slopes["height_mm"] - _by_choices(hot.height_by)
    if "force_N" in wanted:
        values["force_N"], slopes["force_N"] = _force(parts.hot(design), cold)
    slack = any(left.term == SLACK and left.matters for left in cold.found.omitted)
    return Action({key: values[key] for key in wanted}, slopes, cold, slack)


def _by_choices(by: Mapping[str, float]) -> Vectors:
    return np.array([by[key] for key in CHOICES])


def _force(hot: LoopDesign, cold: LoopResponse) -> tuple[float, Vectors]:
    """Force in N of the hot loop at the cold loop's pitch, and its derivatives by `CHOICES`."""
    scene, unit_N = hot.scene, hot.materials.force_unit_N  # noqa: N806 - the unit's own spelling
    radius_mm = hot.loop_diameter_mm / 2
    held = solve_at_pitch(scene, Pitch(cold.pitch_mm / radius_mm))
    by = force_sensitivities(held)
    slopes = np.zeros(len(CHOICES))
    for k, key in enumerate(CHOICES):
        if key == "prestrain":
            slopes[k] = by["strain"]
        else:
            value = getattr(hot, key)
            slopes[k] = by["beta"] * scene.beta * BETA_POWERS[key] / value
            slopes[k] += by["axial_stiffness"] * scene.axial_stiffness * AXIAL_POWERS[key] / value
        slopes[k] += by[PITCH] * cold.pitch_by[key] / radius_mm
    # the pitch in units of R, and the unit of force, change with R as well
    slopes[0] -= by[PITCH] * cold.pitch_mm / radius_mm / hot.loop_diameter_mm
    slopes[0] += held.force / hot.loop_diameter_mm
    return held.force * unit_N, slopes * unit_N
