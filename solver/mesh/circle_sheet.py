"""Scenes of circles that touch: rows, brick and hexagonal arrays, lists of circles."""

from __future__ import annotations

import numpy as np

from solver.errors import SceneError
from solver.mesh.array_mesh import grid_curves, grid_knots
from solver.mesh.curve import Point, circle
from solver.mesh.plane_mesh import Between
from solver.mesh.rod_energy import WireStiffness
from solver.mesh.scene import ArrayScene, Contact, loop_wire
from solver.mesh.sheet import Joint, SheetScene, SheetWire
from solver.scene import LoopScene


def circle_scene(
    loop: LoopScene,
    centres: tuple[Point, ...],
    radii: tuple[float, ...],
    contacts: tuple[tuple[int, int], ...],
    *,
    between: Between = Between.CUT,
    contact: Contact = Contact.BONDED,
    wires: tuple[WireStiffness, ...] = (),
) -> SheetScene:
    """Circles of wire spanned by fabric, joined where pairs of them touch from outside.

    Parameters
    ----------
    loop : LoopScene
        Fabric, and the wire of circles for which ``wires`` gives none.
    centres : tuple of tuple
    radii : tuple of float
        In the unit in which the wires' numbers are, like the centres.
    contacts : tuple of tuple
        Pairs of circles, by their numbers.
    wires : tuple of WireStiffness
        One for each circle, or none.

    Raises
    ------
    SceneError
        When the numbers of centres, radii and wires differ, or a pair does not touch.
    """
    count = len(centres)
    if len(radii) != count or len(wires) not in {0, count}:
        raise SceneError(
            f"{count} centres, {len(radii)} radii and {len(wires)} wires: give one for each circle"
        )
    stiffness = wires or (loop_wire(loop),) * count
    drawn = tuple(
        SheetWire(circle(centre, radius), wire)
        for centre, radius, wire in zip(centres, radii, stiffness, strict=True)
    )
    joints = tuple(
        Joint(pair, _between(centres, radii, pair), contact=contact) for pair in contacts
    )
    return SheetScene(loop, drawn, joints, between)


def _between(centres: tuple[Point, ...], radii: tuple[float, ...], pair: tuple[int, int]) -> Point:
    """Point on the line of two centres that divides it as the radii."""
    if not all(0 <= k < len(centres) for k in pair):
        raise SceneError(f"contact {pair}: circles are 0 to {len(centres) - 1}")
    (one, other), (a, b) = (np.array([centres[k] for k in pair]), (radii[k] for k in pair))
    x, y = one + (other - one) * (a / (a + b))
    return float(x), float(y)


def sheet_of(scene: ArrayScene) -> SheetScene:
    """Give a grid of loops as the general scene it is."""
    grid, ratio = scene.grid, scene.loop.axis_ratio
    drawn = tuple(
        SheetWire(curve, wire)
        for curve, wire in zip(grid_curves(grid, ratio), scene.stiffness, strict=True)
    )
    joints = tuple(
        Joint(knot.curves, knot.point, scene.contact) for knot in grid_knots(grid, ratio)
    )
    return SheetScene(scene.loop, drawn, joints, scene.between)
