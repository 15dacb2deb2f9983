"""Whether the upper hoop can lie inside the lower one, where its fabric comes down to the beams."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from patterns.plan import UNITS_PER_MM
from sesame_cad.errors import InputError
from sesame_cad.pipeline import Pattern
from sesame_cad.specification import Specification

Size = tuple[float, float]

_SIDES = ("width", "height")


@dataclass(frozen=True, slots=True)
class UpperHoop:
    """The hoop in which the upper array is sewn, and stays until it is tied to the lower one.

    Attributes
    ----------
    inside_mm : tuple of float
        Least width and height inside: all that is sewn and cut, and the strip along a hoop in which
        the machine does not sew.
    outside_mm : tuple of float
        The same with the hoop's rim: it must lie inside the lower hoop.
    """

    inside_mm: Size
    outside_mm: Size


def upper_hoop(spec: Specification, upper: Pattern) -> UpperHoop:
    """Find the smallest hoop for the upper array; both hoops have the same middle.

    Raises
    ------
    InputError
        When it cannot lie inside the lower hoop.
    """
    needles = [run.needles / UNITS_PER_MM for block in upper.plan.blocks for run in block.runs]
    points = np.concatenate([*needles, *upper.outline.outsides])
    inside = 2 * np.abs(points).max(axis=0) + 2 * spec.machine.hoop_rim_mm
    outside = inside + 2 * spec.sleeve.upper_hoop_rim_mm
    machine = spec.machine
    lower = machine.hoop_width_mm, machine.hoop_height_mm
    faults = [
        f"{spec.name}: machine.hoop_{side}_mm = {has:g}: must be at least {needs:.1f}: the upper "
        f"array's hoop must lie inside the lower one, and is {needs:.1f} mm in {side} with a rim "
        f"of sleeve.upper_hoop_rim_mm = {spec.sleeve.upper_hoop_rim_mm:g}"
        for side, has, needs in zip(_SIDES, lower, outside.tolist(), strict=True)
        if needs > has
    ]
    if faults:
        raise InputError(*faults)
    return UpperHoop(_size(inside), _size(outside))


def _size(both: np.ndarray) -> Size:
    width, height = both.tolist()
    return width, height
