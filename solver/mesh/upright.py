"""A released shape as it lies on a table, turned as it was in the hoop."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.mesh.measures import common_axis
from solver.mesh.triangulation import Mesh

Vectors = NDArray[np.float64]


def upright(mesh: Mesh, positions: Vectors) -> Vectors:
    """Turn positions (n, 3): the loops' common axis to z, and about it as near to flat as can be.

    Its height is then the extent along z.
    """
    up = common_axis(positions, mesh.wires)
    aside = np.cross([0.0, 1.0, 0.0], up)
    if np.linalg.norm(aside) < 1e-6:
        aside = np.array([1.0, 0.0, 0.0])
    aside /= np.linalg.norm(aside)
    turned = (positions - positions.mean(axis=0)) @ np.stack([aside, np.cross(up, aside), up]).T
    flat = mesh.points - mesh.points.mean(axis=0)
    # the plane turn that brings points nearest to others (Procrustes): the argument of Σ x* X
    now, then = (p[:, 0] + 1j * p[:, 1] for p in (turned, flat))
    moved = now * np.exp(1j * np.angle(np.vdot(now, then)))
    return np.stack([moved.real, moved.imag, turned[:, 2]], axis=1)
