"""Looking back at a solved mesh: whether it has left the ground on which it was modelled."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.checks import (
    CONTACT,
    LARGEST_WIRE_STRAIN,
    SLACK,
    SMALLEST_TWIST,
    TWIST,
    TWIST_MEASURE,
    gauss_left_out,
    writhe,
)
from solver.fabric_bending import finest_wrinkle
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.scene import ArrayScene, loop_wire
from solver.mesh.star_bending import star_gauss_integral
from solver.mesh.triangulation import Wire
from solver.mesh.wire_twist import twist_stiffness
from solver.omitted import OmittedTerm
from solver.scene import ROUND_WIRE_TWIST_RATIO, LoopScene

Vectors = NDArray[np.float64]

MOST_WRITHE_POINTS = 160
_EDGES_PER_WAVE = 4
_NEIGHBOURS = 0.25
"""Points of a wire nearer than this share of its length are neighbours, not in contact."""


def mesh_omissions(found: MeshEquilibrium) -> tuple[OmittedTerm, ...]:
    """Measure what the model leaves out, on the shape that it gave."""
    loops = [found.positions[wire.vertices] for wire in found.mesh.wires]
    strain = max(_wire_strain(found, wire) for wire in found.mesh.wires)
    gap = min(_smallest_gap(loop) for loop in loops)
    scene = found.scene.loop if isinstance(found.scene, ArrayScene) else found.scene
    slack = OmittedTerm(
        SLACK,
        "largest compressive stress / E_f",
        max(0.0, -found.smallest_stress),
        matters=scene.strain > 0 and wrinkles_escape(found),
    )
    # with a tension field the energy has that term
    return (
        *(() if found.tension_field else (slack,)),
        OmittedTerm(
            CONTACT,
            "distance of neighbouring wire points / smallest distance across a loop",
            _edge_length(loops[0]) / gap,
            matters=gap < _edge_length(loops[0]),
            fatal=gap < _edge_length(loops[0]) / 2,
        ),
        *_twist_left_out(found),
        *_gauss_left_out(found, scene),
        OmittedTerm(
            "wire's softness beyond small stretch",
            "largest wire strain",
            strain,
            matters=strain > LARGEST_WIRE_STRAIN,
        ),
    )


def wrinkles_escape(found: MeshEquilibrium) -> bool:
    """Whether compressed fabric may have wrinkles that are too fine for the mesh.

    A wave takes four edges of the fabric's edge, at least.
    """
    scene = found.scene.loop if isinstance(found.scene, ArrayScene) else found.scene
    finest = len(found.mesh.wires[0].vertices) / _EDGES_PER_WAVE
    return finest_wrinkle(found.smallest_stress, scene.alpha) > finest


def _twist_left_out(found: MeshEquilibrium) -> tuple[OmittedTerm, ...]:
    """Twist of the wires that have none in the energy: the largest, over the energy of a loop."""
    scene, mesh = found.scene, found.mesh
    own = scene.stiffness if isinstance(scene, ArrayScene) else (loop_wire(scene),)
    energies = [
        twist_stiffness(mesh, wire, stiffness, ROUND_WIRE_TWIST_RATIO)
        * writhe(_thinned(found.positions[wire.vertices])) ** 2
        for wire, stiffness in zip(mesh.wires, own, strict=True)
        if stiffness.twist_ratio == 0
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


def _wire_strain(found: MeshEquilibrium, wire: Wire) -> float:
    now, flat = (_edges(points[wire.vertices]) for points in (found.positions, found.mesh.points))
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
