"""Where a solve begins: flat, with a little of the shape into which the flat state buckles."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.mesh.krylov import symmetric_product
from solver.mesh.mesh_energy import MeshEnergy
from solver.mesh.triangulation import Mesh, embedded

Vectors = NDArray[np.float64]

_AMPLITUDE = 0.1
_ALIKE = 1e-6


def _disc_coordinates(mesh: Mesh) -> Vectors:
    """Points (n, 2) relative to the first loop's middle, in units of its semi-axes."""
    first = mesh.rounds[0]
    return (mesh.points - first.centre) / np.array(first.semi_axes)


def loop_start(energy: MeshEnergy, mesh: Mesh, radius: float) -> Vectors:
    """Positions (n, 3) of one loop, lifted along the softer of the two saddles if that is unstable.

    Arguments are those of `loop_starts`.
    """
    return loop_starts(energy, mesh, radius)[0]


def loop_starts(energy: MeshEnergy, mesh: Mesh, radius: float) -> tuple[Vectors, ...]:
    """Positions (n, 3) of one loop lifted along each saddle that is unstable, the softer one first.

    The saddle x² − y² has its crests on the axes of an ellipse, x y between them. On a round loop
    they are alike, and the first is taken. Where both are stiff there is one start, flat.

    Parameters
    ----------
    radius : float
        Factor by which the flat loop has contracted, so that the fabric's pull is in the wire.
    """
    x, y = _disc_coordinates(mesh).T
    lifts = np.zeros((len(x), 3, 2))
    lifts[:, 2, 0], lifts[:, 2, 1] = x * x - y * y, 2 * x * y
    flat = embedded(radius * mesh.points)
    hessian = symmetric_product(energy.pattern, energy.derivatives(flat)[2])
    stiffness = [float(lift @ hessian(lift)) for lift in lifts.reshape(-1, 2).T]
    aligned, diagonal = stiffness
    order = (1, 0) if diagonal < aligned - _ALIKE * abs(aligned) else (0, 1)
    return tuple(flat + _AMPLITUDE * lifts[:, :, k] for k in order if stiffness[k] < 0) or (flat,)


def lifted(mesh: Mesh) -> Vectors:
    """Positions (n, 3) of a round loop, lifted along the saddle with its crests on the x axis."""
    x, y = _disc_coordinates(mesh).T
    positions = embedded(mesh.points)
    positions[:, 2] = _AMPLITUDE * (x * x - y * y)
    return positions


def array_start(mesh: Mesh) -> Vectors:
    """Positions (n, 3) of a grid, lifted along saddles with their crests on the contacts along x.

    The surface cos πy − cos πx is smooth from loop to loop and level in the gaps' middles.
    """
    x, y = _disc_coordinates(mesh).T
    positions = embedded(mesh.points)
    positions[:, 2] = _AMPLITUDE / 2 * (np.cos(np.pi * y) - np.cos(np.pi * x))
    return positions


def tiled_start(mesh: Mesh, loop: Mesh, solved: Vectors) -> Vectors:
    """Positions (n, 3) of a grid whose gaps are cut, made of copies of one loop's saddle.

    Parameters
    ----------
    loop : Mesh
        Of one loop, refined as often as ``mesh``.
    solved : array (N, 3)
        Its positions, with crests on the x axis, axis upright.
    """
    wire = solved[loop.wires[0].vertices]
    quarter = len(wire) // 4
    pitch = np.array([np.ptp(wire[[0, 2 * quarter], 0]), np.ptp(wire[[quarter, 3 * quarter], 1])])
    spacing = 2 * np.array(mesh.rounds[0].semi_axes)
    origin = np.array(mesh.rounds[0].centre)
    positions = np.empty((len(mesh.points), 3))
    for k, region in enumerate(mesh.rounds):
        # triangles of every loop come in the same order
        vertices = mesh.triangles[mesh.region == k]
        shift = (np.array(region.centre) - origin) / spacing * pitch
        positions[vertices] = solved[loop.triangles] + np.array([shift[0], shift[1], 0.0])
    return positions
