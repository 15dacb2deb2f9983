"""What helps where a mesh has no shape to rely on, as far as the ladder knows."""

from __future__ import annotations

import math
from collections.abc import Sequence

from solver.errors import NotConvergedError
from solver.ladder.contact import WITHOUT
from solver.ladder.mesh_error import mesh_error
from solver.mesh.any_scene import MeshScene
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.sheet import SheetScene


def refused(
    fault: str, before: Sequence[MeshEquilibrium], scene_in_contact: MeshScene | None = None
) -> NotConvergedError:
    """Say which limit a solve met, and what else would have a shape: a coarser mesh may.

    Parameters
    ----------
    fault : str
        That limit, and what of the scene to change.
    before : sequence of MeshEquilibrium
        Shapes on coarser meshes. The first alone answers nothing.
    scene_in_contact : MeshScene, optional
        What was solved with contact; designs have no option to leave that out.
    """
    remedies = [fault]
    can_do_without = scene_in_contact is not None and not isinstance(scene_in_contact, SheetScene)
    if can_do_without and WITHOUT not in fault:
        remedies.append(WITHOUT)
    error = mesh_error(before[-1], before[:-1]) if len(before) > 1 else math.inf
    if math.isfinite(error):
        coarser = f"the mesh before, of {len(before[-1].mesh.triangles)} triangles, has a shape"
        remedies.append(f"allow a tolerance above {error:.1e}: {coarser}")
    return NotConvergedError(", or ".join(remedies))
