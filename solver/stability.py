"""Whether a solved shape is a minimum among all smooth shapes, not only among those of its kind.

By symmetry the second variation falls into classes: of a shape with two mirrors, one for each pair
of mirror parities; of a shape with three half-turns likewise, with the parities of z the other way
round. For a saddle on isotropic fabric two classes are equal, since a quarter turn swaps them.
Motions that cost nothing are taken out.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from solver.disc_basis import DiscBasis, Space, disc_basis, jet_map, transfer
from solver.free_motions import (
    free_motions_of,
    lifted,
    orthonormal,
    rotation,
    translation,
    turn_of_fabric,
)
from solver.loop_energy import (
    edge_speed,
    scene_bending,
    scene_membrane,
    scene_rod,
    scene_twist,
)
from solver.quartic import FabricPolynomial, QuarticTable, tabulate
from solver.rod import by_unknowns
from solver.scene import LoopScene
from solver.shape import Expansion, LoopShape, from_expansion
from solver.symmetry import ALIGNED, DIAGONAL, HALF_TURN, Mirrors, Symmetry, mirror_symmetry
from solver.twist import writhe_curvature, writhe_slope

Vectors = NDArray[np.float64]

CLASSES: tuple[Mirrors, ...] = ((0, 0), (1, 0), (1, 1))
"""The mirror classes that differ for a saddle; (0, 1) has the eigenvalues of (1, 0)."""

_ALL_MIRRORS: tuple[Mirrors, ...] = (*CLASSES, (0, 1))
_OTHER: dict[Mirrors, Mirrors] = {(0, 0): (1, 1), (1, 1): (0, 0), (1, 0): (0, 1), (0, 1): (1, 0)}
_HOMES = {"saddle": ALIGNED, "oblique": HALF_TURN}
"""Spaces that hold the shapes of a smaller one, tabulated at the points of its motions."""

_LARGEST_TABLE = 500_000
"""Entries beyond which integration is quicker."""


def classes_of(space: Space) -> tuple[Symmetry, ...]:
    """Classes into which the second variation at a shape of a space falls."""
    if space == "saddle":
        return tuple(mirror_symmetry(*c) for c in CLASSES)
    if space == DIAGONAL:
        return tuple(Symmetry((c,), (_OTHER[c],)) for c in _ALL_MIRRORS)
    if space == "oblique":
        return HALF_TURN, Symmetry(((1, 0), (0, 1)), ((1, 0), (0, 1)))
    return tuple(mirror_symmetry(*c) for c in _ALL_MIRRORS)


def _writhing_class(basis: DiscBasis) -> Symmetry:
    """Give the one class whose motions change the writhe of a basis' shapes to first order."""
    if basis.mirrored:
        return mirror_symmetry(1, 1)
    return DIAGONAL if basis.space == DIAGONAL else HALF_TURN


def free_motions(shape: LoopShape, symmetry: Mirrors) -> tuple[Expansion, ...]:
    """Motions of one mirror class that leave a saddle's energy on isotropic fabric as it is."""
    e = shape.expansion
    return {
        (0, 0): (translation(2),),
        (1, 0): (translation(0), rotation(e, 0, 2)),
        (0, 1): (translation(1), rotation(e, 1, 2)),
        (1, 1): (rotation(e, 0, 1), turn_of_fabric(e)),
    }[symmetry]


@dataclass(frozen=True, eq=False)
class Motions:
    """Motions of one class, around shapes of a basis, tabulated at the points of integration.

    Attributes
    ----------
    shapes : DiscBasis
        n unknowns.
    basis : DiscBasis
        m unknowns of the class.
    gradient, edge : array (P, 3, 2, n), (Q, 6, n)
        Of the shapes, at the points of ``basis``.
    writhing : bool
        Whether they change the shapes' writhe to first order.
    home : DiscBasis
        A space that holds the shapes, tabulated at the points of ``basis``.
    """

    shapes: DiscBasis
    basis: DiscBasis
    gradient: Vectors
    edge: Vectors
    writhing: bool
    home: DiscBasis

    @property
    def few(self) -> bool:
        """Whether the table is small enough to be worth its while."""
        m, n = self.basis.size, self.shapes.size
        return m * (m + 1) * n * (n + 1) <= 4 * _LARGEST_TABLE

    @cached_property
    def table(self) -> QuarticTable:
        """The fabric's second variation as a polynomial of the shape."""
        return tabulate(self.basis.gradient, self.gradient, self.basis.area)

    def jet(self, q: Vectors) -> Vectors:
        """First and second derivatives (P, 5, 3) of a shape q (n,) at the points of ``basis``."""
        return jet_map(self.home) @ (transfer(self.shapes, self.home) @ q)


@lru_cache(maxsize=128)
def motions(shapes: DiscBasis, space: Space, symmetry: Symmetry, highest: int) -> Motions:
    """Tabulate the motions of a class up to a polynomial degree."""
    home = disc_basis(shapes.degree, _HOMES[space]) if isinstance(space, str) else shapes
    into = transfer(shapes, home)
    basis = disc_basis(shapes.degree, symmetry).up_to(highest)
    writhing = symmetry == _writhing_class(shapes)
    return Motions(shapes, basis, home.gradient @ into, home.edge @ into, writhing, home)


def wire_curvature(scene: LoopScene, moves: Motions, q: Vectors) -> Vectors:
    """Second derivatives (Q, 6, 6) of the wire's bending and stretch by x' and x'', at q (n,).

    All classes of a space have the same points, and so the same of these.
    """
    basis = moves.basis
    speed = edge_speed(scene, basis.angle)
    return scene_rod(scene).along(moves.edge @ q, basis.arc, speed)[2]


def hessian_along(
    scene: LoopScene, moves: Motions, q: Vectors, wire: Vectors, *, tabulated: bool = True
) -> Vectors:
    """Second variation (m, m) along motions of one class, at the shape q (n,).

    ``wire`` is its `wire_curvature`. ``tabulated`` makes a table for small bases, which pays after
    some hundred shapes.
    """
    basis, membrane = moves.basis, scene_membrane(scene)
    if tabulated and scene.isotropic_circle and moves.few:
        fabric = FabricPolynomial(moves.table, membrane.strain, membrane.a, membrane.b).hessian(q)
    else:
        fabric = membrane.derivatives(moves.gradient @ q, basis.area, basis.gradient)[2]
    bending = scene_bending(scene)
    if bending is not None:
        fabric = fabric + bending.derivatives(moves.jet(q), basis.area, jet_map(basis))[2]
    return fabric + by_unknowns(wire, basis.edge) + _twist_along(scene, moves, q)


def _twist_along(scene: LoopScene, moves: Motions, q: Vectors) -> Vectors | float:
    """Second variation of the wire's twist at the shape q (n,)."""
    basis, twist = moves.basis, scene_twist(scene, moves.basis.angle)
    if twist is None:
        return 0.0
    edge = moves.edge @ q
    out: Vectors | float = 0.0
    if moves.writhing:
        slope = writhe_slope(edge, basis.arc, basis.edge)
        out = 2 * twist.stiffness * np.outer(slope, slope)
    if not moves.shapes.mirrored:
        turns = twist.writhe(edge, basis.arc)
        bent = writhe_curvature(edge, basis.arc, basis.edge)
        out = out + 2 * twist.stiffness * turns * bent
    return out


@dataclass(frozen=True)
class WeakestMotion:
    """The lowest eigenvalue of a second variation, and its motion.

    ``eigenvalue`` is the energy's curvature (units of E_f t) along a displacement whose mean square
    over the disc is 1.
    """

    eigenvalue: float
    symmetry: Symmetry
    basis: DiscBasis
    hessian: Vectors

    @property
    def direction(self) -> Vectors:
        """The motion (m,), in the basis of its class."""
        return np.linalg.eigh(self.hessian)[1][:, 0]


def weakest_motion(
    scene: LoopScene, space: Space, basis: DiscBasis, q: Vectors, highest: int | None = None
) -> WeakestMotion:
    """Find the motion of least stiffness among all smooth ones, free motions taken out.

    Parameters
    ----------
    space : Space
        The symmetry of the shape.
    basis : DiscBasis
        Of that space; q (n,) are the shape's unknowns in it.
    highest : int, optional
        Degree of the polynomials up to which motions are tried; by default, that of the shape's.
    """
    classes = classes_of(space)
    listed = [motions(basis, space, each, highest or basis.degree + 1) for each in classes]
    wire = wire_curvature(scene, listed[0], q)
    found: list[WeakestMotion] = []
    for symmetry, moves in zip(classes, listed, strict=True):
        free = free_motions_of(basis, moves.basis, q, isotropic=scene.isotropic_circle)
        hessian = lifted(hessian_along(scene, moves, q, wire), free)
        lowest = float(np.linalg.eigvalsh(hessian)[0])
        found.append(WeakestMotion(lowest, symmetry, moves.basis, hessian))
    return min(found, key=lambda motion: motion.eigenvalue)


def class_hessian(
    scene: LoopScene, shape: LoopShape, degree: int, symmetry: Mirrors
) -> tuple[Vectors, Vectors]:
    """Hessian (n, n) in one mirror class, and an orthonormal basis (n, f) of its free motions."""
    even = disc_basis(degree, ALIGNED)
    q = from_expansion(even.unknowns, shape.expansion)
    moves = motions(even, ALIGNED, mirror_symmetry(*symmetry), degree + 1)
    free = free_motions_of(even, moves.basis, q, isotropic=scene.isotropic_circle)
    wire = wire_curvature(scene, moves, q)
    return hessian_along(scene, moves, q, wire), orthonormal(free)


def lowest_eigenvalue(scene: LoopScene, shape: LoopShape, degree: int) -> float:
    """Lowest eigenvalue of the second variation at a shape with two mirrors; ≥ 0 at a minimum."""
    even = disc_basis(degree, ALIGNED)
    q = from_expansion(even.unknowns, shape.expansion)
    return weakest_motion(scene, ALIGNED, even, q).eigenvalue
