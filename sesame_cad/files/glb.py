"""GLB (binary glTF 2.0): the array as viewers and browsers show it, in its colours."""

from __future__ import annotations

import io
from collections.abc import Iterable
from typing import cast

import numpy as np
import trimesh
from numpy.typing import NDArray
from trimesh.transformations import translation_matrix
from trimesh.visual import TextureVisuals
from trimesh.visual.material import PBRMaterial

from sesame_cad.bodies import Body
from sesame_cad.errors import DesignFileError
from sesame_cad.files.body_colours import COLOURS, rgba

M_PER_MM = 1e-3

UPRIGHT = np.diag([M_PER_MM, M_PER_MM, M_PER_MM, 1.0])[[0, 2, 1, 3]] * [[1], [1], [-1], [1]]
"""From mm with z up to glTF's metres with y up (Khronos, glTF 2.0 specification, 3.4)."""

_METALLIC = {"fabric": 0.0, "wire": 0.7}
_ROUGHNESS = {"fabric": 0.9, "wire": 0.4}


def write_glb(bodies: Iterable[Body]) -> bytes:
    """Encode bodies, each once, with a node for every place where it stands."""
    scene = trimesh.Scene()
    for body in bodies:
        mesh = trimesh.Trimesh(body.points, body.faces, process=False)
        mesh.visual = TextureVisuals(material=_material(body.material))
        for number, (x, y) in enumerate(body.places_mm, 1):
            placed = UPRIGHT @ translation_matrix([x, y, 0.0])
            node = f"{body.name} at {number}"
            if number == 1:
                scene.add_geometry(mesh, geom_name=body.name, node_name=node, transform=placed)
            else:
                scene.graph.update(frame_to=node, geometry=body.name, matrix=placed)
    return cast("bytes", scene.export(file_type="glb"))


def read_glb(content: bytes) -> NDArray[np.float64]:
    """Points (n, 3) in mm, z up, of every body in every place.

    Raises
    ------
    DesignFileError
        When it is no GLB file with bodies.
    """
    try:
        scene = trimesh.load_scene(io.BytesIO(content), file_type="glb")
        points = np.asarray(scene.to_mesh().vertices, dtype=np.float64)
    except Exception as error:
        # the reader fails in as many ways as a file can be broken
        raise DesignFileError(f"no GLB file: {type(error).__name__}: {error}") from None
    if not points.size:
        raise DesignFileError("a GLB file without bodies")
    return points @ np.linalg.inv(UPRIGHT[:3, :3]).T


def _material(name: str) -> PBRMaterial:
    return PBRMaterial(
        name=name,
        baseColorFactor=rgba(COLOURS[name]),
        metallicFactor=_METALLIC[name],
        roughnessFactor=_ROUGHNESS[name],
    )
