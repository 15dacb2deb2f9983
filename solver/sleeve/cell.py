"""One loop of a sleeve, whose neighbours along the beam are all like it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from solver.errors import SceneError
from solver.materials import LoopMaterials
from solver.reading import Reading
from solver.scene import LoopScene


@dataclass(frozen=True, slots=True)
class SleeveCell:
    """A loop in a row along a beam, bonded to its neighbours where they touch.

    The beam lies along x. Neighbours touch at the loop's two crests; its two valleys lie on both
    sides of the beam, where the row is tied to the row on the beam's other face.

    Attributes
    ----------
    materials : LoopMaterials
    strain, poisson : float
        Prestrain and Poisson's ratio of the fabric.
    reading : Reading
        Of the fabric's energy.
    stripe_m : float or None
        Length of the stripe of thread across the loop's centre, from valley to valley: it does not
        stretch, and hangs slack where the valleys are nearer. None is a loop without one.

    Raises
    ------
    SceneError
        When the stripe is no length, or too long to hold anything.
    """

    materials: LoopMaterials
    strain: float
    poisson: float
    reading: Reading = Reading.PLANE_STRESS
    stripe_m: float | None = None

    def __post_init__(self) -> None:
        longest = math.pi * self.materials.loop_radius_m
        if self.stripe_m is not None and not 0 < self.stripe_m < longest:
            raise SceneError(
                f"stripe_m = {self.stripe_m:g}: must be greater than 0 and less than {longest:g}, "
                "half of the wire's length"
            )

    @property
    def scene(self) -> LoopScene:
        """The dimensionless loop."""
        return LoopScene(
            strain=self.strain,
            beta=self.materials.beta,
            poisson=self.poisson,
            reading=self.reading,
            axial_stiffness=self.materials.axial_stiffness,
        )

    def with_wire_modulus(self, modulus_Pa: float) -> SleeveCell:  # noqa: N803 - the unit's name
        """Give the same loop at another temperature."""
        return replace(self, materials=replace(self.materials, wire_modulus_Pa=modulus_Pa))
