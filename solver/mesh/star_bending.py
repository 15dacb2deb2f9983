"""Bending of the fabric, α ∫ H² dA, from the stars of triangles about its inner vertices.

The area of a star changes with its middle vertex by g = ∂A/∂x. On a smooth surface that is twice
the mean curvature vector, times the vertex' share m = A/3 of the area, so that H² dA becomes

    |g|²/(4 m),

Surface Evolver's ``sq_mean_curvature``. It is the mixed method for the biharmonic operator with
linear elements (Ciarlet and Raviart 1974). The edge of the fabric is free to turn about its wire,
where H = 0 is the natural condition of the energy: vertices on it have no term. Energies and
heights converge with second order.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from solver.mesh.corner_area import CornerArea
from solver.mesh.elements import Curvature
from solver.mesh.triangulation import Mesh

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True)
class StarBending:
    """Stars of a triangles each, with the energy of docs/theory.md, eq. (14).

    Attributes
    ----------
    vertices : array (m, 1 + a)
        The middle, then those around it in their order.
    alpha : float
        α, in units of E_f t R².
    """

    vertices: Indices
    alpha: float

    @property
    def _around(self) -> int:
        return self.vertices.shape[1] - 1

    def part(self, rows: Indices) -> Self:
        """Give the elements in these rows."""
        return replace(self, vertices=self.vertices[rows])

    def _triangles(self, corners: Vectors) -> CornerArea:
        """Triangles (m · a) of the stars, middle first."""
        ring = corners[:, 1:]
        middle = np.broadcast_to(corners[:, :1], ring.shape)
        listed = np.stack([middle, ring, np.roll(ring, -1, axis=1)], axis=2)
        return CornerArea(listed.reshape(-1, 3, 3))

    def _pull(self, triangles: CornerArea) -> tuple[Vectors, Vectors]:
        """Give g (m, 3) and a third of the star's area (m,)."""
        count = len(self.vertices)
        by_middle = triangles.gradient()[:, :3].reshape(count, -1, 3).sum(axis=1)
        return by_middle, triangles.area.reshape(count, -1).sum(axis=1) / 3

    def energies(self, corners: Vectors) -> Vectors:
        """Energy (m,) of each star."""
        pull, share = self._pull(self._triangles(corners))
        return self.alpha * np.sum(pull * pull, axis=1) / (4 * share)

    def derivatives(
        self, corners: Vectors, curvature: Curvature
    ) -> tuple[Vectors, Vectors, Vectors]:
        """Energies (m,), gradients (m, 3(1 + a)) and Hessians (m, 3(1 + a), 3(1 + a))."""
        triangles = self._triangles(corners)
        pull, share = self._pull(triangles)
        bend = triangles.hessian()
        by_share = self._gathered(triangles.gradient()[:, None])[:, 0] / 3
        by_pull = self._gathered(bend[:, :3])
        twice = pull / (2 * share[:, None])
        square = np.sum(pull * pull, axis=1) / (4 * share**2)
        gradient = (twice[:, None] @ by_pull)[:, 0] - square[:, None] * by_share
        # |g|²/m is convex in g and m: what their own second derivatives bring in is left to TRUE
        part = by_pull - 2 * twice[:, :, None] * by_share[:, None]
        hessian = np.swapaxes(part, 1, 2) @ part / (2 * share)[:, None, None]
        if curvature is not Curvature.CONVEX:
            motion = np.repeat(twice, self._around, axis=0)
            lent = np.repeat(square / 3, self._around)[:, None, None] * bend
            hessian += self._scattered(triangles.hessian_change(motion) - lent)
        energies = self.alpha * square * share
        return energies, self.alpha * gradient, self.alpha * hessian

    def _places(self) -> Indices:
        """Unknowns (a, 9) of each triangle's corners in its star."""
        ring = 1 + np.arange(self._around)
        corners = np.stack([np.zeros_like(ring), ring, np.roll(ring, -1)], axis=1)
        return (3 * corners[:, :, None] + np.arange(3)).reshape(-1, 9)

    def _gathered(self, rows: Vectors) -> Vectors:
        """Sum (m, r, 3(1 + a)) over each star of its triangles' rows (m · a, r, 9)."""
        count, size = len(self.vertices), 3 * self.vertices.shape[1]
        by_triangle = rows.reshape(count, self._around, -1, 9)
        out = np.zeros((count, by_triangle.shape[2], size))
        for k, places in enumerate(self._places()):
            out[:, :, places] += by_triangle[:, k]
        return out

    def _scattered(self, matrices: Vectors) -> Vectors:
        """Sum (m, 3(1 + a), 3(1 + a)) over each star of its triangles' matrices (m · a, 9, 9)."""
        count, size = len(self.vertices), 3 * self.vertices.shape[1]
        by_triangle = matrices.reshape(count, self._around, 9, 9)
        out = np.zeros((count, size, size))
        for k, places in enumerate(self._places()):
            out[:, places[:, None], places] += by_triangle[:, k]
        return out


def star_gauss_integral(mesh: Mesh, positions: Vectors) -> float:
    """∫ K dA of the fabric: what the angles about each inner vertex lack of a full turn."""
    total = 0.0
    for vertices in stars(mesh):
        along = positions[vertices[:, 1:]] - positions[vertices[:, :1]]
        following = np.roll(along, -1, axis=1)
        across = np.linalg.norm(np.cross(along, following), axis=2)
        angles = np.arctan2(across, np.sum(along * following, axis=2))
        total += float(np.sum(2 * np.pi - angles.sum(axis=1)))
    return total


def _ring(following: dict[int, int]) -> list[int]:
    """Vertices around a middle in their order, from the edge opposite to it of each triangle.

    Empty where the triangles do not close, which is so on the fabric's edge.
    """
    first = min(following)
    ring = [first]
    while (after := following.get(ring[-1], first)) != first:
        ring.append(after)
    closed = len(ring) == len(following) and following.get(ring[-1]) == first
    return ring if closed else []


def stars(mesh: Mesh) -> tuple[Indices, ...]:
    """Middle and surrounding vertices (m, 1 + a) of all inner vertices, by their number a."""
    following: list[dict[int, int]] = [{} for _ in mesh.points]
    for one, two, three in mesh.triangles.tolist():
        following[one][two] = three
        following[two][three] = one
        following[three][one] = two
    rings = [(middle, _ring(after)) for middle, after in enumerate(following) if after]
    sizes = sorted({len(ring) for _, ring in rings if ring})
    return tuple(
        np.array([[middle, *ring] for middle, ring in rings if len(ring) == size], dtype=np.int64)
        for size in sizes
    )


def star_bending(mesh: Mesh, alpha: float) -> tuple[StarBending, ...]:
    """Bending of a mesh's fabric; stars of different size stand apart."""
    return tuple(StarBending(vertices, alpha) for vertices in stars(mesh))
