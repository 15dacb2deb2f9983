"""Binary STL, for printing."""

from __future__ import annotations

import struct

import numpy as np
import trimesh

from sesame_cad.files.dst import clean_label

HEADER_BYTES = 80

_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def write_stl(mesh: trimesh.Trimesh, name: str) -> bytes:
    """Encode a mesh in millimetres; the same mesh always gives the same bytes."""
    corners = np.asarray(mesh.triangles, dtype=np.float64)
    table = np.zeros(len(corners), dtype=_TRIANGLE)
    table["corners"] = corners
    table["normal"] = np.asarray(mesh.face_normals, dtype=np.float64)
    # A header that begins with "solid" would be taken for the text form.
    header = f"binary STL in mm: {clean_label(name)}".encode("ascii").ljust(HEADER_BYTES, b" ")
    return header + struct.pack("<I", len(table)) + table.tobytes()
