"""Datafiles for Surface Evolver 2.70, the program with which the SESAME paper found its shapes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sesame_cad.errors import InputError
from sesame_cad.files.evolver_commands import BENDING_FABRIC, COMMANDS, DECLARATIONS, HEAD
from solver.mesh.loop_mesh import loop_fan
from solver.mesh.triangulation import Mesh
from solver.mesh.triangulation import refinements as refined_meshes
from solver.reading import Reading
from solver.scene import LoopScene

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]

FEWEST_REFINEMENTS = 1
"""The unrefined fan has no vertex at 45°, where the pins must be."""

MOST_REFINEMENTS = 5
"""20,480 triangles, over which Evolver takes about half a minute."""

START_HEIGHT = 0.05
"""Of the start's crests, in units of R: enough to leave the flat loop, a saddle of the energy."""


@dataclass(frozen=True)
class _Sides:
    """Edges (e, 2) of a mesh, and the signed numbers (m, 3), from 1, of each triangle's sides."""

    edges: Indices
    of_triangle: Indices


def evolver_datafile(scene: LoopScene, refinements: int, start_height: float = START_HEIGHT) -> str:
    """Write one loop of radius 1 with commands that solve it; energies in units of E_f t R².

    The fabric is Evolver's ``linear_elastic`` on constant-strain triangles, and where it resists
    bending ``star_perp_sq_mean_curvature``; the wire is ``sqcurve_string_marked`` (bending) and
    ``hooke3_energy`` (stretch) along the boundary.
    Evolver's membrane is that of plane stress; the published reading is the same with
    ν' = ν/(1−ν) and the modulus 2 (1+ν')/(1+ν), in units of E_f.

    Parameters
    ----------
    scene : LoopScene
        A circular loop of isotropic fabric and of wire that is straight by nature.
    refinements : int
        How often the fan of 20 triangles is split in four, 1 to 5.
    start_height : float
        How far, in units of R, the start's crests rise; 0 starts flat.

    Returns
    -------
    str
        The file's text, in ASCII.

    Raises
    ------
    InputError
        When the datafile has no words for the scene, or a number is out of its range.
    """
    _check(scene, refinements, start_height)
    mesh = refined_meshes(loop_fan(), refinements)[-1]
    sides = _sides(mesh)
    keys = ("strain", "poisson", "beta", "axial_stiffness")
    numbers = {key: _text(getattr(scene, key)) for key in keys}
    lines = [
        HEAD.format(**numbers, reading=scene.reading, triangles=len(mesh.triangles)),
        DECLARATIONS.format(**numbers, modulus=_text(_membrane(scene)[1])),
        *([BENDING_FABRIC.format(alpha=_text(scene.alpha))] if scene.alpha > 0 else []),
        "vertices",
        *_vertices(mesh, start_height, inner="fabric_bend" if scene.alpha > 0 else ""),
        "\nedges",
        *_edges(mesh, sides),
        "\nfaces",
        *_faces(scene, mesh, sides),
        COMMANDS,
    ]
    return "\n".join(lines)


def _check(scene: LoopScene, refinements: int, start_height: float) -> None:
    faults = [
        f"{key} = {value:g}: Surface Evolver's datafile is written for {only} only"
        for key, value, allowed, only in (
            ("axis_ratio", scene.axis_ratio, 1, "circular loops"),
            ("modulus_ratio", scene.modulus_ratio, 1, "fabric that is equally stiff both ways"),
            ("natural_curvature", scene.natural_curvature, 0, "wire that is straight by nature"),
            ("twist_ratio", scene.twist_ratio, 0, "wire without twist"),
        )
        if value != allowed
    ]
    if not FEWEST_REFINEMENTS <= refinements <= MOST_REFINEMENTS:
        limits = f"from {FEWEST_REFINEMENTS} to {MOST_REFINEMENTS}"
        faults.append(f"refinements = {refinements}: must be {limits}")
    if not 0 <= start_height <= 1:
        faults.append(f"start_height = {start_height:g}: must be from 0 to 1")
    if faults:
        raise InputError(*faults)


def _membrane(scene: LoopScene) -> tuple[float, float]:
    """Poisson's ratio and modulus with which ``linear_elastic`` has the scene's density."""
    nu = scene.poisson
    if scene.reading is Reading.PLANE_STRESS:
        return nu, 1.0
    effective = nu / (1 - nu)
    return effective, 2 * (1 + effective) / (1 + nu)


def _sides(mesh: Mesh) -> _Sides:
    ends = np.stack([mesh.triangles, np.roll(mesh.triangles, -1, axis=1)], axis=2).reshape(-1, 2)
    edges, number = np.unique(np.sort(ends, axis=1), axis=0, return_inverse=True)
    forwards = np.where(ends[:, 0] < ends[:, 1], 1, -1)
    return _Sides(edges, (forwards * (1 + number.reshape(-1))).reshape(-1, 3))


def _pins(ring: Indices) -> dict[int, str]:
    """Constraints of the pinned vertices: six, as many as rigid motions, so that none bears load.

    They lie in the mirror planes and on the level lines of a saddle with its crests along x.
    """
    eighth = len(ring) // 8
    level = {int(ring[k * eighth]): "constraint 1" for k in (1, 3, 5)}
    return {0: "constraint 2 3", int(ring[0]): "constraint 3", **level}


def _vertices(mesh: Mesh, start_height: float, inner: str) -> Iterator[str]:
    ring = mesh.wires[0].vertices
    pins, on_wire = _pins(ring), set(ring.tolist())
    for k, (x, y) in enumerate(mesh.points.tolist()):
        pin = pins.get(k, "")
        z = 0.0 if pin == "constraint 1" else start_height * (x * x - y * y)
        words = [*map(_text, (x, y, z)), pin, "bend on_wire 1" if k in on_wire else inner]
        yield " ".join(filter(None, [str(1 + k), *words]))


def _edges(mesh: Mesh, sides: _Sides) -> Iterator[str]:
    wire = {frozenset(edge) for edge in mesh.wires[0].edges.tolist()}
    along = mesh.points[sides.edges[:, 1]] - mesh.points[sides.edges[:, 0]]
    length = np.linalg.norm(along, axis=1).tolist()
    for k, (tail, head) in enumerate(sides.edges.tolist()):
        line = f"{1 + k} {1 + tail} {1 + head}"
        if frozenset((tail, head)) in wire:
            line += f" stretch hooke_size {_text(length[k])} sqcurve_string_mark 1"
        yield line


def _faces(scene: LoopScene, mesh: Mesh, sides: _Sides) -> Iterator[str]:
    poisson = f"poisson_ratio {_text(_membrane(scene)[0])}"
    factors = _form_factors(mesh, scene.strain).tolist()
    for k, (edges, factor) in enumerate(zip(sides.of_triangle.tolist(), factors, strict=True)):
        shape = f"form_factors {{{','.join(map(_text, factor))}}}"
        yield f"{1 + k} {' '.join(map(str, edges))} tension 0 {poisson} {shape}"


def _form_factors(mesh: Mesh, strain: float) -> Vectors:
    """Products (m, 3) u·u, u·v, v·v of the sides u, v of each unstretched triangle at its corner.

    The unstretched state is the flat one, smaller by 1/(1+ε).
    """
    u, v = ((mesh.points[mesh.triangles[:, k]] - mesh.corner) / (1 + strain) for k in (1, 2))
    return np.stack([np.sum(a * b, axis=1) for a, b in ((u, u), (u, v), (v, v))], axis=1)


def _text(value: float) -> str:
    """Shortest text that reads back as the same number."""
    return repr(float(value) + 0.0)
