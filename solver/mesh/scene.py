"""What the mesh can solve: one loop, or a grid of loops that touch."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from enum import StrEnum

from solver.errors import SceneError
from solver.mesh.array_mesh import Between, Grid
from solver.mesh.rod_energy import WireStiffness
from solver.scene import LoopScene

LARGEST_GRID = 400
"""Loops; as far as the mesh has been tried."""


class Contact(StrEnum):
    """How loops hold each other where they touch."""

    BONDED = "bonded"
    """Side by side: the wires share the point of contact and their tangents stay parallel."""
    POINT = "point"
    """The wires share the point of contact and may turn about it."""


@dataclass(frozen=True, slots=True)
class ArrayScene:
    """A grid of equal loops at the pitch at which they touch, on one piece of fabric.

    Attributes
    ----------
    loop : LoopScene
        Each of the loops.
    rows, columns : int
        Loops along y and along x.
    between : Between
        Whether the fabric in the gaps that four loops enclose is cut away or kept.
    contact : Contact
    wires : tuple of WireStiffness
        Of each loop, row by row; empty when all are as in ``loop``.

    Raises
    ------
    SceneError
        When a number is out of its range.
    """

    loop: LoopScene
    rows: int
    columns: int
    between: Between
    contact: Contact = Contact.BONDED
    wires: tuple[WireStiffness, ...] = ()

    def __post_init__(self) -> None:
        if self.rows < 1 or self.columns < 1 or self.rows * self.columns > LARGEST_GRID:
            raise SceneError(
                f"{self.rows} × {self.columns} loops: there must be 1 to {LARGEST_GRID} of them"
            )
        if self.wires and len(self.wires) != self.rows * self.columns:
            raise SceneError(
                f"{len(self.wires)} wires for {self.rows * self.columns} loops: give one for each, "
                "row by row"
            )
        check_wires(self.wires)

    @property
    def equal_loop(self) -> LoopScene | None:
        """One of the loops with its own wire, where all are alike."""
        first, *others = self.stiffness
        if any(wire != first for wire in others):
            return None
        return replace(
            self.loop,
            beta=first.beta,
            axial_stiffness=first.axial_stiffness,
            natural_curvature=first.natural_curvature,
            twist_ratio=first.twist_ratio,
        )

    def twisted(self, twist_ratio: float) -> ArrayScene:
        """Give the same with that ρ of every wire."""
        wires = tuple(replace(wire, twist_ratio=twist_ratio) for wire in self.wires)
        return replace(self, loop=replace(self.loop, twist_ratio=twist_ratio), wires=wires)

    @property
    def grid(self) -> Grid:
        """Arrangement of the loops."""
        return Grid(self.rows, self.columns)

    @property
    def gaps_kept(self) -> bool:
        """Whether fabric couples the loops; a single row encloses no gaps that could have any."""
        return self.between is Between.KEPT and min(self.rows, self.columns) > 1

    @property
    def stiffness(self) -> tuple[WireStiffness, ...]:
        """Each loop's wire, row by row."""
        return self.wires or (loop_wire(self.loop),) * (self.rows * self.columns)


def check_wires(wires: tuple[WireStiffness, ...]) -> None:
    """Refuse wires with numbers out of their range, by `SceneError` with the wire's number."""
    for k, wire in enumerate(wires):
        if not (0 < wire.beta < math.inf and 0 < wire.axial_stiffness < math.inf):
            raise SceneError(
                f"wire {k}: beta and axial_stiffness must be greater than 0 and finite"
            )
        if not 0 <= wire.natural_curvature < math.inf:
            raise SceneError(f"wire {k}: natural_curvature must be at least 0 and finite")
        if not 0 <= wire.twist_ratio < math.inf:
            raise SceneError(f"wire {k}: twist_ratio must be at least 0 and finite")
        if wire.twist_ratio > 0 and wire.natural_curvature > 0:
            raise SceneError(
                f"wire {k}: twist is modelled for a straight wire only; let twist_ratio or "
                "natural_curvature be 0"
            )


def loop_wire(scene: LoopScene) -> WireStiffness:
    """Wire of a loop."""
    return WireStiffness(
        scene.beta, scene.axial_stiffness, scene.natural_curvature, scene.twist_ratio
    )
