"""What all scenes that the mesh solves have: fabric, wires, and their thickness."""

from __future__ import annotations

import math
from dataclasses import replace

from solver.mesh.curve import Ellipse, length
from solver.mesh.rod_energy import WireStiffness
from solver.mesh.scene import ArrayScene, loop_wire
from solver.mesh.sheet import SheetScene, SheetWire
from solver.round_wire import round_diameter
from solver.scene import LoopScene

MeshScene = LoopScene | ArrayScene | SheetScene


def fabric_of(scene: MeshScene) -> LoopScene:
    """Give the loop whose fabric is the scene's."""
    return scene if isinstance(scene, LoopScene) else scene.loop


def wires_of(scene: MeshScene) -> tuple[WireStiffness, ...]:
    """Each wire's β, k, κ0 and ρ."""
    return (loop_wire(scene),) if isinstance(scene, LoopScene) else scene.stiffness


def size_of(scene: MeshScene) -> float:
    """Mean radius of the loops in the scene's unit of length."""
    return scene.size if isinstance(scene, SheetScene) else 1.0


def with_strain(scene: MeshScene, strain: float) -> MeshScene:
    """Give the same on fabric stretched by so much."""
    if isinstance(scene, LoopScene):
        return replace(scene, strain=strain)
    return replace(scene, loop=replace(scene.loop, strain=strain))


def twisted(scene: MeshScene, twist_ratio: float) -> MeshScene:
    """Give the same with that ρ of every wire."""
    if isinstance(scene, LoopScene):
        return replace(scene, twist_ratio=twist_ratio)
    return scene.twisted(twist_ratio)


def thickest_wire(scene: MeshScene) -> float:
    """Diameter of the thickest wire, in the scene's unit of length; see `solver.round_wire`."""
    if isinstance(scene, SheetScene):
        widths = [_half_width(wire, scene.size) for wire in scene.wires]
    else:
        widths = [min(fabric_of(scene).semi_axes)] * len(wires_of(scene))
    return max(
        round_diameter(wire.beta, wire.axial_stiffness, width)
        for wire, width in zip(wires_of(scene), widths, strict=True)
    )


def _half_width(wire: SheetWire, size: float) -> float:
    """Half the width of a loop; of one that is no ellipse, its mean radius; else the scene's."""
    if isinstance(wire.curve, Ellipse):
        return min(wire.curve.semi_axes)
    return length(wire.curve) / math.tau if wire.curve.closed else size
