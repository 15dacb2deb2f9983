"""The barriers that give a mesh's wires and fabric their thickness."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.mesh.barrier import Barrier
from solver.mesh.self_contact import mesh_edges
from solver.mesh.triangulation import Mesh

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]

REACH = 0.1
"""Over the wire's diameter: how far beyond its gap a barrier is felt."""
_THIN = 0.02
"""Gap over the wire's diameter that parts keep which lie near each other when flat."""
_FORCE = 0.1
"""Of a pair in the middle of its reach, units of E_f t R; the gaps depend on it a little."""
_THIN_FORCE = 0.01


def _longest(edges: Indices, mesh: Mesh) -> float:
    return float(np.linalg.norm(np.diff(mesh.points[edges], axis=1), axis=2).max())


def _thin_measure(mesh: Mesh, wire_diameter: float, strain: float) -> float:
    """Diameter to which the thin barrier is measured: the wire's, or what fine triangles allow.

    Neighbours that share no vertex are as far apart as the altitude of a triangle between them,
    and released fabric brings them nearer.
    """
    sides = np.diff(mesh.points[mesh.triangles[:, [0, 1, 2, 0]]], axis=1)
    altitudes = 2 * mesh.areas / np.linalg.norm(sides, axis=2).max(axis=1)
    return min(wire_diameter, float(altitudes.min(initial=np.inf)) / (1 + strain))


def thickness_barriers(mesh: Mesh, wire_diameter: float, strain: float) -> tuple[Barrier, ...]:
    """Barriers for wires so thick, in units of R, on fabric stretched by ``strain``.

    Centrelines of wires keep one diameter apart; wire and fabric, and fabric and fabric, half of
    it. Both leave out what is near when flat, as far as the mesh's own edges reach: there, and
    everywhere else, a thin barrier sees to it that nothing passes through anything.
    """
    wires = np.concatenate([wire.edges for wire in mesh.wires])
    sides = mesh_edges(mesh.triangles)
    none = np.empty((0, 3), dtype=np.int64)
    half, reach = wire_diameter / 2, REACH * wire_diameter
    thin, thin_reach = (
        part * _thin_measure(mesh, wire_diameter, strain) for part in (_THIN, REACH)
    )
    # fabric released from the hoop brings parts nearer by 1 + ε; twice, to be clear of the barrier
    released = 2 * (1 + strain)
    return (
        Barrier(
            mesh.points,
            wires,
            none,
            gap=wire_diameter,
            reach=reach,
            force=_FORCE,
            near=2 * (wire_diameter + reach) + 2 * _longest(wires, mesh),
            swept=False,
        ),
        Barrier(
            mesh.points,
            sides,
            mesh.triangles,
            gap=half,
            reach=reach,
            force=_FORCE,
            near=released * (half + reach) + 2 * _longest(sides, mesh),
            swept=False,
        ),
        Barrier(
            mesh.points,
            sides,
            mesh.triangles,
            gap=thin,
            reach=thin_reach,
            force=_THIN_FORCE,
            near=released * (thin + thin_reach),
        ),
    )
