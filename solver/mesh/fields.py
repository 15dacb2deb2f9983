"""What a solved mesh feels in every place: stretch and stress of the fabric, bend of the wires."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.mesh.fabric_law import FabricLaw
from solver.mesh.plane_tensor import principal
from solver.mesh.triangle_energy import triangle_energy
from solver.mesh.triangulation import Mesh

Vectors = NDArray[np.float64]


@dataclass(frozen=True)
class FabricFields:
    """Principal values of each of m triangles, or at m points.

    Attributes
    ----------
    smaller_stretch, larger_stretch : array (m,)
        Length over that of the fabric before it was stretched into the hoop.
    smaller_stress, larger_stress : array (m,)
        Second Piola–Kirchhoff, in units of E_f.
    """

    smaller_stretch: Vectors
    larger_stretch: Vectors
    smaller_stress: Vectors
    larger_stress: Vectors


def fabric_fields(
    mesh: Mesh, positions: Vectors, strain: float, stiffness: Vectors, *, tension_field: bool
) -> FabricFields:
    """Read the fabric of a mesh whose vertices have moved to positions (n, 3), in units of R.

    Parameters
    ----------
    strain : float
        ε with which the fabric lies flat.
    stiffness : array (3, 3)
        From the strain (E₁₁, E₂₂, 2E₁₂) to the stress, in units of E_f.
    tension_field : bool
        Whether the fabric wrinkles instead of bearing compression.
    """
    fabric = triangle_energy(mesh, strain, stiffness, tension_field=tension_field)
    return strained_fields(fabric.strain(positions[mesh.triangles]), fabric.law)


def strained_fields(strain: Vectors, law: FabricLaw) -> FabricFields:
    """Read fabric by its Green–Lagrange strain (E₁₁, E₂₂, 2E₁₂), (m, 3), wherever that is known."""
    # λ = √(1 + 2E) along the principal directions
    low, high = principal(strain * [1.0, 1.0, 0.5])
    stress_low, stress_high = principal(law.stress(strain))
    return FabricFields(np.sqrt(1 + 2 * low), np.sqrt(1 + 2 * high), stress_low, stress_high)


def chain_curvature(chain: Vectors, *, closed: bool) -> Vectors:
    """Curvature (n,) of a chain of points (n, 3): that of the circle through each three.

    The ends of an open chain have that of their neighbours; with fewer than three points it is 0.
    """
    if len(chain) < 3:
        return np.zeros(len(chain))
    before, after = np.roll(chain, 1, axis=0), np.roll(chain, -1, axis=0)
    one, other = chain - before, after - chain
    twice_area = np.linalg.norm(np.cross(one, other), axis=1)
    sides = [np.linalg.norm(side, axis=1) for side in (one, other, after - before)]
    curvature = 2 * twice_area / np.prod(sides, axis=0)
    if not closed:
        curvature[0], curvature[-1] = curvature[1], curvature[-2]
    return curvature
