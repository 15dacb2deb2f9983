"""Any plane arrangement of wires, joined where they touch, on fabric that spans what is asked."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from solver.errors import SceneError
from solver.mesh.curve import PlaneCurve, Point, direction, nearest
from solver.mesh.drawing import Drawing, Knot, mean_size
from solver.mesh.plane_mesh import Between, FabricRegions
from solver.mesh.rod_energy import WireStiffness
from solver.mesh.scene import LARGEST_GRID, Contact, check_wires
from solver.scene import LoopScene

_PARALLEL = 0.02
"""Largest angle, in radians, of tangents that a bond can hold side by side."""


@dataclass(frozen=True)
class SheetWire:
    """A wire that lies flat along a curve.

    Attributes
    ----------
    curve : PlaneCurve
    stiffness : WireStiffness
        β, k, κ0 and ρ in the units of the scene.
    spanned : bool
        Whether fabric spans what a closed wire encloses.
    """

    curve: PlaneCurve
    stiffness: WireStiffness
    spanned: bool = True


@dataclass(frozen=True)
class Joint:
    """A point in which wires hold each other.

    A bond holds their tangents parallel, too: the wires must touch there, not cross or end.
    """

    wires: tuple[int, ...]
    point: Point
    contact: Contact = Contact.BONDED


@dataclass(frozen=True)
class SheetScene:
    """Wires and fabric; lengths in any unit R, energies in units of E_f t R².

    Attributes
    ----------
    loop : LoopScene
        Its fabric is the scene's: strain, poisson, reading, modulus_ratio and alpha. Its own wire
        and shape play no part.
    wires : tuple of SheetWire
    joints : tuple of Joint
    between : Between
        What becomes of the gaps that wires enclose between them.
    kept, cut : tuple of tuple
        A point in each region that has fabric, or has none, against that and ``spanned``.
    outlines : tuple of PlaneCurve
        Closed curves that bound fabric round the loops, without a wire.

    Raises
    ------
    SceneError
        When there is no wire, a number is out of its range, or a joint cannot hold.
    """

    loop: LoopScene
    wires: tuple[SheetWire, ...]
    joints: tuple[Joint, ...] = ()
    between: Between = Between.CUT
    kept: tuple[Point, ...] = ()
    cut: tuple[Point, ...] = ()
    outlines: tuple[PlaneCurve, ...] = ()

    def __post_init__(self) -> None:
        if not 1 <= len(self.wires) <= LARGEST_GRID:
            raise SceneError(f"{len(self.wires)} wires: there must be 1 to {LARGEST_GRID} of them")
        check_wires(self.stiffness)
        if not all(outline.closed for outline in self.outlines):
            raise SceneError("an outline of fabric must be a closed curve")
        for number, joint in enumerate(self.joints):
            self._check_joint(number, joint)

    def _check_joint(self, number: int, joint: Joint) -> None:
        known = all(0 <= k < len(self.wires) for k in joint.wires)
        if len(set(joint.wires)) < max(2, len(joint.wires)) or not known:
            raise SceneError(
                f"joint {number} of wires {joint.wires}: name two or more different wires, "
                f"0 to {len(self.wires) - 1}"
            )
        if not all(np.isfinite(joint.point)):
            raise SceneError(f"joint {number} at {joint.point}: must be finite")
        if joint.contact is Contact.POINT:
            return
        curves = [self.wires[k].curve for k in joint.wires]
        places = [nearest(curve, joint.point)[0] for curve in curves]
        if any(not c.closed and p in {0.0, 1.0} for c, p in zip(curves, places, strict=True)):
            raise SceneError(
                f"joint {number}: a wire ends there, which no bond can hold; let it be a point"
            )
        along = [direction(curve, place) for curve, place in zip(curves, places, strict=True)]
        apart = max(abs(float(along[0][0] * t[1] - along[0][1] * t[0])) for t in along)
        if apart > _PARALLEL:
            raise SceneError(
                f"joint {number}: the wires cross at {np.degrees(np.arcsin(apart)):.3g} degrees; "
                "a bond holds wires that touch, let it be a point"
            )

    @cached_property
    def size(self) -> float:
        """Mean length of the closed wires, or of all where none is closed, over 2π; units of R."""
        return mean_size(tuple(wire.curve for wire in self.wires))

    @property
    def drawing(self) -> Drawing:
        """Curves and joints."""
        curves = tuple(wire.curve for wire in self.wires)
        knots = tuple(Knot(joint.wires, joint.point) for joint in self.joints)
        return Drawing((*curves, *self.outlines), knots, len(self.outlines))

    @property
    def regions(self) -> FabricRegions:
        """Where fabric is."""
        spanned = tuple(wire.spanned for wire in self.wires)
        return FabricRegions(spanned, self.between, self.kept, self.cut)

    @property
    def stiffness(self) -> tuple[WireStiffness, ...]:
        """Each wire's."""
        return tuple(wire.stiffness for wire in self.wires)

    def twisted(self, twist_ratio: float) -> SheetScene:
        """Give the same with that ρ of every wire."""
        wires = tuple(
            replace(w, stiffness=replace(w.stiffness, twist_ratio=twist_ratio)) for w in self.wires
        )
        return replace(self, wires=wires)

    def in_units_of(self, unit: float) -> SheetScene:
        """Give the same scene with lengths in a unit that is so many of the present one.

        β goes with the third power of the unit, the axial stiffness with the first: docs/theory.md,
        eq. (11).
        """
        shrink = 1 / unit

        def points(of: tuple[Point, ...]) -> tuple[Point, ...]:
            return tuple((shrink * x, shrink * y) for x, y in of)

        wires = tuple(
            replace(w, curve=w.curve.scaled(shrink), stiffness=_rescaled(w.stiffness, unit))
            for w in self.wires
        )
        joints = tuple(replace(j, point=points((j.point,))[0]) for j in self.joints)
        outlines = tuple(outline.scaled(shrink) for outline in self.outlines)
        kept, cut = points(self.kept), points(self.cut)
        loop = replace(self.loop, alpha=self.loop.alpha * shrink**2)
        return SheetScene(loop, wires, joints, self.between, kept, cut, outlines)


def _rescaled(wire: WireStiffness, unit: float) -> WireStiffness:
    """Give a wire's numbers in another unit of length; β = E_w I_w/(2 E_f t R³)."""
    return replace(
        wire,
        beta=wire.beta / unit**3,
        axial_stiffness=wire.axial_stiffness / unit,
        natural_curvature=wire.natural_curvature * unit,
    )
