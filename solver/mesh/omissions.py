"""Looking back at a solved mesh: whether it has left the ground on which it was modelled."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.checks import CONTACT, LARGEST_WIRE_STRAIN, SLACK, TWIST, writhe
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.triangulation import Wire
from solver.omitted import OmittedTerm
from solver.scene import LoopScene

Vectors = NDArray[np.float64]

MOST_WRITHE_POINTS = 160
_NEIGHBOURS = 0.25
"""Points of a wire nearer than this share of its length are neighbours, not in contact."""


def mesh_omissions(found: MeshEquilibrium) -> tuple[OmittedTerm, ...]:
    """Measure what the model leaves out, on the shape that it gave."""
    loops = [found.positions[wire.vertices] for wire in found.mesh.wires if wire.closed]
    strain = max(_wire_strain(found, wire) for wire in found.mesh.wires)
    nearness = max((_edge_length(loop) / _smallest_gap(loop) for loop in loops), default=0.0)
    turns = max((abs(writhe(_thinned(loop))) for loop in loops), default=0.0)
    scene = found.scene if isinstance(found.scene, LoopScene) else found.scene.loop
    slack = OmittedTerm(
        SLACK,
        "largest compressive stress / E_f",
        max(0.0, -found.smallest_stress),
        matters=found.smallest_stress < 0 < scene.strain,
    )
    # with a tension field the energy has that term
    return (
        *(() if found.tension_field else (slack,)),
        OmittedTerm(
            CONTACT,
            "distance of neighbouring wire points / smallest distance across a loop",
            nearness,
            matters=nearness > 1,
            fatal=nearness > 2,
        ),
        OmittedTerm(TWIST, "writhe of a loop", turns, matters=turns > 1e-3),
        OmittedTerm(
            "wire's softness beyond small stretch",
            "largest wire strain",
            strain,
            matters=strain > LARGEST_WIRE_STRAIN,
        ),
        *_weight(found),
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


def _edges(loop: Vectors) -> Vectors:
    return np.linalg.norm(np.roll(loop, -1, axis=0) - loop, axis=1)


def _edge_length(loop: Vectors) -> float:
    return float(_edges(loop).mean())


def _thinned(loop: Vectors) -> Vectors:
    return loop[:: max(1, len(loop) // MOST_WRITHE_POINTS)]


def _smallest_gap(loop: Vectors) -> float:
    """Smallest distance of points of a closed wire that are no neighbours along it."""
    n = len(loop)
    apart = max(2, int(_NEIGHBOURS * n))
    shifts = np.arange(apart, n // 2 + 1)
    others = loop[(np.arange(n)[:, None] + shifts) % n]
    return float(np.linalg.norm(loop[:, None] - others, axis=2).min())
