"""How far above the beam's middle a sleeve sits."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.errors import SceneError
from solver.sleeve.pressed import PressedLoop

_RADII = np.linspace(0.0, 1.0, 33)
_ANGLES = np.linspace(0.0, np.pi / 2, 65)


@dataclass(frozen=True, slots=True)
class Seat:
    """The beam that a sleeve sits on.

    Attributes
    ----------
    width_m, thickness_m : float
        Of the beam.
    fabric_m : float
        Thickness of the fabric.

    Raises
    ------
    SceneError
        When a length is not greater than 0.
    """

    width_m: float
    thickness_m: float
    fabric_m: float

    def __post_init__(self) -> None:
        for key in ("width_m", "thickness_m", "fabric_m"):
            value: float = getattr(self, key)
            if not (value > 0 and np.isfinite(value)):
                raise SceneError(f"{key} = {value:g}: must be greater than 0 and finite")

    def valley_m(self, pressed: PressedLoop) -> float:
        """Height of the valleys' centreline over the beam's middle.

        Beside the beam the valleys of both rows lie on each other. They stand higher where the
        wire, or the fabric in the loop, would else run into the beam.

        Raises
        ------
        SceneError
            When the beam is wider than the loop.
        """
        wire = pressed.cell.materials.wire_diameter_m
        if self.width_m + wire > pressed.valley_distance_m:
            raise SceneError(
                f"the beam is {self.width_m * 1e3:.4g} mm wide, and at a pitch of "
                f"{pressed.pitch_m * 1e3:.4g} mm the sleeve's loops leave "
                f"{(pressed.valley_distance_m - wire) * 1e3:.4g} mm inside their wire; "
                "take a narrower beam or larger loops"
            )
        radius, angle = (grid.ravel() for grid in np.meshgrid(_RADII, _ANGLES))
        point = pressed.points_m(radius, angle)
        thick = np.where(radius == 1.0, wire, self.fabric_m)
        over = np.abs(point[:, 1]) <= self.width_m / 2
        valley = pressed.points_m(np.ones(1), np.array([np.pi / 2]))[0, 2]
        lacking = (self.thickness_m + thick[over]) / 2 - (point[over, 2] - valley)
        return max(wire / 2, float(lacking.max(initial=0.0)))

    def crest_m(self, pressed: PressedLoop) -> float:
        """Height of the crests over the beam's middle: the arm of the row's push.

        Raises
        ------
        SceneError
            When the beam is wider than the loop.
        """
        return self.valley_m(pressed) + pressed.crest_height_m

    def tip_m(self, pressed: PressedLoop) -> float:
        """Height of the wire's outermost point over the beam's face.

        Raises
        ------
        SceneError
            When the beam is wider than the loop.
        """
        top = float(pressed.points_m(np.ones_like(_ANGLES), _ANGLES)[:, 2].max())
        valley = float(pressed.points_m(np.ones(1), np.array([np.pi / 2]))[0, 2])
        thick = (pressed.cell.materials.wire_diameter_m - self.thickness_m) / 2
        return self.valley_m(pressed) + top - valley + thick
