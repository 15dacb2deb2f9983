"""Looking back at a solved loop: whether it has left the ground on which it was modelled."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.distance import cdist

from solver.disc_basis import DiscBasis, disc_basis, jet_map
from solver.fabric_bending import finest_wrinkle, gauss_integral
from solver.loop_energy import LoopEnergy, edge_speed, scene_membrane
from solver.membrane import Membrane
from solver.omitted import OmittedTerm
from solver.round_wire import wire_diameter
from solver.scene import ROUND_WIRE_TWIST_RATIO, LoopScene
from solver.shape import LoopShape, from_expansion
from solver.symmetry import ALIGNED
from solver.twist import flat_wire_twist

Vectors = NDArray[np.float64]

CONTACT = "contact across the loop"
CLOSENESS = (
    "wire diameter / smallest distance of wires, or half of it / that of wire and fabric, or the "
    "number of crossings"
)
TWIST = "twist of the wire"
TWIST_MEASURE = "twist energy of a round wire / energy"
SLACK = "slack fabric (tension field)"
GAUSS = "fabric's bending by Gaussian curvature"
OWN_CURVATURE = "wire's resistance to twist"
EDGE_POINTS = 256
WRITHE_POINTS = 48
LARGEST_WIRE_STRAIN = 0.01
"""Beyond it the wire is no longer stiff against stretch, as the model takes it to be."""

_FABRIC_GRID = np.linspace(0, 0.95, 20), np.linspace(0, 2 * np.pi, 96, endpoint=False)
"""Radii and angles at which fabric is compared with the wire."""

_FABRIC_NEAR = 0.3
"""Over the smaller half-width of the flat loop."""

NEAR_CRESTS = 0.3
"""Distance in units of R of wires across the loop, below which fabric may come near a wire."""

SMALLEST_TWIST = 1e-4
"""Share of the energy from which twist that was left out is told of."""

_SMALLEST_GAUSS = 1e-3
"""Share of the energy from which the rest of a plate's bending is told of."""

_ROUNDING = 1e-6
"""Natural curvature beyond the curvature, in units of 1/R, that a flat loop has by rounding."""

STRAYED = 0.5
"""In turns; a wire that passes through itself, or a tangent through its opposite, makes it 2."""


def smallest_principal_stress(membrane: Membrane, gradient: Vectors) -> float:
    """Smallest principal stress, units of E_f, of deformation gradients (P, 3, 2)."""
    stress = membrane.stress(membrane.green_lagrange(gradient))
    along, across, shear = stress[:, 0, 0], stress[:, 1, 1], stress[:, 0, 1]
    return float(((along + across) / 2 - np.hypot((along - across) / 2, shear)).min())


def smallest_stress(scene: LoopScene, shape: LoopShape, degree: int) -> float:
    """Smallest principal stress of the fabric, units of E_f; negative where it would wrinkle."""
    basis = disc_basis(degree, ALIGNED)
    q = from_expansion(basis.unknowns, shape.expansion)
    return smallest_principal_stress(scene_membrane(scene), basis.gradient @ q)


def largest_wire_strain(scene: LoopScene, basis: DiscBasis, q: Vectors) -> float:
    """Largest stretch or shortening of the wire, as a fraction of its length."""
    tangent = basis.tangent @ q
    stretch = np.linalg.norm(tangent, axis=1) / edge_speed(scene, basis.angle)
    return float(np.abs(stretch - 1).max())


def smallest_bend_radius(shape: LoopShape, degree: int) -> float:
    """Smallest radius of curvature of the wire, in units of R."""
    basis = disc_basis(degree, ALIGNED)
    q = from_expansion(basis.unknowns, shape.expansion)
    tangent, second = basis.tangent @ q, basis.second @ q
    turn = np.linalg.norm(np.cross(tangent, second), axis=1)
    return float((np.linalg.norm(tangent, axis=1) ** 3 / turn).min())


def own_curvature_excess(scene: LoopScene, basis: DiscBasis, q: Vectors) -> float:
    """Most by which the wire's own curvature exceeds its curvature, in units of 1/R; at least 0.

    Where it does, a wire that is free to turn about its own axis gains by wriggling on a scale
    without limit: (κ − κ0)² resists no motion across a curve of less curvature. Only the wire's
    resistance to twist would stop it.
    """
    if scene.natural_curvature == 0:
        return 0.0
    tangent, second = basis.tangent @ q, basis.second @ q
    turn = np.linalg.norm(np.cross(tangent, second), axis=1)
    curvature = turn / np.linalg.norm(tangent, axis=1) ** 3
    return max(0.0, scene.natural_curvature - float(curvature.min()))


def own_curvature_left_out(excess: float) -> OmittedTerm:
    """What keeps a wire from wriggling, from `own_curvature_excess`; fatal where it would."""
    wriggles = excess > _ROUNDING
    measure = "natural curvature beyond the curvature / (1/R)"
    return OmittedTerm(OWN_CURVATURE, measure, excess, matters=wriggles, fatal=wriggles)


def smallest_wire_gap(shape: LoopShape) -> float:
    """Smallest distance of wire centrelines across the loop, in units of R; negative when crossed.

    Opposite crests come together first. They count as crossed when each lies on the other's side.
    The half-turn about z, which all loops' shapes have, repeats every pair of points.
    """
    if shape.width <= 0:
        return shape.width
    edge = shape.curve.samples(EDGE_POINTS)
    squared = cdist(edge[: EDGE_POINTS // 2], edge[EDGE_POINTS // 4 :], "sqeuclidean")
    return math.sqrt(squared.take(_across()).min())


@lru_cache(maxsize=1)
def _across() -> NDArray[np.intp]:
    """Where pairs of points stand that lie a quarter to half a turn apart.

    The table's rows are the points of the wire's first half turn, its columns those from a quarter
    turn on.
    """
    start, farther = np.arange(EDGE_POINTS // 2), np.arange(EDGE_POINTS // 4 + 1)
    columns = EDGE_POINTS - EDGE_POINTS // 4
    return np.ravel(columns * start[:, None] + start[:, None] + farther)


@lru_cache(maxsize=16)
def _far_when_flat(semi_axes: tuple[float, float]) -> NDArray[np.bool_]:
    """Which points of the fabric (G,) and of the wire (E,) lie apart when the loop is flat."""
    radius, angle = _fabric_points()
    flat, flat_edge = (
        np.stack([r * np.cos(t), r * np.sin(t)], axis=-1) * semi_axes
        for r, t in ((radius, angle), (np.ones(EDGE_POINTS), _edge_angles()))
    )
    return np.asarray(cdist(flat, flat_edge) > _FABRIC_NEAR * min(semi_axes))


def _fabric_points() -> tuple[Vectors, Vectors]:
    radius, angle = np.meshgrid(*_FABRIC_GRID)
    return radius.ravel(), angle.ravel()


def _edge_angles() -> Vectors:
    return np.arange(EDGE_POINTS, dtype=np.float64) * (2 * np.pi / EDGE_POINTS)


def smallest_fabric_gap(scene: LoopScene, shape: LoopShape) -> float:
    """Smallest distance of the wire's centreline and the fabric, in units of R, by sampling.

    Fabric that lies near a point of the wire when flat is left out.
    """
    fabric = shape.position(*_fabric_points())
    now = cdist(fabric, shape.curve.samples(EDGE_POINTS))
    return float(now[_far_when_flat(scene.semi_axes)].min())


def _contact(scene: LoopScene, shape: LoopShape) -> OmittedTerm:
    """Compare distances across the loop with the thickness of its wire."""
    thick, gap = wire_diameter(scene), smallest_wire_gap(shape)
    # fabric hangs between the crests: only where they are near can it come near the wire
    if 0 < gap < NEAR_CRESTS:
        gap = min(gap, 2 * smallest_fabric_gap(scene, shape))
    return OmittedTerm(
        CONTACT,
        CLOSENESS,
        thick / gap if gap > 0 else 1.0,
        matters=gap < 2 * thick,
        fatal=gap <= thick,
    )


def meets_itself(scene: LoopScene, shape: LoopShape) -> bool:
    """Whether a loop's wire touches itself or its fabric, or has passed through."""
    return _contact(scene, shape).fatal


def writhe(points: Vectors) -> float:
    """Writhe of a closed polygon (n, 3): the double sum of solid angles over its edges.

    Klenin and Langowski, Biopolymers 54 (2000) 307, method 1a. A saddle has mirror planes, so 0.
    """
    following = np.roll(points, -1, axis=0)
    n = len(points)
    i, j = np.triu_indices(n, 2)
    apart = (j + 1) % n != i
    i, j = i[apart], j[apart]
    r12, r34 = following[i] - points[i], following[j] - points[j]
    r13, r14 = points[j] - points[i], following[j] - points[i]
    r23, r24 = points[j] - following[i], following[j] - following[i]
    normals = [np.cross(r13, r14), np.cross(r14, r24), np.cross(r24, r23), np.cross(r23, r13)]
    unit = [v / np.maximum(np.linalg.norm(v, axis=1), 1e-300)[:, None] for v in normals]
    angle = sum(
        np.arcsin(np.clip(np.sum(unit[k] * unit[(k + 1) % 4], axis=1), -1, 1)) for k in range(4)
    )
    sign = np.sign(np.sum(np.cross(r34, r12) * r13, axis=1))
    return float(np.sum(angle * sign) / (2 * np.pi))


def twist_share(scene: LoopScene, basis: DiscBasis, q: Vectors, energy: float) -> float:
    """Energy of twist that a round wire would have in a loop, as a share of the loop's energy.

    A shape with a mirror plane has no writhe, and so none.
    """
    if basis.mirrored:
        return 0.0
    twist = flat_wire_twist(scene.beta, ROUND_WIRE_TWIST_RATIO, scene.semi_axes, basis.angle)
    return twist.energy(basis.along_edge(q), basis.arc) / energy


def writhe_strays(energy: LoopEnergy, q: Vectors) -> bool:
    """Whether a wire's twist was reckoned from a writhe that is not the loop's.

    That by the tangent's way from the flat loop is out by 2 where the tangent has come to point
    against its own first direction on that way.
    """
    if energy.twist is None:
        return False
    basis = energy.basis
    turns = energy.twist.writhe(basis.along_edge(q), basis.arc)
    return abs(turns - writhe(LoopShape(basis.unknowns, q).edge(WRITHE_POINTS))) > STRAYED


def _twist_left_out(
    scene: LoopScene, basis: DiscBasis, q: Vectors, energy: float
) -> tuple[OmittedTerm, ...]:
    """Twist of the wire, where the scene does not ask for it."""
    if scene.twist_ratio > 0:
        return ()
    share = twist_share(scene, basis, q, energy)
    return (OmittedTerm(TWIST, TWIST_MEASURE, share, matters=share > SMALLEST_TWIST),)


def gauss_left_out(
    alpha: float, poisson: float, curved: float, energy: float
) -> tuple[OmittedTerm, ...]:
    """What a plate would have besides α ∫ H² dA, from ∫ K dA: docs/theory.md, eq. (15)."""
    if alpha == 0:
        return ()
    share = abs((1 - poisson) * alpha / 2 * curved) / energy
    measure = "its energy in a plate / energy"
    return (OmittedTerm(GAUSS, measure, share, matters=share > _SMALLEST_GAUSS),)


def looked_back(
    scene: LoopScene, basis: DiscBasis, q: Vectors, stress: float, energy: float
) -> tuple[OmittedTerm, ...]:
    """Measure what the model of one loop leaves out and the shape alone can tell.

    ``stress`` is the fabric's smallest principal stress, ``energy`` the loop's.
    """
    shape = LoopShape(basis.unknowns, q)
    strain = largest_wire_strain(scene, basis, q)
    curved = gauss_integral(jet_map(basis) @ q, basis.area) if scene.alpha > 0 else 0.0
    return (
        OmittedTerm(
            SLACK,
            "largest compressive stress / E_f",
            max(0.0, -stress),
            matters=scene.strain > 0 and finest_wrinkle(stress, scene.alpha) > basis.degree,
        ),
        _contact(scene, shape),
        *_twist_left_out(scene, basis, q, energy),
        *gauss_left_out(scene.alpha, scene.poisson, curved, energy),
        own_curvature_left_out(own_curvature_excess(scene, basis, q)),
        OmittedTerm(
            "wire's softness beyond small stretch",
            "largest wire strain",
            strain,
            matters=strain > LARGEST_WIRE_STRAIN,
        ),
    )
