"""3MF: the array in mm and in its colours, for printing with two materials.

Written by hand, since trimesh's writer knows no colours and puts random identifiers in. The format
is that of the 3MF Consortium's core specification 1.3 (2021) with ``basematerials``.
"""

from __future__ import annotations

import io
import zipfile
import zlib
from collections.abc import Iterable, Iterator
from xml.etree import ElementTree as ET
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from sesame_cad.bodies import Body
from sesame_cad.errors import DesignFileError
from sesame_cad.files.body_colours import COLOURS

MODEL_PATH = "3D/3dmodel.model"

_CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
_PACKAGE = "http://schemas.openxmlformats.org/package/2006"
_MODEL_TYPE = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"

_HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n'

_CONTENT_TYPES = (
    f'{_HEAD}<Types xmlns="{_PACKAGE}/content-types">'
    f'<Default Extension="rels" ContentType='
    f'"application/vnd.openxmlformats-package.relationships+xml"/>'
    f'<Default Extension="model" ContentType='
    f'"application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>\n'
)

_RELATIONS = (
    f'{_HEAD}<Relationships xmlns="{_PACKAGE}/relationships">'
    f'<Relationship Type="{_MODEL_TYPE}" Target="/{MODEL_PATH}" Id="model"/></Relationships>\n'
)

_MATERIALS = 1
"""Number of the resource that lists the materials; bodies come after it."""

_DATE = (1980, 1, 1, 0, 0, 0)
"""The earliest that a zip file can tell: no file tells when it was made."""


def write_3mf(bodies: Iterable[Body], name: str) -> bytes:
    """Encode bodies as the parts of one object; each once, with the places where it stands."""
    model = "".join(_model(tuple(bodies), name))
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as package:
        for path, text in (
            ("[Content_Types].xml", _CONTENT_TYPES),
            ("_rels/.rels", _RELATIONS),
            (MODEL_PATH, model),
        ):
            entry = zipfile.ZipInfo(path, _DATE)
            entry.compress_type = zipfile.ZIP_DEFLATED
            package.writestr(entry, text)
    return stream.getvalue()


def read_3mf(content: bytes) -> NDArray[np.float64]:
    """Points (n, 3) in mm of every part in every place, of a file as `write_3mf` makes it.

    Raises
    ------
    DesignFileError
        When it is no such file.
    """
    space = {"": _CORE}
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as package:
            root = ET.fromstring(package.read(MODEL_PATH))
        meshes = {
            one.get("id"): np.array(
                [[float(v.attrib[k]) for k in "xyz"] for v in one.iterfind(".//vertex", space)]
            )
            for one in root.iterfind(".//object", space)
        }
        placed = [
            meshes[part.get("objectid")] + [float(p) for p in part.attrib["transform"].split()[-3:]]
            for part in root.iterfind(".//component", space)
        ]
        return np.concatenate(placed)
    except (zipfile.BadZipFile, zlib.error, ET.ParseError, KeyError, ValueError) as error:
        raise DesignFileError(f"no 3MF file as this program writes it: {error}") from None


def _model(bodies: tuple[Body, ...], name: str) -> Iterator[str]:
    yield f'{_HEAD}<model unit="millimeter" xml:lang="en" xmlns="{_CORE}">\n<resources>\n'
    yield f'<basematerials id="{_MATERIALS}">'
    for material, colour in COLOURS.items():
        yield f'<base name="{material}" displaycolor="{colour}"/>'
    yield "</basematerials>\n"
    first = _MATERIALS + 1
    for number, body in enumerate(bodies, first):
        yield from _mesh(number, body)
    whole = first + len(bodies)
    yield f'<object id="{whole}" type="model" name={quoteattr(name)}><components>\n'
    for number, body in enumerate(bodies, first):
        for x, y in body.places_mm.tolist():
            at = f"1 0 0 0 1 0 0 0 1 {_number(x)} {_number(y)} 0"
            yield f'<component objectid="{number}" transform="{at}"/>\n'
    yield f'</components></object>\n</resources>\n<build><item objectid="{whole}"/></build>\n'
    yield "</model>\n"


def _mesh(number: int, body: Body) -> Iterator[str]:
    material = list(COLOURS).index(body.material)
    yield (
        f'<object id="{number}" type="model" name={quoteattr(body.name)} pid="{_MATERIALS}" '
        f'pindex="{material}"><mesh>\n<vertices>\n'
    )
    for x, y, z in body.points.tolist():
        yield f'<vertex x="{_number(x)}" y="{_number(y)}" z="{_number(z)}"/>\n'
    yield "</vertices>\n<triangles>\n"
    for a, b, c in body.faces.tolist():
        yield f'<triangle v1="{a}" v2="{b}" v3="{c}"/>\n'
    yield "</triangles>\n</mesh></object>\n"


def _number(value: float) -> str:
    """A length in mm to a millionth; never in powers of ten, never -0."""
    text = f"{value:.6f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
