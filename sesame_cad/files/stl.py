"""Binary STL, for printing."""

from __future__ import annotations

import struct

import numpy as np
import trimesh

from sesame_cad.errors import DesignFileError
from sesame_cad.files.dst import clean_label

HEADER_BYTES = 80
_COUNT_BYTES = 4

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


def read_stl(data: bytes) -> trimesh.Trimesh:
    """Decode a binary STL and merge the corners that triangles share.

    Raises
    ------
    DesignFileError
        When the length does not fit the number of triangles, or a coordinate is no number.
    """
    size = len(data) - HEADER_BYTES - _COUNT_BYTES
    count = struct.unpack_from("<I", data, HEADER_BYTES)[0] if size >= 0 else 0
    if size < 0 or size != count * _TRIANGLE.itemsize:
        raise DesignFileError(f"{len(data)} bytes are no binary STL of {count} triangles")
    table = np.frombuffer(data, dtype=_TRIANGLE, offset=HEADER_BYTES + _COUNT_BYTES)
    corners = table["corners"].astype(np.float64).reshape(-1, 3)
    if count == 0 or not np.all(np.isfinite(corners)):
        raise DesignFileError("the STL has no triangles, or corners that are no numbers")
    faces = np.arange(len(corners)).reshape(-1, 3)
    mesh = trimesh.Trimesh(corners, faces, process=False)
    mesh.merge_vertices()
    return mesh
