"""What a solve on a mesh returns."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from solver.checks import writhe
from solver.mesh.any_scene import MeshScene, fabric_of, size_of, thickest_wire
from solver.mesh.self_contact import LOOKED, SelfContact, self_contact
from solver.mesh.triangulation import Mesh

Vectors = NDArray[np.float64]


_MOST_WRITHE_POINTS = 160
_CONTRACTION = 1.1
"""Of released fabric, over that of free fabric without wires: softer and stiffer wires mix."""


def _thinned(loop: Vectors) -> Vectors:
    return loop[:: max(1, len(loop) // _MOST_WRITHE_POINTS)]


@dataclass(frozen=True, slots=True)
class ContactAccount:
    """What a solve with contact has to say of it; lengths in units of R.

    Attributes
    ----------
    wire_diameter : float
        That the wires were given: the thickest one's.
    before : SelfContact, optional
        How near the shape without contact came to itself, where that was looked at.
    touching : int
        Pairs of points, edges and triangles that feel each other.
    largest_force : float
        On any vertex, in units of E_f t R.
    energy_share : float
        Of the barriers in the energy.
    begun_at : float
        Part of the prestrain from which the shape was followed.
    """

    wire_diameter: float
    before: SelfContact | None
    touching: int
    largest_force: float
    energy_share: float
    begun_at: float


@dataclass(frozen=True)
class MeshEquilibrium:
    """A minimum of a scene's energy; lengths in units of R, energies in units of E_f t R².

    Attributes
    ----------
    scene : LoopScene, ArrayScene or SheetScene
    mesh : Mesh
        The finest.
    positions : array (n, 3)
        Of its vertices.
    status : str
        ``"converged"``, or why the shape must not be relied on.
    energy_terms : dict
        Energy by term.
    gradient_norm : float
        Largest component of the energy's gradient.
    lowest_eigenvalue : float
        Of the second variation, rigid motions taken out, and the turn of one round loop's fabric
        under its saddle; about 0 when other motions are free too, such as hinges of an array.
    negative_eigenvalues : int
        Below −1e-5 E_f t. A shape that has any is a minimum but for what `way_down` tells.
    way_down : float
        Part of the energy that a step along them gains: next to nothing over the kinks of wrinkled
        fabric.
    steps, factorizations : int
        On all meshes together.
    work : int
        Sum of the steps, each times the vertices of its mesh.
    height : float
        From the lowest to the highest point of all wires, along the axis of their area vector.
    loop_heights : array (w,)
        The same of each loop along its own axis; of an open wire, how far it comes from the line
        between its ends.
    coarser_height : float
        The height on the mesh before the last, which is solved to a millionth of its energy; not a
        number when there is only one.
    coarser_loop_heights : array (w,)
        The same of each loop; that on the finest mesh when there is only one.
    smallest_stress : float
        Smallest principal stress of the fabric, units of E_f; negative where it would wrinkle.
    compressed_fraction : float
        Share of triangles with a negative principal stress; with a tension field, which has none,
        of those that are wrinkled or slack.
    tension_field : bool
        Whether the fabric was let wrinkle instead of bearing compression.
    perimeter : float
        Length of one loop's wire as it lies flat, the mean of all; units of R.
    free_motions : int or None
        Motions that cost next to nothing, beside rigid ones; counted in general scenes, and in
        arrays whose loops hang together by their contacts alone.
    contact : ContactAccount, optional
        Where the shape was kept from passing through itself.
    """

    scene: MeshScene
    mesh: Mesh
    positions: Vectors
    status: str
    energy_terms: dict[str, float]
    gradient_norm: float
    lowest_eigenvalue: float
    steps: int
    factorizations: int
    height: float
    loop_heights: Vectors
    coarser_height: float
    smallest_stress: float
    compressed_fraction: float
    tension_field: bool = False
    work: int = 0
    perimeter: float = 2 * np.pi
    free_motions: int | None = None
    contact: ContactAccount | None = None
    negative_eigenvalues: int = 0
    way_down: float = 0.0
    coarser_loop_heights: Vectors = field(default_factory=lambda: np.zeros(0))

    @property
    def wire_diameter(self) -> float:
        """Diameter of the thickest wire, units of R; see `solver.round_wire`."""
        return thickest_wire(self.scene)

    @property
    def looked(self) -> float:
        """How far is looked for parts that come near each other."""
        return max(LOOKED * size_of(self.scene), 2 * self.wire_diameter)

    @cached_property
    def distances(self) -> SelfContact:
        """How near the shape comes to itself."""
        # flat fabric that is released from the hoop brings its own neighbours so near
        released = _CONTRACTION * (1 + fabric_of(self.scene).strain) * self.wire_diameter
        return self_contact(self.mesh, self.positions, self.looked, neighbours=released)

    @property
    def meets_itself(self) -> bool:
        """Whether parts cross, or lie nearer than the thickness of a wire allows."""
        near, thick = self.distances, self.wire_diameter
        too_near = near.wire_to_wire < thick or near.wire_to_fabric < thick / 2
        return near.crossings > 0 or too_near

    @cached_property
    def writhes(self) -> tuple[float, ...]:
        """Writhe of each closed wire, in turns; 0 of an open one."""
        return tuple(
            writhe(_thinned(self.positions[wire.vertices])) if wire.closed else 0.0
            for wire in self.mesh.wires
        )

    @property
    def writhe(self) -> float:
        """Writhe of the wire that writhes most."""
        return max(self.writhes, key=abs)

    @property
    def energy(self) -> float:
        """Total energy."""
        return sum(self.energy_terms.values())

    @property
    def unknowns(self) -> int:
        """Components of the positions."""
        return self.positions.size

    @property
    def height_over_perimeter(self) -> float:
        """Height over the length of one loop's wire."""
        return self.height / self.perimeter
