"""Looking back at a solved mesh: whether it has left the ground on which it was modelled."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.checks import (
    CLOSENESS,
    CONTACT,
    LARGEST_WIRE_STRAIN,
    SLACK,
    SMALLEST_TWIST,
    TWIST,
    TWIST_MEASURE,
    gauss_left_out,
    own_curvature_left_out,
)
from solver.fabric_bending import finest_wrinkle
from solver.mesh.any_scene import fabric_of, wires_of
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.face_mesh import smallest_angles
from solver.mesh.scene import ArrayScene
from solver.mesh.star_bending import star_gauss_integral
from solver.mesh.triangulation import GAP, Mesh, Wire
from solver.mesh.wire_twist import twist_stiffness
from solver.omitted import OmittedTerm
from solver.scene import ROUND_WIRE_TWIST_RATIO, LoopScene

Vectors = NDArray[np.float64]

GAP_SOFTNESS = "softness of the fabric between the loops"
THIN = (
    "share of its triangles with an angle under 5 degrees; 0.3 made arrays of 3 x 3 and 5 x 5 "
    "loops a quarter too high"
)
SHARP_ANGLE = 5.0
MOST_THIN = 0.1
"""Other triangulations have 0.01 of them, in the cusps beside the contacts; fans 0.3 and more."""

WHOLE = "finer meshes, for the height of the whole"
WHOLE_CHANGE = "its change from the mesh before, over it; the loops' own heights are sharper"
_SETTLED = 0.02
_EDGES_PER_WAVE = 4


def mesh_omissions(found: MeshEquilibrium) -> tuple[OmittedTerm, ...]:
    """Measure what the model leaves out, on the shape that it gave."""
    strain = max(_wire_strain(found, wire) for wire in found.mesh.wires)
    scene = fabric_of(found.scene)
    slack = OmittedTerm(
        SLACK,
        "largest compressive stress / E_f",
        max(0.0, -found.smallest_stress),
        matters=scene.strain > 0 and wrinkles_escape(found),
    )
    # a term that the energy has is not omitted
    return (
        *(() if found.tension_field else (slack,)),
        *(() if found.contact else (_contact(found),)),
        *_twist_left_out(found),
        *_gauss_left_out(found, scene),
        *_own_curvature(found),
        *_stiff_gaps(found.mesh),
        *_soft_whole(found),
        OmittedTerm(
            "wire's softness beyond small stretch",
            "largest wire strain",
            strain,
            matters=strain > LARGEST_WIRE_STRAIN,
        ),
        *_weight(found),
    )


def _contact(found: MeshEquilibrium) -> OmittedTerm:
    near, thick = found.distances, found.wire_diameter
    apart = min(near.wire_to_wire, 2 * near.wire_to_fabric)
    # what crosses is at no distance; the number of crossings says more than infinity
    closeness = near.crossings if near.crossings else thick / max(apart, 1e-9)
    return OmittedTerm(
        CONTACT,
        CLOSENESS,
        float(closeness),
        matters=near.crossings > 0 or apart < 2 * thick,
        fatal=found.meets_itself,
    )


def _stiff_gaps(mesh: Mesh) -> tuple[OmittedTerm, ...]:
    """Softness that the fabric between loops lacks where its triangles are a fan of thin ones.

    Heights of 3 × 3 and 5 × 5 arrays with such fans came out 22 and 26 % above those with gaps
    triangulated otherwise (docs/theory.md, section 11).
    """
    gaps = mesh.triangles[mesh.region == GAP]
    if not len(gaps):
        return ()
    thin = float((smallest_angles(mesh.points, gaps) < SHARP_ANGLE).mean())
    return (OmittedTerm(GAP_SOFTNESS, THIN, thin, matters=thin > MOST_THIN),)


def _soft_whole(found: MeshEquilibrium) -> tuple[OmittedTerm, ...]:
    """How far from settled the height of an array is whose loops hinge on fabric that wrinkles.

    The loops' own heights settle long before (docs/theory.md, section 11).
    """
    kept = isinstance(found.scene, ArrayScene) and found.scene.gaps_kept
    if not kept or found.height == 0 or np.isnan(found.coarser_height):
        return ()
    change = abs(found.height - found.coarser_height) / found.height
    return (OmittedTerm(WHOLE, WHOLE_CHANGE, change, matters=change > _SETTLED),)


def _weight(found: MeshEquilibrium) -> tuple[OmittedTerm, ...]:
    """Weight, which would pick one of the shapes that free motions lead through."""
    if found.free_motions is None:
        return ()
    term, measure = "weight among free motions", "motions that cost next to nothing"
    return (OmittedTerm(term, measure, found.free_motions, matters=found.free_motions > 0),)


def wrinkles_escape(found: MeshEquilibrium) -> bool:
    """Whether compressed fabric may have wrinkles that are too fine for the mesh.

    A wave takes four edges of a wire, at least.
    """
    lengths = [float(_lengths(found.mesh.points, wire).mean()) for wire in found.mesh.wires]
    finest = 2 * np.pi / (_EDGES_PER_WAVE * max(lengths))
    return finest_wrinkle(found.smallest_stress, fabric_of(found.scene).alpha) > finest


def lacks_twist(found: MeshEquilibrium) -> bool:
    """Whether a shape writhes and its wires' twist, which only straight wire has, was left out."""
    straight = all(wire.natural_curvature == 0 for wire in wires_of(found.scene))
    return straight and any(left.matters for left in _twist_left_out(found))


def _twist_left_out(found: MeshEquilibrium) -> tuple[OmittedTerm, ...]:
    """Twist of the wires that have none in the energy: the largest, over the energy of a loop."""
    own, mesh = wires_of(found.scene), found.mesh
    energies = [
        twist_stiffness(mesh, wire, stiffness, ROUND_WIRE_TWIST_RATIO) * writhe**2
        for wire, stiffness, writhe in zip(mesh.wires, own, found.writhes, strict=True)
        if wire.closed and stiffness.twist_ratio == 0
    ]
    if not energies:
        return ()
    share = max(energies) * len(own) / found.energy
    return (OmittedTerm(TWIST, TWIST_MEASURE, share, matters=share > SMALLEST_TWIST),)


def _gauss_left_out(found: MeshEquilibrium, scene: LoopScene) -> tuple[OmittedTerm, ...]:
    if scene.alpha == 0:
        return ()
    curved = star_gauss_integral(found.mesh, found.positions)
    return gauss_left_out(scene.alpha, scene.poisson, curved, found.energy)


def wriggles(found: MeshEquilibrium) -> bool:
    """Whether a wire would wriggle on a scale without limit, which no finer mesh mends."""
    return any(left.fatal for left in _own_curvature(found))


def _own_curvature(found: MeshEquilibrium) -> tuple[OmittedTerm, ...]:
    """Most by which a wire's own curvature exceeds its curvature; see `own_curvature_excess`."""
    pairs = zip(found.mesh.wires, wires_of(found.scene), strict=True)
    excess = [
        own.natural_curvature - float(_curvatures(found.positions, wire).min())
        for wire, own in pairs
        if own.natural_curvature > 0
    ]
    return (own_curvature_left_out(max([0.0, *excess])),) if excess else ()


def _curvatures(positions: Vectors, wire: Wire) -> Vectors:
    """Curvature (v,) of the circle through each vertex of a wire and both its neighbours.

    Exact for a flat loop. A wire that wriggles from vertex to vertex lets φ/l be its own curvature,
    of which this falls short.
    """
    points = positions[wire.vertices]
    edges = np.diff(points, axis=0, append=points[:1] if wire.closed else points[:0])
    before, after = (np.roll(edges, 1, axis=0), edges) if wire.closed else (edges[:-1], edges[1:])
    sides = [np.linalg.norm(side, axis=1) for side in (before, after, before + after)]
    return 2 * np.linalg.norm(np.cross(before, after), axis=1) / (sides[0] * sides[1] * sides[2])


def _lengths(points: Vectors, wire: Wire) -> Vectors:
    """Length (e,) of a wire's edges between points (n, 2) or (n, 3)."""
    return np.linalg.norm(points[wire.edges[:, 1]] - points[wire.edges[:, 0]], axis=1)


def _wire_strain(found: MeshEquilibrium, wire: Wire) -> float:
    now, flat = (_lengths(points, wire) for points in (found.positions, found.mesh.points))
    return float(np.abs(now / flat - 1).max())
