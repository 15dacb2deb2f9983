"""An array's shape at one temperature, where one loop is all there is to solve."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from patterns.lattice import Cell
from sesame_cad.omissions import omissions
from sesame_cad.specification import Specification
from solver.compact import solve_loop
from solver.equilibrium import Equilibrium
from solver.errors import NotConvergedError
from solver.materials import LoopMaterials
from solver.omitted import OmittedTerm
from solver.reading import Reading
from solver.scene import LoopScene

Vectors = NDArray[np.float64]

_EDGE_POINTS = 720

REMEDY = 'layout.shape = "none" makes the stitch and cut files alone'


@dataclass(frozen=True)
class CellState:
    """The array cold or hot. All its loops have the same shape, and stand side by side.

    Attributes
    ----------
    name : str
        ``"cold"`` or ``"hot"``.
    equilibrium : Equilibrium
        The solved loop, in units of its radius.
    materials : LoopMaterials
        What gives the units their size.
    omitted : tuple of OmittedTerm
    seconds : float
        What the solve took.
    cells : tuple of Cell
        Row and column of each loop.
    """

    name: str
    equilibrium: Equilibrium
    materials: LoopMaterials
    omitted: tuple[OmittedTerm, ...]
    seconds: float
    cells: tuple[Cell, ...]

    @property
    def radius_mm(self) -> float:
        """Radius with which the loops were laid."""
        return self.materials.loop_radius_m * 1e3

    @property
    def buckled(self) -> bool:
        """Whether the loops are not flat."""
        return self.equilibrium.buckled

    @property
    def height_mm(self) -> float:
        """Rise of the wire's centreline from valley to crest."""
        return self.equilibrium.shape.height * self.radius_mm

    @property
    def loop_heights_mm(self) -> tuple[float, ...]:
        """Rise of each loop along its own axis."""
        return (self.height_mm,) * self.loops

    @property
    def loops(self) -> int:
        """Number of loops."""
        return len(self.cells)

    @property
    def pitch_mm(self) -> float:
        """Distance of neighbours' centres after release."""
        return self.equilibrium.shape.width * self.radius_mm

    @property
    def energy_mJ(self) -> float:  # noqa: N802 - the unit's name
        """Energy of one loop."""
        return self.equilibrium.energy * self.materials.energy_unit_J * 1e3

    @property
    def array_energy_mJ(self) -> float:  # noqa: N802 - the unit's name
        """Energy of all loops together."""
        return self.energy_mJ * self.loops

    @cached_property
    def footprint_mm(self) -> tuple[float, float]:
        """Width and depth over the outer wires' centrelines, seen from above."""
        edge = self.equilibrium.shape.edge(_EDGE_POINTS) * self.radius_mm
        width, depth = np.ptp(edge[:, :2], axis=0) + np.ptp(self.centres_mm(), axis=0)
        return float(width), float(depth)

    def surface(self, radius: Vectors, angle_rad: Vectors) -> Vectors:
        """Positions (n, 3) in mm of points that lay at polar coordinates (unit disc) of a loop."""
        return self.equilibrium.shape.position(radius, angle_rad) * self.radius_mm

    def centres_mm(self) -> Vectors:
        """Centres (n, 2) of the loops, in the order of the layout, around the origin."""
        place = np.array(self.cells)[:, ::-1]
        return (place - (place.min(axis=0) + place.max(axis=0)) / 2) * self.pitch_mm


def loop_materials(spec: Specification, wire_modulus_GPa: float) -> LoopMaterials:  # noqa: N803
    """Convert a specification's materials to SI units."""
    return LoopMaterials(
        fabric_modulus_Pa=spec.fabric.modulus_kPa * 1e3,
        fabric_thickness_m=spec.fabric.thickness_mm / 1e3,
        wire_modulus_Pa=wire_modulus_GPa * 1e9,
        wire_diameter_m=spec.wire.diameter_mm / 1e3,
        loop_radius_m=spec.layout.diameter_mm / 2e3,
    )


def loop_scene(spec: Specification, materials: LoopMaterials) -> LoopScene:
    """Give the dimensionless loop of a specification.

    Raises
    ------
    SceneError
        When its numbers lie outside the model.
    """
    return LoopScene(
        strain=spec.fabric.prestrain,
        beta=materials.beta,
        poisson=spec.fabric.poisson,
        reading=Reading(spec.model.reading),
        axial_stiffness=materials.axial_stiffness,
    )


def solve_state(spec: Specification, name: str, wire_modulus_GPa: float) -> CellState:  # noqa: N803
    """Solve the array at one modulus of the wire.

    With the fabric between the loops cut away and touching wires bonded side by side, equal loops
    fit together without extra energy, so one loop is all there is to solve.

    Raises
    ------
    SceneError
        When the materials lie outside the model.
    NotConvergedError
        When there is no shape to rely on.
    """
    materials = loop_materials(spec, wire_modulus_GPa)
    scene = loop_scene(spec, materials)
    start = perf_counter()
    try:
        found = solve_loop(scene, tolerance=spec.model.tolerance)
    except NotConvergedError as error:
        raise NotConvergedError(
            f"{name} shape: {error} (beta = {materials.beta:.3g}; it grows as wire diameter⁴ / "
            f"loop diameter³; {REMEDY})"
        ) from None
    seconds = perf_counter() - start
    left = omissions(spec, materials, found)
    for term in left:
        if term.fatal:
            raise NotConvergedError(
                f"{name} shape: {term.term} is left out, and the shape is wrong without "
                f"({term.measure}: {term.value:.2g}); use a thicker wire or less prestrain"
            )
    return CellState(name, found, materials, left, seconds, spec.layout.cells())
