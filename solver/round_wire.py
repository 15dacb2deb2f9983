"""How thick the wire of a dimensionless loop is."""

from __future__ import annotations

import math

from solver.scene import LoopScene

_THICKEST = 0.5
"""Diameter over the loop's smaller half-width; a thicker rod is no wire that could be bent so."""


def round_diameter(beta: float, axial_stiffness: float, half_width: float) -> float:
    """Diameter of a round wire of one material, in the unit R of β and of the axial stiffness k.

    β = E_w I/(2 E_f t R³) and k = E_w A/(E_f t R) with I/A = d²/16, so d/R = √(32 β/k)
    (docs/theory.md, eq. (10)). An axial stiffness that is not a solid wire's may ask for more than
    a wire's thickness, which is cut off at half the smaller half-width of its loop.
    """
    return min(solid_diameter(beta, axial_stiffness), _THICKEST * half_width)


def solid_diameter(beta: float, axial_stiffness: float) -> float:
    """Diameter of a solid round wire with such β and k: docs/theory.md, eq. (10), unbounded."""
    return math.sqrt(32 * beta / axial_stiffness)


def wire_diameter(scene: LoopScene) -> float:
    """Diameter of the loop's wire in units of R, when it is round."""
    return round_diameter(scene.beta, scene.axial_stiffness, min(scene.semi_axes))
