"""Mesh of a plane drawing: chains along its curves, triangles in the regions that have fabric."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from itertools import chain

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from solver.errors import SceneError
from solver.mesh.curve import Ellipse, Point
from solver.mesh.drawing import SEGMENTS, Chains, Drawing, divided
from solver.mesh.face_mesh import MOST_SPOKES, Filling, fan_about, filled
from solver.mesh.faces import Face, contains, faces, inner_point
from solver.mesh.triangulation import GAP, Mesh, RoundRegion, unrefined

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]


class Between(StrEnum):
    """What becomes of the cusped gaps that loops enclose."""

    CUT = "cut"
    KEPT = "kept"


@dataclass(frozen=True, slots=True)
class FabricRegions:
    """Which regions have fabric.

    Attributes
    ----------
    spanned : tuple of bool
        Of each curve but the outlines: whether fabric spans what it encloses.
    between : Between
        Of regions that loops enclose between them.
    kept, cut : tuple of tuple
        A point in each region that is to be otherwise.
    """

    spanned: tuple[bool, ...]
    between: Between = Between.CUT
    kept: tuple[Point, ...] = ()
    cut: tuple[Point, ...] = ()


def _named(chains: Chains, found: tuple[Face, ...], where: tuple[Point, ...]) -> set[int]:
    """Faces in which points lie."""
    named: set[int] = set()
    for point in where:
        inside = [
            k
            for k, face in enumerate(found)
            if contains(chains.points, face.edges, np.array([point]))[0]
        ]
        if not inside:
            raise SceneError(f"no region is at ({point[0]:g}, {point[1]:g})")
        named |= set(inside)
    return named


@dataclass(frozen=True)
class _Enclosures:
    """Closed wires, whether fabric spans each, and the corners of the boxes about them (w, 2)."""

    edges: tuple[Indices, ...]
    spanned: tuple[bool, ...]
    low: Vectors
    high: Vectors

    def about(self, points: Vectors, where: Vectors) -> list[bool]:
        """Whether fabric spans each of the wires that go round a point (1, 2)."""
        near = np.flatnonzero(((self.low <= where) & (where <= self.high)).all(axis=1))
        return [self.spanned[k] for k in near.tolist() if contains(points, self.edges[k], where)[0]]


def _enclosures(chains: Chains, regions: FabricRegions) -> _Enclosures:
    both = zip(chains.wires, regions.spanned, strict=False)
    closed = [(wire, spanned) for wire, spanned in both if wire.closed]
    around = [chains.points[wire.vertices] for wire, _ in closed]
    return _Enclosures(
        tuple(wire.edges for wire, _ in closed),
        tuple(spanned for _, spanned in closed),
        np.array([points.min(axis=0) for points in around]).reshape(-1, 2),
        np.array([points.max(axis=0) for points in around]).reshape(-1, 2),
    )


def _wanted(chains: Chains, drawing: Drawing, regions: FabricRegions) -> list[Face]:
    """Faces with fabric."""
    found = faces(chains.points, chains.edges)
    kept, cut = (_named(chains, found, where) for where in (regions.kept, regions.cut))
    if kept & cut:
        raise SceneError("a region is both kept and cut")
    around = chains.wires[len(chains.wires) - drawing.outlines :]
    enclosures = _enclosures(chains, regions)

    def has_fabric(face: Face) -> bool:
        loops = enclosures.about(chains.points, inner_point(chains.points, face))
        if loops:
            return any(loops)
        bounded = any(np.isin(face.outline, border.vertices).any() for border in around)
        return bounded or regions.between is Between.KEPT

    return [
        face for k, face in enumerate(found) if k in kept or (k not in cut and has_fabric(face))
    ]


@dataclass(frozen=True)
class _Loop:
    """The face that is all of the inside of a small ellipse, from its wire's first vertex on."""

    face: Face
    round: RoundRegion


def _split(chains: Chains, wanted: list[Face], spokes: int) -> tuple[list[_Loop], list[Face]]:
    """Loops that fans fill, in the order of the wires, and the other faces."""
    by_rim = {frozenset(face.outline.tolist()): face for face in wanted if not face.holes}
    loops: list[_Loop] = []
    for wire in chains.wires:
        rim = frozenset(wire.vertices.tolist())
        curve = wire.track.curve if wire.track else None
        if isinstance(curve, Ellipse) and rim in by_rim and len(rim) <= spokes:
            by_rim.pop(rim)
            region = RoundRegion(curve.centre, curve.semi_axes, curve.angle)
            loops.append(_Loop(Face(wire.vertices), region))
    left = set(by_rim)
    others = [f for f in wanted if f.holes or frozenset(f.outline.tolist()) in left]
    return loops, others


def _fillings(points: Vectors, loops: list[_Loop], others: list[Face], spacing: float) -> Filling:
    """Triangles of all faces one after the other, with the inner points of all."""
    inner: list[Vectors] = [np.empty((0, 2))]
    triangles: list[Indices] = [np.empty((0, 3), dtype=np.int64)]
    count = 0
    fans = (fan_about(points, loop.face, np.array([loop.round.centre])) for loop in loops)
    for filling in chain(fans, (filled(points, face, spacing) for face in others)):
        own = filling.triangles.copy()
        own[own >= len(points)] += count
        count += len(filling.points)
        inner.append(filling.points)
        triangles.append(own)
    return Filling(np.concatenate(inner), np.concatenate(triangles))


def _refuse_parts(chains: Chains, triangles: Indices, count: int) -> None:
    """Refuse what falls apart: the motions of parts that nothing joins have no answer."""
    wired = [wire.edges for wire in chains.wires]
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], *wired])
    graph = coo_array((np.ones(len(edges)), edges.T), shape=(count, count))
    parts = int(connected_components(graph, directed=False)[0])
    if parts > 1:
        raise SceneError(
            f"the scene falls into {parts} parts that neither wire nor fabric joins: "
            "solve each by itself, or join them"
        )


def plane_mesh(
    drawing: Drawing,
    regions: FabricRegions,
    segments: int = SEGMENTS,
    spokes: int = MOST_SPOKES,
) -> Mesh:
    """Coarsest mesh of a drawing.

    Small ellipses are fans about their middles, other regions fans or Delaunay's triangulations;
    see `solver.mesh.face_mesh`.

    Parameters
    ----------
    segments : int
        Edges of a loop of mean size; loops of other sizes have more or less, of the same length.
    spokes : int
        Of the fan that fills a small ellipse, at most.

    Raises
    ------
    SceneError
        When curves cross where no joint is, a region is too narrow, or the scene falls into parts.
    """
    chains = divided(drawing, segments)
    loops, others = _split(chains, _wanted(chains, drawing, regions), spokes)
    filling = _fillings(chains.points, loops, others, chains.spacing)
    points = np.concatenate([chains.points, filling.points])
    wires = chains.wires[: len(chains.wires) - drawing.outlines]
    _refuse_parts(Chains(points, wires, chains.spacing), filling.triangles, len(points))
    region = np.full(len(filling.triangles), GAP)
    first = 0
    for k, loop in enumerate(loops):
        region[first : first + len(loop.face.outline)] = k
        first += len(loop.face.outline)
    rounds = tuple(loop.round for loop in loops)
    borders = chains.wires[len(wires) :]
    return unrefined(points, filling.triangles, region, rounds, wires, borders=borders)
