"""How thick the wire of a dimensionless loop is."""

from __future__ import annotations

import math

from solver.scene import LoopScene

_THICKEST = 0.5
"""Diameter over the loop's smaller half-width; a thicker rod is no wire that could be bent so."""


def wire_diameter(scene: LoopScene) -> float:
    """Diameter of the loop's wire in units of R, when it is round and of one material.

    Then β = E_w I/(2 E_f t R³) and k = E_w A/(E_f t R) with I/A = d²/16, so d/R = √(32 β/k). An
    axial stiffness that is not a solid wire's may ask for more than a wire's thickness, which is
    cut off at half the loop's smaller half-width.
    """
    thickest = _THICKEST * min(scene.semi_axes)
    return min(math.sqrt(32 * scene.beta / scene.axial_stiffness), thickest)
