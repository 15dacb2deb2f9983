"""An array's shape at one temperature, all loops solved together as they act on each other."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from math import isfinite
from time import perf_counter
from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import NDArray

from patterns.groups import touching_groups
from patterns.layout import Layout
from patterns.loop import Loop
from sesame_cad.omissions import material_omissions
from sesame_cad.sheet_shape import SheetShape, sheet_shape
from sesame_cad.specification import Specification
from sesame_cad.specification.wiring_faults import circuit_loops
from sesame_cad.state import REMEDY, loop_materials, loop_scene
from solver.errors import NotConvergedError, SceneError
from solver.ladder.answer import Answer
from solver.ladder.choose import solve_scene
from solver.ladder.fidelity import Fidelity
from solver.materials import LoopMaterials
from solver.mesh.curve import Ellipse
from solver.mesh.plane_mesh import Between
from solver.mesh.rod_energy import WireStiffness
from solver.mesh.sheet import Joint, SheetScene, SheetWire
from solver.mesh.triangulation import embedded
from solver.mesh.upright import upright
from solver.omitted import OmittedTerm

if TYPE_CHECKING:
    from sesame_cad.specification.wire import WireSection
    from solver.mesh.equilibrium import MeshEquilibrium

Vectors = NDArray[np.float64]

LEAST_TOLERANCE = 0.1
"""Relative error of the height that coupled shapes are allowed at the least: finer meshes of
arrays take minutes."""

CHANGES_PER_ERROR = 3.0
"""The mesh takes a third of its last change for its error, as a second-order one is on fine meshes;
on meshes as coarse as those of arrays the whole change is the safer word."""

CHORD_TOLERANCE_MM = 0.05
"""The wires' chords keep this near the smooth curve through the solved vertices."""


@dataclass(frozen=True)
class CoupledState:
    """The array cold or hot, each loop with its own shape.

    Attributes
    ----------
    name : str
        ``"cold"`` or ``"hot"``.
    answer : Answer
        The solved scene, in units of the largest loop's radius.
    materials : LoopMaterials
        Of that loop with the wire of most circuits: what gives the units their size.
    contacts : tuple of (int, int)
        Loops that touch.
    diameters_mm : tuple of float
        Of each loop's wire.
    omitted : tuple of OmittedTerm
    seconds : float
        What the solve took.
    """

    name: str
    answer: Answer
    materials: LoopMaterials
    contacts: tuple[tuple[int, int], ...]
    diameters_mm: tuple[float, ...]
    omitted: tuple[OmittedTerm, ...]
    seconds: float

    @property
    def radius_mm(self) -> float:
        """The largest loop's radius as it was laid: the unit of length."""
        return self.materials.loop_radius_m * 1e3

    @property
    def found(self) -> MeshEquilibrium:
        """The solved mesh."""
        return cast("MeshEquilibrium", self.answer.equilibrium)

    @property
    def loops(self) -> int:
        """Number of loops."""
        return len(self.diameters_mm)

    @property
    def buckled(self) -> bool:
        """Whether the array is not flat."""
        return self.answer.buckled

    @property
    def height_error(self) -> float | None:
        """Error of the heights, relative to them; None where no coarser mesh tells it."""
        error = CHANGES_PER_ERROR * self.answer.height_error
        return error if isfinite(error) else None

    @property
    def height_mm(self) -> float:
        """Rise of the whole array's wires along the loops' common axis."""
        return self.found.height * self.radius_mm

    @property
    def loop_heights_mm(self) -> tuple[float, ...]:
        """Rise of each loop along its own axis."""
        return tuple((self.found.loop_heights * self.radius_mm).tolist())

    @property
    def pitch_mm(self) -> float | None:
        """Mean distance after release of the centres of touching loops; None without any."""
        return self.pitch_at_mm(self.found.positions)

    def pitch_at_mm(self, positions: Vectors) -> float | None:
        """Give the same for other positions (n, 3) of the mesh's vertices, in units of length."""
        if not self.contacts:
            return None
        places = positions * self.radius_mm
        centres = np.array([places[wire.vertices].mean(axis=0) for wire in self.found.mesh.wires])
        one, other = np.array(self.contacts).T
        return float(np.linalg.norm(centres[other] - centres[one], axis=1).mean())

    @property
    def array_energy_mJ(self) -> float:  # noqa: N802 - the unit's name
        """Energy of all loops together."""
        return self.found.energy * self.materials.energy_unit_J * 1e3

    @property
    def energy_mJ(self) -> float:  # noqa: N802 - the unit's name
        """Energy of a loop, the mean of all."""
        return self.array_energy_mJ / self.loops

    @property
    def footprint_mm(self) -> tuple[float, float]:
        """Width and depth over the outer wires' centrelines, seen from above."""
        return self.shape.footprint_mm

    @cached_property
    def shape(self) -> SheetShape:
        """As it lies on a table."""
        return self._drawn(upright(self.found.mesh, self.found.positions))

    @cached_property
    def flat_shape(self) -> SheetShape:
        """As it is sewn."""
        return self._drawn(embedded(self.found.mesh.points))

    def _drawn(self, positions: Vectors) -> SheetShape:
        unit = self.radius_mm
        return sheet_shape(
            self.found.mesh, positions * unit, unit, self.diameters_mm, CHORD_TOLERANCE_MM
        )


def coupled_scene(spec: Specification, layout: Layout, state: str) -> SheetScene:
    """Give the scene of all loops, in units of the largest loop's radius.

    Parameters
    ----------
    state : str
        ``"cold"`` or ``"hot"``: which of the wires' moduli.

    Raises
    ------
    SceneError
        When its numbers lie outside the model, or its loops do not hang together.
    """
    _check_one_piece(layout)
    unit_mm = spec.layout.diameter_mm / 2
    materials = [_materials(spec, wire, state) for wire in loop_wires(spec, len(layout.loops))]
    wires = tuple(
        SheetWire(_curve(loop, unit_mm), WireStiffness(own.beta, own.axial_stiffness))
        for loop, own in zip(layout.loops, materials, strict=True)
    )
    joints = tuple(
        Joint((one.first, one.second), (one.x_mm / unit_mm, one.y_mm / unit_mm))
        for one in layout.contacts
    )
    between = Between(spec.layout.between)
    return SheetScene(loop_scene(spec, materials[0]), wires, joints, between)


def _curve(loop: Loop, unit_mm: float) -> Ellipse:
    long, short = loop.semi_axes_mm
    centre = (loop.x_mm / unit_mm, loop.y_mm / unit_mm)
    return Ellipse(centre, (long / unit_mm, short / unit_mm), loop.axis_rad)


def loop_wires(spec: Specification, count: int) -> tuple[WireSection, ...]:
    """Wire of each loop, in the order of the layout."""
    wires = dict.fromkeys(range(count), spec.wire)
    for one in spec.wiring.circuits:
        wires.update(dict.fromkeys(circuit_loops(one, spec.layout), one.wire(spec.wire)))
    return tuple(wires[k] for k in range(count))


def solve_coupled(
    spec: Specification, layout: Layout, state: str, progress: Callable[[str], None]
) -> CoupledState:
    """Solve the array at one temperature.

    Raises
    ------
    SceneError
        When the materials or loops lie outside the model.
    NotConvergedError
        When there is no shape to rely on.
    """
    scene = coupled_scene(spec, layout, state)
    start = perf_counter()
    try:
        answer = solve_scene(
            scene,
            fidelity=Fidelity.AUTO,
            tolerance=max(spec.model.tolerance, LEAST_TOLERANCE) / CHANGES_PER_ERROR,
            refinement=spec.model.refinement or None,
            told=lambda doing: progress(f"{state} shape of {len(layout.loops)} loops: {doing}"),
        )
    except NotConvergedError as error:
        raise NotConvergedError(f"{state} shape: {error} ({REMEDY})") from None
    seconds = perf_counter() - start
    materials = _materials(spec, spec.wire, state)
    return CoupledState(
        state,
        answer,
        materials,
        tuple((contact.first, contact.second) for contact in layout.contacts),
        tuple(wire.diameter_mm for wire in loop_wires(spec, len(layout.loops))),
        (*answer.omitted, *material_omissions(spec, materials)),
        seconds,
    )


def _materials(spec: Specification, wire: WireSection, state: str) -> LoopMaterials:
    modulus = wire.modulus_cold_GPa if state == "cold" else wire.modulus_hot_GPa
    own = loop_materials(spec, modulus)
    return replace(own, wire_diameter_m=wire.diameter_mm / 1e3)


def _check_one_piece(layout: Layout) -> None:
    if len(touching_groups(layout)) > 1:
        raise SceneError(
            "the loops lie in groups that do not touch, and a coupled shape is that of one group: "
            'design each by itself, or let layout.shape be "none"'
        )
