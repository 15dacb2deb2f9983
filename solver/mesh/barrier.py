"""Keep parts of a mesh apart by a barrier, with the collision detection of `ipctk`.

Li et al., Incremental Potential Contact, ACM Trans. Graph. 39 (2020) 49. The library is optional.
"""

from __future__ import annotations

import importlib
from dataclasses import dataclass
from functools import cached_property
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.spatial import cKDTree

from solver.errors import SceneError
from solver.mesh.elements import Curvature
from solver.mesh.triangulation import embedded

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]

_MARGIN = 0.1
"""Over the mean edge: how far vertices may move before neighbours are looked for again."""
REMEDY = "pip install 'sesame-cad[contact]'"


def contact_available() -> bool:
    """Whether the library that finds collisions is installed."""
    return find_spec("ipctk") is not None


def collision_library() -> Any:
    """Load the library, on one thread so that sums come out the same every time.

    Raises
    ------
    SceneError
        When it is not installed.
    """
    if not contact_available():
        raise SceneError(f"contact needs the library ipctk: {REMEDY}")
    library: Any = importlib.import_module("ipctk")
    library.set_num_threads(1)
    library.set_logger_level(library.LoggerLevel.off)
    return library


@dataclass(frozen=True)
class Collisions:
    """Pairs of a barrier that are near enough at some positions to feel each other."""

    positions: Vectors
    """Of the vertices that the barrier knows."""
    pairs: Any


class _Neighbourhood:
    """Pairs that may come near enough to feel each other, until the vertices have moved far."""

    def __init__(self, body: Any, reach: float, margin: float) -> None:
        self._body = body
        self._reach = reach
        self._margin = margin
        self._looked_at: Vectors | None = None
        self._pairs: Any = None

    def pairs(self, positions: Vectors) -> Any:
        """Candidates at positions (n, 3), looked for again only when one has moved too far."""
        before = self._looked_at
        moved = np.inf if before is None else np.linalg.norm(positions - before, axis=1).max()
        if moved > self._margin:
            self._pairs = collision_library().Candidates()
            # each of two boxes grows by half the reach, and by how far its vertices may move
            self._pairs.build(self._body, positions, self._reach / 2 + self._margin)
            self._looked_at = positions
        return self._pairs


@dataclass(frozen=True)
class Barrier:
    """Points, edges and triangles that must stay ``gap`` apart, unless near when flat.

    The energy of a pair at a distance d sets in at d = gap + reach and has no bound as d falls to
    gap; its force is of the order of ``force``.

    Attributes
    ----------
    points : array (n, 2)
        Flat, of the whole mesh.
    edges : array (e, 2)
    triangles : array (m, 3)
        May be none.
    gap, reach : float
        In units of R.
    force : float
        In units of E_f t R.
    near : float
        Vertices with no more than this between them when flat do not feel each other; a pair of
        elements is left out when all its vertices are so near, or when it shares a vertex.
    swept : bool
        Whether a step is looked at for what it would pass through on its way.
    """

    points: Vectors
    edges: Indices
    triangles: Indices
    gap: float
    reach: float
    force: float
    near: float
    swept: bool = True

    @cached_property
    def _used(self) -> Indices:
        """Vertices that some element has; the library would let the others touch as points."""
        return np.unique(np.concatenate([self.edges.ravel(), self.triangles.ravel()]))

    @cached_property
    def _unknowns(self) -> Indices:
        return (3 * self._used[:, None] + np.arange(3)).ravel()

    @cached_property
    def _body(self) -> Any:
        library = collision_library()
        flat = self.points[self._used]
        edges, triangles = (np.searchsorted(self._used, e) for e in (self.edges, self.triangles))
        body = library.CollisionMesh(
            np.asfortranarray(embedded(flat)),
            np.asfortranarray(edges, dtype=np.int32),
            np.asfortranarray(triangles.reshape(-1, 3), dtype=np.int32),
        )
        near = cKDTree(flat).query_pairs(self.near, output_type="ndarray")
        lower, upper = near.min(axis=1).tolist(), near.max(axis=1).tolist()
        apart = dict.fromkeys(zip(lower, upper, strict=True), False)
        body.can_collide = library.make_sparse_filter(apart, True)
        return body

    @cached_property
    def _potential(self) -> Any:
        # with a physical barrier the stiffness is the force of a pair at the middle of its reach
        return collision_library().BarrierPotential(self.reach, self.force, True)

    @cached_property
    def _neighbourhood(self) -> _Neighbourhood:
        ends = self.points[self.edges]
        length = float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).mean())
        return _Neighbourhood(self._body, self.reach + self.gap, _MARGIN * length)

    def collisions(self, positions: Vectors) -> Collisions:
        """Find what feels each other at positions (n, 3)."""
        ordered = np.asfortranarray(positions[self._used])
        near = self._neighbourhood.pairs(ordered)
        pairs = collision_library().NormalCollisions()
        pairs.build(near, self._body, ordered, self.reach, self.gap)
        return Collisions(ordered, pairs)

    def energy(self, found: Collisions) -> float:
        """Energy, units of E_f t R²; infinite when a pair is nearer than the gap."""
        return float(self._potential(found.pairs, self._body, found.positions))

    def gradient(self, found: Collisions) -> Vectors:
        """Gradient (3n,)."""
        out = np.zeros(3 * len(self.points))
        out[self._unknowns] = self._potential.gradient(found.pairs, self._body, found.positions)
        return out

    def hessian(self, found: Collisions, curvature: Curvature) -> coo_array:
        """Hessian (3n, 3n), its convex part pair by pair on demand."""
        methods = collision_library().PSDProjectionMethod
        method = methods.CLAMP if curvature is Curvature.CONVEX else methods.NONE
        own = coo_array(self._potential.hessian(found.pairs, self._body, found.positions, method))
        row, column = (self._unknowns[c] for c in own.coords)
        size = 3 * len(self.points)
        return coo_array((own.data, (row, column)), shape=(size, size))

    def largest_step(self, start: Vectors, end: Vectors) -> float:
        """Part of the straight way between two positions (n, 3) on which nothing crosses."""
        one, other = (np.asfortranarray(x[self._used]) for x in (start, end))
        step = collision_library().compute_collision_free_stepsize(
            self._body, one, other, narrow_phase_ccd=collision_library().AdditiveCCD()
        )
        return float(step)
