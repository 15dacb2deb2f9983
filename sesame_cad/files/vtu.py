"""VTU: a solved mesh and its fields, for ParaView.

The format is VTK's XML file format for unstructured grids (The VTK User's Guide, "VTK File
Formats"), with arrays in base64, each behind its number of bytes.
"""

from __future__ import annotations

from base64 import b64decode, b64encode
from collections.abc import Iterator
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
from numpy.typing import NDArray

from sesame_cad.errors import DesignFileError
from sesame_cad.solved_mesh import SolvedMesh

Array = NDArray[Any]

_SIZE_BYTES = 8
_LINE, _TRIANGLE = 3, 5
FABRIC, WIRE = 0, 1
"""Values of the cells' array ``material``."""

_TYPES = {"float64": "Float64", "int64": "Int64", "uint8": "UInt8"}


def write_vtu(solved: SolvedMesh) -> bytes:
    """Encode triangles of fabric and the edges along the wires.

    Point arrays: ``flat_mm`` (place in the hoop), ``curvature_per_mm`` (of the wire). Cell arrays:
    ``material`` (0 fabric, 1 wire), and of fabric ``smaller_stretch``, ``larger_stretch`` (length
    over that of unstretched fabric), ``smaller_stress_kPa``, ``larger_stress_kPa`` (second
    Piola–Kirchhoff). Where a quantity has no meaning it is no number.
    """
    return "\n".join(_lines(solved)).encode("ascii") + b"\n"


def read_vtu(content: bytes) -> NDArray[np.float64]:
    """Points (n, 3) in mm of a file as `write_vtu` makes it.

    Raises
    ------
    DesignFileError
        When it is no such file.
    """
    try:
        array = ET.fromstring(content).find(".//Points/DataArray")
        raw = b64decode((array.text or "") if array is not None else "", validate=True)
        return np.frombuffer(raw[_SIZE_BYTES:], "<f8").reshape(-1, 3)
    except (ET.ParseError, ValueError) as error:
        raise DesignFileError(f"no VTU file as this program writes it: {error}") from None


def _lines(solved: SolvedMesh) -> Iterator[str]:
    triangles, edges = solved.mesh.triangles, solved.wire_edges
    count = len(triangles) + len(edges)
    yield '<?xml version="1.0"?>'
    yield (
        '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" '
        'header_type="UInt64">'
    )
    yield "<UnstructuredGrid>"
    yield f'<Piece NumberOfPoints="{len(solved.points_mm)}" NumberOfCells="{count}">'
    yield "<PointData>"
    flat = np.column_stack([solved.flat_mm, np.zeros(len(solved.flat_mm))])
    yield _array("flat_mm", flat)
    yield _array("curvature_per_mm", solved.curvature_per_mm)
    yield "</PointData>"
    yield "<CellData>"
    material = np.repeat(np.array([FABRIC, WIRE], np.uint8), [len(triangles), len(edges)])
    yield _array("material", material)
    for name, values in _fabric(solved).items():
        yield _array(name, np.append(values, np.full(len(edges), np.nan)))
    yield "</CellData>"
    yield "<Points>"
    yield _array("points_mm", solved.points_mm)
    yield "</Points>"
    yield "<Cells>"
    yield _array("connectivity", np.append(triangles, edges))
    sizes = np.repeat([3, 2], [len(triangles), len(edges)])
    yield _array("offsets", np.cumsum(sizes))
    kinds = np.where(material == WIRE, _LINE, _TRIANGLE).astype(np.uint8)
    yield _array("types", kinds)
    yield "</Cells>"
    yield "</Piece>"
    yield "</UnstructuredGrid>"
    yield "</VTKFile>"


def _fabric(solved: SolvedMesh) -> dict[str, Array]:
    fabric, unit = solved.fabric, solved.modulus_kPa
    return {
        "smaller_stretch": fabric.smaller_stretch,
        "larger_stretch": fabric.larger_stretch,
        "smaller_stress_kPa": fabric.smaller_stress * unit,
        "larger_stress_kPa": fabric.larger_stress * unit,
    }


def _array(name: str, values: Array) -> str:
    kind = _TYPES[values.dtype.name]
    width = f' NumberOfComponents="{values.shape[1]}"' if values.ndim > 1 else ""
    raw = np.ascontiguousarray(values, values.dtype.newbyteorder("<")).tobytes()
    text = b64encode(len(raw).to_bytes(_SIZE_BYTES, "little") + raw).decode("ascii")
    return f'<DataArray type="{kind}" Name="{name}"{width} format="binary">{text}</DataArray>'
