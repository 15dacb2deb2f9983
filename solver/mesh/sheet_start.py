"""Where the solve of any scene begins: flat, with each loop lifted to a saddle."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.linalg import spsolve

from solver.mesh.faces import area
from solver.mesh.sheet import SheetScene
from solver.mesh.triangulation import Mesh, embedded

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]

AMPLITUDE = 0.1
"""Height of a start's crests over its loop's mean radius."""
_NOISE = 1e-3
"""Breaks the symmetry of a start that lies on a ridge, in units of R."""


def agreed_direction(scene: SheetScene) -> float:
    """Direction of all saddles' crests, in radians, in which they meet with the least slope.

    Saddles z = r² cos 2(θ − φ) of equal φ meet at equal height wherever two loops touch, for
    opposite points are alike; their slopes along the edge are opposite, proportional to
    sin 2(θ − φ). The sum of its squares over the joints at directions θ is least where
    4 φ is the argument of Σ exp 4iθ (docs/theory.md, eq. (12)).
    """
    total = 0j
    for joint in scene.joints:
        curves = [scene.wires[k].curve for k in joint.wires[:2]]
        middles = [curve.at(np.linspace(0, 1, 64, endpoint=False)).mean(axis=0) for curve in curves]
        x, y = middles[1] - middles[0]
        total += np.exp(4j * np.arctan2(y, x))
    return float(np.angle(total)) / 4 if abs(total) > 1e-9 else 0.0


def _saddle_heights(mesh: Mesh, crests: Vectors) -> tuple[Indices, Vectors]:
    """Vertices of closed wires and their heights in saddles with crests at angles (w,).

    Where saddles of different size meet, the height is the mean of theirs.
    """
    heights = np.zeros(len(mesh.points))
    shares = np.zeros(len(mesh.points))
    for wire, crest in zip(mesh.wires, crests, strict=True):
        if not wire.closed:
            continue
        arms = mesh.points[wire.vertices] - mesh.points[wire.vertices].mean(axis=0)
        radius = np.sqrt(abs(area(mesh.points, wire.vertices)) / np.pi)
        x, y = arms.T / radius
        own = np.cos(2 * crest) * (x * x - y * y) + np.sin(2 * crest) * 2 * x * y
        heights[wire.vertices] += AMPLITUDE * radius * own
        shares[wire.vertices] += 1
    on = np.flatnonzero(shares)
    return on, heights[on] / shares[on]


def _spread(mesh: Mesh, fixed: Indices, heights: Vectors) -> Vectors:
    """Heights (n,) of all vertices: those that are not given are the mean of their neighbours'."""
    out = np.zeros(len(mesh.points))
    out[fixed] = heights
    free = np.setdiff1d(np.arange(len(out)), fixed)
    if not len(free) or not len(fixed):
        return out
    t = mesh.triangles
    edges = np.concatenate(
        [t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]], *(wire.edges for wire in mesh.chains)]
    )
    both = np.concatenate([edges, edges[:, ::-1]])
    graph = csr_array(coo_array((np.ones(len(both)), both.T), shape=(len(out), len(out))))
    degree = np.asarray(graph.sum(axis=1), dtype=np.float64).ravel()
    laplacian = csr_array((degree, (np.arange(len(out)), np.arange(len(out))))) - graph
    rows = csr_array(laplacian)[free]
    found = spsolve(rows[:, free].tocsc(), -(rows[:, fixed] @ out[fixed]))
    out[free] = np.asarray(found, dtype=np.float64)
    return out


def saddle_lifts(mesh: Mesh, crests: Vectors) -> Vectors:
    """Heights (n,) of a mesh whose closed wires are saddles with crests at angles (w,).

    A saddle rises by a tenth of its loop's mean radius. Angles are in radians.
    """
    return _spread(mesh, *_saddle_heights(mesh, crests))


def sheet_starts(scene: SheetScene, mesh: Mesh, count: int) -> Iterator[Vectors]:
    """Positions (n, 3) from which to go downhill, the likeliest first.

    All loops lifted with their crests in the direction in which saddles fit best; then between;
    then each in a direction of its own, by chance but the same every time.
    """
    fits = agreed_direction(scene)
    rng = np.random.default_rng(0)
    for k in range(count):
        own = rng.uniform(0, np.pi, len(mesh.wires))
        crests = np.full(len(mesh.wires), fits + k * np.pi / 4) if k < 2 else own
        positions = embedded(mesh.points)
        positions[:, 2] = saddle_lifts(mesh, crests)
        yield positions + _NOISE * rng.normal(size=positions.shape)
