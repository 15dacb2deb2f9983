"""How finely the loops of a large array are divided."""

from __future__ import annotations

from solver.mesh.any_scene import MeshScene
from solver.mesh.array_mesh import array_fan
from solver.mesh.drawing import SEGMENTS
from solver.mesh.scene import ArrayScene

MOST_TRIANGLES = 30_000
"""Of the finest mesh, if coarser ones do not have more already."""

_FINER = (28, 24)
"""Edges of a loop where a mesh refined twice would be too large."""


def edges_of_a_loop(scene: MeshScene) -> int:
    """Edges of a loop on the coarsest mesh: more where meshes are refined only once."""
    if not isinstance(scene, ArrayScene) or _triangles(scene, SEGMENTS, 2) <= MOST_TRIANGLES:
        return SEGMENTS
    fitting = (n for n in _FINER if _triangles(scene, n, 1) <= MOST_TRIANGLES)
    return next(fitting, SEGMENTS)


def loop_vertices(segments: int, refinement: int) -> int:
    """Vertices of one loop's mesh: rings of so many, twice, … round a middle, split so often."""
    rings = 2**refinement
    return 1 + segments * rings * (rings + 1) // 2


def _triangles(scene: ArrayScene, segments: int, refinement: int) -> int:
    coarsest = array_fan(scene.grid, scene.between, scene.loop.axis_ratio, segments)
    return len(coarsest.triangles) * 4**refinement
