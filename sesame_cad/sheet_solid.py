"""Any array as it is drawn: slabs of fabric and tubes of wire."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from sesame_cad.sheet_shape import Piece, SheetShape, open_edges
from sesame_cad.solids import RIM_SHARE, ClosedSurface, quads, tube_mesh
from sesame_cad.watertight import vertex_normals

Vectors = NDArray[np.float64]
Triangles = NDArray[np.int64]


def sheet_bodies(
    shape: SheetShape, *, fabric_thickness_mm: float, sides: int
) -> tuple[list[ClosedSurface], list[ClosedSurface]]:
    """Make slabs of the pieces of fabric, and tubes of the wires, in mm."""
    rim_mm = min(fabric_thickness_mm, RIM_SHARE * min(shape.diameters_mm))
    slabs = [slab(piece, fabric_thickness_mm, rim_mm) for piece in shape.pieces]
    tubes = [
        tube_mesh(around(chain), diameter, len(chain), sides)
        for chain, diameter in zip(shape.wires, shape.diameters_mm, strict=True)
    ]
    return slabs, tubes


def around(chain: Vectors) -> Callable[[Vectors], Vectors]:
    """Follow a closed chain (n, 3) once as an angle goes from 0 to 2π, vertex by vertex."""
    count = len(chain)

    def at(angle_rad: Vectors) -> Vectors:
        place = np.mod(angle_rad * (count / (2 * np.pi)), count)
        before = np.floor(place).astype(np.int64)
        share = (place - before)[:, None]
        return chain[before % count] * (1 - share) + chain[(before + 1) % count] * share

    return at


def slab(piece: Piece, thickness_mm: float, rim_mm: float) -> tuple[Vectors, Triangles]:
    """Offset a piece of fabric to both sides and close it along its edge, which is thinner."""
    points, faces = piece.points, piece.faces
    edge = open_edges(faces)
    half_mm = np.full((len(points), 1), thickness_mm / 2)
    half_mm[np.unique(edge)] = rim_mm / 2
    offset = vertex_normals(points, faces) * half_mm
    count = len(points)
    wall = quads(edge[:, 0], edge[:, 1], edge[:, 0] + count, edge[:, 1] + count)
    closed = np.concatenate([faces, faces[:, ::-1] + count, wall[:, ::-1]])
    return np.concatenate([points + offset, points - offset]), closed
