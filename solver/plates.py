"""What holds a loop: two rigid plates, or neighbours to which its crests are bonded."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

from solver.errors import SceneError

LARGEST_PITCH = math.pi
"""Half of the wire's length: a loop drawn out to a double straight line."""


class PlateAxis(StrEnum):
    """The normal of the plates.

    ``lateral``: x, through the saddle's crests, so that the loop stands between the plates;
    ``across``: y, through its valleys; ``height``: z, so that the loop is pressed flat.
    """

    LATERAL = "lateral"
    ACROSS = "across"
    HEIGHT = "height"

    @property
    def component(self) -> int:
        """Which coordinate it is."""
        return list(PlateAxis).index(self)


@dataclass(frozen=True, slots=True)
class Plates:
    """Two rigid plates without friction, which push and never pull.

    Attributes
    ----------
    gap : float
        Distance of the plates' surfaces in units of R, greater than ``wire_diameter``.
    axis : PlateAxis
    wire_diameter : float
        In units of R, at least 0: the plates touch the wire's surface, not its centreline.

    Raises
    ------
    SceneError
        When a number is out of its range.
    """

    gap: float
    axis: PlateAxis = PlateAxis.LATERAL
    wire_diameter: float = 0.0

    def __post_init__(self) -> None:
        if not (self.wire_diameter >= 0 and math.isfinite(self.wire_diameter)):
            raise SceneError(f"wire_diameter = {self.wire_diameter:g}: must be at least 0")
        if not (self.gap > self.wire_diameter and math.isfinite(self.gap)):
            raise SceneError(
                f"gap = {self.gap:g}: must be finite and greater than the wire's diameter, "
                f"{self.wire_diameter:g}, or there is no room for the wire"
            )

    @property
    def wire_reach(self) -> float:
        """How far the wire's centreline may lie from the middle between the plates."""
        return (self.gap - self.wire_diameter) / 2

    @property
    def fabric_reach(self) -> float:
        """How far the fabric may, whose thickness is that of a surface."""
        return self.gap / 2


@dataclass(frozen=True, slots=True)
class Pitch:
    """Prescribed distances of opposite points of the wire, as bonded neighbours hold them.

    Attributes
    ----------
    pitch : float
        Distance along x of the two crests, in units of R.
    width : float, optional
        Distance along y of the two valleys; free when left out.

    Raises
    ------
    SceneError
        When a number is out of its range.
    """

    pitch: float
    width: float | None = None

    def __post_init__(self) -> None:
        for key, value in (("pitch", self.pitch), ("width", self.width)):
            if value is not None and not 0 < value < LARGEST_PITCH:
                raise SceneError(
                    f"{key} = {value:g}: must be greater than 0 and less than pi, "
                    "half of the wire's length"
                )


@dataclass(frozen=True, slots=True)
class Contact:
    """Mirror images of one point that press on the plates.

    Attributes
    ----------
    radius, angle_rad : float
        Where the point is in the flat disc; radius 1 is the wire. The others are its images in the
        loop's mirrors x = 0 and y = 0.
    force : float
        With which it and its images together press on one plate, units of E_f t R.
    bend : float
        How quickly the wire leaves the plate on both sides, −∂²x/∂θ²; 0 where they touch along a
        line.
    upper : bool
        Whether they press on the plate at the greater coordinate; of plates across x or y, half of
        them do, and half on the other.
    """

    radius: float
    angle_rad: float
    force: float
    bend: float
    upper: bool
