"""Solve whatever scene the mesh knows, in the way that is its own."""

from __future__ import annotations

from solver.mesh.any_scene import MeshScene
from solver.mesh.drawing import SEGMENTS
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.scene import ArrayScene
from solver.mesh.sheet import SheetScene
from solver.mesh.solve import solve_array, solve_loop_mesh
from solver.mesh.solve_sheet import solve_sheet

_STEPS, _STEPS_OF_A_SHEET = 500, 200
"""On each mesh, by default."""


def solve_on_mesh(
    scene: MeshScene,
    refinement: int,
    *,
    tension_field: bool,
    allow_unreliable: bool,
    segments: int = SEGMENTS,
    most_steps: int | None = None,
) -> MeshEquilibrium:
    """Solve a scene without contact; see `solver.mesh.solve` for the options and errors.

    ``most_steps`` is on each mesh; by default what the scene's kind needs.
    """
    if isinstance(scene, SheetScene):
        return solve_sheet(
            scene,
            refinement=refinement,
            segments=segments,
            tension_field=tension_field,
            allow_unreliable=allow_unreliable,
            most_steps=most_steps or _STEPS_OF_A_SHEET,
        )
    if isinstance(scene, ArrayScene):
        return solve_array(
            scene,
            refinement=refinement,
            segments=segments,
            tension_field=tension_field,
            allow_unreliable=allow_unreliable,
            most_steps=most_steps or _STEPS,
        )
    return solve_loop_mesh(
        scene,
        refinement=refinement,
        segments=segments,
        tension_field=tension_field,
        allow_unreliable=allow_unreliable,
        most_steps=most_steps or _STEPS,
    )
