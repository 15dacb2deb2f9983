"""A plane drawing: curves, the points in which they are joined, and how finely to divide them."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from solver.errors import SceneError
from solver.mesh.curve import PlaneCurve, Point, length, nearest
from solver.mesh.wire import Track, Wire

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]

SEGMENTS = 20
"""Edges of a loop of mean size in the unrefined mesh."""

_FEWEST = 12
"""Edges of the smallest loop, unless fewer are asked of one of mean size."""
_FEWEST_BETWEEN = 2
"""Edges between two joints, so that wires joined twice share no edge."""
_DIGITS = 12
_TOLERANCE = 1e-3
"""Distance of a joint from its curves, over the mean size; that of circles typed in."""


@dataclass(frozen=True, slots=True)
class Knot:
    """A point that curves share."""

    curves: tuple[int, ...]
    point: Point


@dataclass(frozen=True, slots=True)
class Drawing:
    """Curves and what joins them.

    Attributes
    ----------
    curves : tuple of PlaneCurve
        Those of the wires, then ``outlines`` closed ones that bound fabric without a wire.
    knots : tuple of Knot
    outlines : int
    """

    curves: tuple[PlaneCurve, ...]
    knots: tuple[Knot, ...]
    outlines: int = 0


@dataclass(frozen=True)
class Chains:
    """Curves as chains of straight edges.

    Attributes
    ----------
    points : array (n, 2)
        Those of the knots first.
    wires : tuple of Wire
        A chain for each curve.
    spacing : float
        Length of an edge of the curves, about.
    """

    points: Vectors
    wires: tuple[Wire, ...]
    spacing: float

    @property
    def edges(self) -> Indices:
        """Vertices (e, 2) of all edges."""
        return np.concatenate([wire.edges for wire in self.wires])


def mean_size(curves: tuple[PlaneCurve, ...]) -> float:
    """Mean length of closed curves, of open ones where there are no others, over 2π."""
    among = [curve for curve in curves if curve.closed] or list(curves)
    return sum(length(curve) for curve in among) / (2 * np.pi * len(among))


def _knot_parameters(drawing: Drawing, size: float) -> list[dict[float, int]]:
    """Knot at each parameter of each curve."""
    found: list[dict[float, int]] = [{} for _ in drawing.curves]
    for number, knot in enumerate(drawing.knots):
        for k in knot.curves:
            curve = drawing.curves[k]
            parameter, distance = nearest(curve, knot.point)
            if distance > _TOLERANCE * size:
                raise SceneError(
                    f"joint {number} at ({knot.point[0]:g}, {knot.point[1]:g}) is {distance:.3g} "
                    f"away from curve {k}, which it is to lie on"
                )
            rounded = round(parameter, _DIGITS)
            found[k][rounded % 1 if curve.closed else rounded] = number
    return found


def _divided(curve: PlaneCurve, knots: list[float], spacing: float, fewest: int) -> Vectors:
    """Parameters of a curve's vertices: evenly between its knots, ``fewest`` if it is closed."""
    if not curve.closed:
        stops = sorted({0.0, 1.0, *knots})
        least = _FEWEST_BETWEEN
    else:
        stops = sorted(knots) or [0.0]
        stops.append(stops[0] + 1)
        spacing = min(spacing, length(curve) / fewest)
        least = _FEWEST_BETWEEN if len(knots) > 1 else fewest
    pieces: list[Vectors] = []
    for first, last in pairwise(stops):
        count = max(least, round(length(curve, first, last) / spacing))
        pieces.append(np.linspace(first, last, count, endpoint=False))
    # an open curve has its last point too
    parameters = np.concatenate(pieces if curve.closed else [*pieces, np.ones(1)])
    parameters = np.round(parameters, _DIGITS)
    return np.sort(parameters % 1) if curve.closed else parameters


def divided(drawing: Drawing, segments: int) -> Chains:
    """Divide curves into edges of about the same length, with vertices at all knots.

    Parameters
    ----------
    segments : int
        Edges of a loop of mean size.

    Raises
    ------
    SceneError
        When a joint is not on its curves, or curves cross where no joint is.
    """
    size = mean_size(drawing.curves)
    spacing = 2 * np.pi * size / segments
    points: list[Vectors] = [np.array([knot.point for knot in drawing.knots]).reshape(-1, 2)]
    count = len(drawing.knots)
    wires: list[Wire] = []
    for curve, knots in zip(drawing.curves, _knot_parameters(drawing, size), strict=True):
        parameters = _divided(curve, list(knots), spacing, min(_FEWEST, segments))
        vertices = np.array([knots.get(float(t), -1) for t in parameters])
        free = vertices < 0
        vertices[free] = count + np.arange(free.sum())
        count += int(free.sum())
        points.append(curve.at(parameters[free]))
        wires.append(Wire(vertices, curve.closed, Track(curve, parameters)))
    chains = Chains(np.concatenate(points), tuple(wires), spacing)
    _refuse_crossings(chains)
    return chains


def _side(a: Vectors, b: Vectors, c: Vectors) -> Vectors:
    """Twice the area (n,) of triangles: greater than 0 where c is to the left of a b."""
    one, other = b - a, c - a
    return one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]


def _refuse_crossings(chains: Chains) -> None:
    edges, points = chains.edges, chains.points
    owner = np.repeat(np.arange(len(chains.wires)), [len(w.edges) for w in chains.wires])
    a, b = points[edges[:, 0]], points[edges[:, 1]]
    reach = float(np.linalg.norm(b - a, axis=1).max())
    i, j = cKDTree((a + b) / 2).query_pairs(reach, output_type="ndarray").T
    apart = (edges[i][:, :, None] != edges[j][:, None, :]).all(axis=(1, 2))
    i, j = i[apart], j[apart]
    across = _side(a[i], b[i], a[j]) * _side(a[i], b[i], b[j])
    along = _side(a[j], b[j], a[i]) * _side(a[j], b[j], b[i])
    # what lies on one line may be apart
    crossed = (across <= 0) & (along <= 0) & (across + along < 0)
    met = cKDTree(points).query_pairs(_TOLERANCE * chains.spacing, output_type="ndarray")
    for k in np.flatnonzero(crossed)[:1]:
        x, y = (a + b)[i[k]] / 2
        raise SceneError(
            f"curves {owner[i[k]]} and {owner[j[k]]} cross near ({x:.4g}, {y:.4g}), "
            "where no joint is"
        )
    for one, _ in met[:1]:
        x, y = points[one]
        raise SceneError(f"curves meet at ({x:.4g}, {y:.4g}), where no joint is, or two are")
