"""Where the two ends of the wire leave an array."""

from __future__ import annotations

from enum import StrEnum
from math import pi

import numpy as np

from patterns.errors import PatternError
from patterns.loop import Loop

TAIL_CLEAR_MM = 2.0
"""Least distance of the tails from all other loops: room for the stitches of both wires."""

CRIMP_APART_MM = 5.0
"""Least distance between the ends of two wires that no stitch holds: a crimped tube and the fingers
that hold it need the room. A default of the workshop, not a published figure."""

DIRECTIONS = 72
LEAST_ALIGNMENT = 0.5 - 1e-9
"""Cosine of the largest angle between a side and the direction in which the terminals face."""


class Side(StrEnum):
    """On which side of the array the tails leave; the corner is the bottom left one."""

    CORNER = "corner"
    LEFT = "left"
    RIGHT = "right"
    TOP = "top"
    BOTTOM = "bottom"


FACING_RAD = {
    Side.CORNER: 5 * pi / 4,
    Side.LEFT: pi,
    Side.RIGHT: 0.0,
    Side.TOP: pi / 2,
    Side.BOTTOM: 3 * pi / 2,
}


def terminals(loops: tuple[Loop, ...], side: Side) -> tuple[int, float]:
    """Choose loop and angle of the terminals: there its outward normal has that direction.

    Both tails lie on the tangent there. It must be clear of all other loops at any length, so the
    loop is an outermost one; of such places that is taken which faces the side best.

    Raises
    ------
    PatternError
        When no such place faces the side within 60 degrees.
    """
    angle = pi * np.arange(DIRECTIONS) / (DIRECTIONS / 2)
    facing = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    alignment = np.round(np.cos(angle - FACING_RAD[side]), 9)
    centre = np.array([(loop.x_mm, loop.y_mm) for loop in loops])
    for k in np.argsort(-alignment, kind="stable"):
        if alignment[k] < LEAST_ALIGNMENT:
            break
        reach = centre @ facing[k] + [loop.reach_mm(float(angle[k])) for loop in loops]
        outermost = int(np.argmax(reach))
        others = np.delete(reach, outermost)
        if reach[outermost] - others.max(initial=-np.inf) >= TAIL_CLEAR_MM:
            return outermost, float(angle[k])
    raise PatternError(
        f"the tails cannot leave at the {side.value}: every tangent there comes nearer than "
        f"{TAIL_CLEAR_MM:g} mm to another loop; choose another side or larger loops"
    )
