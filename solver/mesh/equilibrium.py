"""What a solve on a mesh returns."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.mesh.scene import ArrayScene
from solver.mesh.sheet import SheetScene
from solver.mesh.triangulation import Mesh
from solver.scene import LoopScene

Vectors = NDArray[np.float64]


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
        Of the second variation, rigid motions taken out; about 0 when other motions are free too,
        such as the turn of a round loop's fabric under its saddle, or hinges of an array.
    steps, factorizations : int
        On all meshes together.
    height : float
        From the lowest to the highest point of all wires, along the axis of their area vector.
    loop_heights : array (w,)
        The same of each loop along its own axis; of an open wire, how far it comes from the line
        between its ends.
    coarser_height : float
        The height on the mesh before the last, which is solved to a millionth of its energy; not a
        number when there is only one.
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
        Motions that cost next to nothing, beside rigid ones; counted in general scenes.
    """

    scene: LoopScene | ArrayScene | SheetScene
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
    perimeter: float = 2 * np.pi
    free_motions: int | None = None

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
