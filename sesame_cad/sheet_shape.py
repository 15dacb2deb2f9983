"""A released or flat array as it is drawn: pieces of fabric, and wires as fine chains, in mm."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import trimesh
from numpy.typing import NDArray
from trimesh.graph import connected_component_labels

from sesame_cad.watertight import vertex_normals
from solver.mesh.triangulation import Mesh, prolonged, refined

Vectors = NDArray[np.float64]
Triangles = NDArray[np.int64]

MOST_REFINEMENTS = 3


@dataclass(frozen=True)
class Piece:
    """Fabric that hangs together: points (n, 3) in mm and faces (m, 3), turned to one side."""

    points: Vectors
    faces: Triangles


@dataclass(frozen=True)
class SheetShape:
    """Fabric and wires in space, around the origin.

    Attributes
    ----------
    pieces : tuple of Piece
        The fabric of each loop, and of each gap that has some.
    wires : tuple of array (n, 3)
        Closed chains along the centrelines, in mm.
    diameters_mm : tuple of float
        Of each wire.
    """

    pieces: tuple[Piece, ...]
    wires: tuple[Vectors, ...]
    diameters_mm: tuple[float, ...]

    @property
    def footprint_mm(self) -> tuple[float, float]:
        """Width and depth over the wires' centrelines, seen from above."""
        width, depth = np.ptp(np.concatenate(self.wires)[:, :2], axis=0)
        return float(width), float(depth)

    def size_mm(self, fabric_mm: float) -> tuple[float, float, float]:
        """Width, depth and height, with the thickness of wires and fabric, which may bulge."""
        both = [
            *zip(self.wires, self.diameters_mm, strict=True),
            *((_surfaces(piece, fabric_mm), 0.0) for piece in self.pieces),
        ]
        low = np.min([chain.min(axis=0) - thick / 2 for chain, thick in both], axis=0)
        high = np.max([chain.max(axis=0) + thick / 2 for chain, thick in both], axis=0)
        width, depth, height = high - low
        return float(width), float(depth), float(height)


def _surfaces(piece: Piece, fabric_mm: float) -> Vectors:
    """Points on both sides of a piece of fabric; its edge lies inside the wire."""
    offset = vertex_normals(piece.points, piece.faces) * fabric_mm / 2
    inner = np.setdiff1d(np.arange(len(piece.points)), open_edges(piece.faces))
    return np.concatenate(
        [piece.points[inner] + offset[inner], piece.points[inner] - offset[inner]]
    )


def open_edges(faces: Triangles) -> Triangles:
    """Edges (e, 2) of one face only, from end to end as it runs along them."""
    directed = faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    size = int(faces.max()) + 1
    there, back = directed @ [size, 1], directed @ [1, size]
    return directed[~np.isin(there, back)]


def sheet_shape(
    mesh: Mesh,
    positions_mm: Vectors,
    unit_mm: float,
    diameters_mm: tuple[float, ...],
    tolerance_mm: float,
) -> SheetShape:
    """Draw a solved mesh with wires whose chords keep within a tolerance of smooth curves.

    Parameters
    ----------
    positions_mm : array, shape (n, 3)
        Of the mesh's vertices.
    unit_mm : float
        The mesh's unit of length.
    """
    positions = positions_mm / unit_mm
    for _ in range(MOST_REFINEMENTS):
        if unit_mm * max(_chord_error(positions[w.vertices]) for w in mesh.wires) <= tolerance_mm:
            break
        finer = refined(mesh)
        mesh, positions = finer, prolonged(mesh, finer, positions)
    chains = np.concatenate([positions[wire.vertices] for wire in mesh.wires])
    points = unit_mm * (positions - (chains.min(axis=0) + chains.max(axis=0)) / 2)
    wires = tuple(points[wire.vertices] for wire in mesh.wires)
    return SheetShape(_pieces(mesh, points), wires, diameters_mm)


def _chord_error(chain: Vectors) -> float:
    """Largest distance of a closed chain's chords from the curve: a quarter of its bends."""
    bend = chain - (np.roll(chain, 1, axis=0) + np.roll(chain, -1, axis=0)) / 2
    return float(np.linalg.norm(bend, axis=1).max()) / 4


def _pieces(mesh: Mesh, points: Vectors) -> tuple[Piece, ...]:
    """Part the fabric at the wires, where no more than a point joins loops whose gaps are cut."""
    if not len(mesh.triangles):
        return ()
    whole = trimesh.Trimesh(points, mesh.triangles, process=False)
    pairs = whole.face_adjacency
    inner = mesh.region[pairs[:, 0]] == mesh.region[pairs[:, 1]]
    part = connected_component_labels(pairs[inner], node_count=len(mesh.triangles))
    return tuple(_piece(points, mesh.triangles[part == k]) for k in range(int(part.max()) + 1))


def _piece(points: Vectors, faces: Triangles) -> Piece:
    used, local = np.unique(faces, return_inverse=True)
    return Piece(points[used], local.reshape(faces.shape))
