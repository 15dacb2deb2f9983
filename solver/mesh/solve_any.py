"""Solve whatever scene the mesh knows, in the way that is its own."""

from __future__ import annotations

from solver.mesh.any_scene import MeshScene
from solver.mesh.drawing import SEGMENTS
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.scene import ArrayScene
from solver.mesh.sheet import SheetScene
from solver.mesh.solve import solve_array, solve_loop_mesh
from solver.mesh.solve_sheet import solve_sheet


def solve_on_mesh(
    scene: MeshScene,
    refinement: int,
    *,
    tension_field: bool,
    allow_unreliable: bool,
    segments: int = SEGMENTS,
) -> MeshEquilibrium:
    """Solve a scene without contact; see `solver.mesh.solve` for the options and errors."""
    if isinstance(scene, SheetScene):
        return solve_sheet(
            scene,
            refinement=refinement,
            segments=segments,
            tension_field=tension_field,
            allow_unreliable=allow_unreliable,
        )
    if isinstance(scene, ArrayScene):
        return solve_array(
            scene,
            refinement=refinement,
            segments=segments,
            tension_field=tension_field,
            allow_unreliable=allow_unreliable,
        )
    return solve_loop_mesh(
        scene,
        refinement=refinement,
        segments=segments,
        tension_field=tension_field,
        allow_unreliable=allow_unreliable,
    )
