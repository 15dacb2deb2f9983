"""Looking back at a solved mesh: whether it has left the ground on which it was modelled."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.checks import CLOSENESS, CONTACT, LARGEST_WIRE_STRAIN, SLACK, TWIST, writhe
from solver.mesh.any_scene import fabric_of
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.triangulation import Wire
from solver.omitted import OmittedTerm

Vectors = NDArray[np.float64]

MOST_WRITHE_POINTS = 160


def mesh_omissions(found: MeshEquilibrium) -> tuple[OmittedTerm, ...]:
    """Measure what the model leaves out, on the shape that it gave."""
    loops = [found.positions[wire.vertices] for wire in found.mesh.wires if wire.closed]
    strain = max(_wire_strain(found, wire) for wire in found.mesh.wires)
    turns = max((abs(writhe(_thinned(loop))) for loop in loops), default=0.0)
    scene = fabric_of(found.scene)
    slack = OmittedTerm(
        SLACK,
        "largest compressive stress / E_f",
        max(0.0, -found.smallest_stress),
        matters=found.smallest_stress < 0 < scene.strain,
    )
    # a term that the energy has is not omitted
    return (
        *(() if found.tension_field else (slack,)),
        *(() if found.contact else (_contact(found),)),
        OmittedTerm(TWIST, "writhe of a loop", turns, matters=turns > 1e-3),
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


def _weight(found: MeshEquilibrium) -> tuple[OmittedTerm, ...]:
    """Weight, which would pick one of the shapes that free motions lead through."""
    if found.free_motions is None:
        return ()
    term, measure = "weight among free motions", "motions that cost next to nothing"
    return (OmittedTerm(term, measure, found.free_motions, matters=found.free_motions > 0),)


def _wire_strain(found: MeshEquilibrium, wire: Wire) -> float:
    now, flat = (
        np.linalg.norm(points[wire.edges[:, 1]] - points[wire.edges[:, 0]], axis=1)
        for points in (found.positions, found.mesh.points)
    )
    return float(np.abs(now / flat - 1).max())


def _thinned(loop: Vectors) -> Vectors:
    return loop[:: max(1, len(loop) // MOST_WRITHE_POINTS)]
