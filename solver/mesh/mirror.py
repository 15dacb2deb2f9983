"""Two upright mirror planes of a mesh, of whose vertices a quarter tells all."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from solver.mesh.assembly import weighted_sums
from solver.mesh.triangulation import Mesh

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]

_NEAR = 1e-6
"""Distance, in units of R, up to which a vertex lies on another's image, or on a plane."""


@dataclass(frozen=True)
class Mirrors:
    """The planes x = x₀ and y = y₀, and the vertices on one side of both.

    Attributes
    ----------
    middle : array (3,)
        (x₀, y₀, 0).
    images : array (2, n)
        The vertex on which each is mapped by the first plane and by the second.
    chosen : array (r,)
        Vertices that stand for all.
    of : array (n,)
        Which of them stands for each vertex.
    signs : array (n, 3)
        Of each component from the middle against that of the vertex that stands for it; 0 across a
        plane on which a vertex lies.
    """

    middle: Vectors
    images: Indices
    chosen: Indices
    of: Indices
    signs: Vectors

    def few(self, positions: Vectors) -> Vectors:
        """Positions (r, 3) of the chosen among those (n, 3) of all."""
        return positions[self.chosen]

    def all(self, few: Vectors) -> Vectors:
        """Positions (n, 3) of all vertices."""
        return self.middle + self.moves(few - self.middle)

    def moves(self, few: Vectors) -> Vectors:
        """Displacements (n, 3) of all vertices from those (r, 3) of the chosen."""
        return self.signs * few[self.of]

    def pulls(self, gradient: Vectors) -> Vectors:
        """Derivatives (r, 3) by the positions of the chosen from those (n, 3) by all."""
        return np.stack([self.sums(column) for column in (self.signs * gradient).T], axis=1)

    def sums(self, weights: Vectors) -> Vectors:
        """Sums (r,) over the vertices for which each of the chosen stands."""
        return weighted_sums(self.of, weights, len(self.chosen))

    def settled(self, positions: Vectors) -> Vectors:
        """Move a shape (n, 3) that is all but symmetric into the planes, and make it symmetric."""
        centred = positions - positions.mean(axis=0)
        first, second = (_normal(centred, image) for image in self.images)
        second -= (second @ first) * first
        second /= np.linalg.norm(second)
        axes = np.stack([first, second, np.cross(first, second)], axis=1)
        # what lies beyond a plane when flat is to lie beyond it here
        beyond = np.sum(self.signs * (centred @ axes), axis=0) < 0
        turned = np.where(beyond, 1.0, -1.0)[:2]
        shape = centred @ axes * [*turned, turned.prod()]
        for plane, image in enumerate(self.images):
            flip = np.ones(3)
            flip[plane] = -1
            shape = (shape + flip * shape[image]) / 2
        return self.middle + shape


def _normal(centred: Vectors, image: Indices) -> Vectors:
    """Normal (3,) of the plane that best maps a shape (n, 3), its middle at 0, on its image.

    The squared distances of the reflected vertices x − 2 n (n·x) from the images x′ sum up to
    a constant and 4 Σ (n·x)(n·x′).
    """
    products = centred.T @ centred[image]
    return np.linalg.eigh(products + products.T)[1][:, 0]


def mirrors(mesh: Mesh) -> Mirrors | None:
    """Planes through the middle in which a mesh's vertices mirror each other; None without."""
    points = mesh.points
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    relative = points - middle
    tree = cKDTree(relative)
    found = [np.asarray(tree.query(relative * flip)) for flip in ((-1, 1), (1, -1))]
    if max(float(apart.max()) for apart, _ in found) > _NEAR:
        return None
    images = np.stack([image for _, image in found]).astype(np.int64)
    beyond = relative > _NEAR
    stand_in = np.arange(len(points))
    for image, over in zip(images, beyond.T, strict=True):
        stand_in = np.where(over[stand_in], image[stand_in], stand_in)
    chosen, of = np.unique(stand_in, return_inverse=True)
    signs = np.ones((len(points), 3))
    signs[:, :2] = np.where(beyond, -1.0, np.where(relative < -_NEAR, 1.0, 0.0))
    return Mirrors(np.array([*middle, 0.0]), images, chosen, of, signs)
