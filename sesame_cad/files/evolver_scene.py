"""What a Surface Evolver datafile draws: a scene's mesh, its wires, and where it starts."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import pi

import numpy as np
from numpy.typing import NDArray

from sesame_cad.files.evolver_pins import Pin, saddle_pins, wide_pins
from solver.mesh.curve import Ellipse
from solver.mesh.drawing import SEGMENTS
from solver.mesh.problem import MeshProblem, loop_problem, sheet_problem
from solver.mesh.sheet import SheetScene
from solver.mesh.sheet_start import AMPLITUDE, agreed_direction, saddle_lifts
from solver.mesh.triangulation import Mesh, embedded, prolonged
from solver.scene import LoopScene

Vectors = NDArray[np.float64]

EvolverScene = LoopScene | SheetScene


@dataclass(frozen=True)
class Drawn:
    """A scene as the solver itself meshes it.

    Attributes
    ----------
    scene : LoopScene or SheetScene
    problem : MeshProblem
    start_height : float
        Of the start's crests, over a loop's radius.
    """

    scene: EvolverScene
    problem: MeshProblem
    start_height: float

    @property
    def loop(self) -> LoopScene:
        """Whose fabric is the scene's."""
        return self.scene.loop if isinstance(self.scene, SheetScene) else self.scene

    @property
    def mesh(self) -> Mesh:
        """The finest."""
        return self.problem.meshes[-1]

    @property
    def touching(self) -> bool:
        """Whether wires share points."""
        return isinstance(self.scene, SheetScene) and bool(self.scene.joints)

    @property
    def size(self) -> float:
        """Mean length of the loops over 2π, in units of R."""
        return self.scene.size if isinstance(self.scene, SheetScene) else 1.0

    @property
    def _round(self) -> bool:
        return isinstance(self.scene, LoopScene) and self.scene.axis_ratio == 1

    @cached_property
    def _start(self) -> Vectors:
        if isinstance(self.scene, SheetScene):
            return _lifted(self.scene, self.problem.meshes, self.start_height)
        positions = embedded(self.mesh.points)
        x, y = self.mesh.points.T
        # an ellipse's lowest saddle has its crests between its axes
        saddle = x * x - y * y if self._round else 2 * x * y / np.prod(self.scene.semi_axes)
        positions[:, 2] = self.start_height * saddle
        return positions

    @cached_property
    def pins(self) -> tuple[Pin, ...]:
        """What holds the shape in place."""
        if self._round:
            return saddle_pins(self.mesh.wires[0].vertices)
        return wide_pins(self._start, level=self.problem.levelling == 0)

    @property
    def positions(self) -> Vectors:
        """Start (n, 3): each loop a low saddle, on the pins to the last digit."""
        positions = self._start.copy()
        for pin in self.pins:
            positions[pin.vertex, pin.axis] = pin.value
        return positions

    @property
    def pulls(self) -> Vectors:
        """Stiffness (n,) of the springs that draw each vertex to the plane, in units of E_f t."""
        return self.problem.levelling * self.mesh.vertex_weights / (pi * self.size**2)


def drawn(scene: EvolverScene, refinements: int, start_height: float) -> Drawn:
    """Mesh a scene.

    Raises
    ------
    SceneError
        When it cannot be meshed.
    """
    if isinstance(scene, LoopScene):
        return Drawn(scene, loop_problem(scene, refinements), start_height)
    return Drawn(scene, sheet_problem(scene, refinements, SEGMENTS), start_height)


def scene_faults(scene: EvolverScene) -> list[str]:
    """What of a scene a datafile has no words for."""
    loop = scene.loop if isinstance(scene, SheetScene) else scene
    own = scene.stiffness if isinstance(scene, SheetScene) else (scene,)
    curves = [wire.curve for wire in scene.wires] if isinstance(scene, SheetScene) else []
    said = (
        (
            f"modulus_ratio = {loop.modulus_ratio:g}",
            "fabric that is equally stiff both ways",
            loop.modulus_ratio == 1,
        ),
        *(
            (f"natural_curvature = {k:g}", "wire that is straight by nature", k == 0)
            for k in sorted({wire.natural_curvature for wire in own})
        ),
        *(
            (f"twist_ratio = {rho:g}", "wire without twist", rho == 0)
            for rho in sorted({wire.twist_ratio for wire in own})
        ),
        # Evolver's stars about vertices of a wire with fabric on both sides run away
        (
            f"alpha = {loop.alpha:g}",
            "arrays of fabric without bending stiffness",
            loop.alpha == 0 or len(own) == 1,
        ),
        ("a wire with two ends", "loops", all(curve.closed for curve in curves)),
        (
            "a wire along a free curve",
            "circles and ellipses",
            all(isinstance(curve, Ellipse) or not curve.closed for curve in curves),
        ),
    )
    return [
        f"{what}: Surface Evolver's datafile is written for {only} only"
        for what, only, allowed in said
        if not allowed
    ]


def _lifted(scene: SheetScene, meshes: tuple[Mesh, ...], start_height: float) -> Vectors:
    """Positions (n, 3) of the finest mesh, each loop a saddle.

    Saddles of different size meet in kinks, which must not get sharper with the mesh: they are
    lifted on the coarsest.
    """
    crests = np.full(len(scene.wires), _crest(scene))
    positions = embedded(meshes[0].points)
    positions[:, 2] = start_height / AMPLITUDE * saddle_lifts(meshes[0], crests)
    for coarse, fine in pairwise(meshes):
        positions = prolonged(coarse, fine, positions)
    return positions


def _crest(scene: SheetScene) -> float:
    """Direction of all saddles' crests in radians: where they fit best, or of one ellipse alone."""
    curve = scene.wires[0].curve
    if scene.joints or not isinstance(curve, Ellipse):
        return agreed_direction(scene)
    long, short = curve.semi_axes
    return curve.angle + pi / 4 * (long != short)
