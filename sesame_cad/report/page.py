"""`report.html`: a design in one page that needs no network and no other file."""

from __future__ import annotations

from collections.abc import Sequence
from string import Template
from typing import Any

from matplotlib import colormaps

from patterns.records import Records
from patterns.violation import Violation
from sesame_cad.pipeline import Design
from sesame_cad.report.assets import asset, page, script
from sesame_cad.report.circuit_drawing import circuit_drawing
from sesame_cad.report.cut_drawing import cut_drawing
from sesame_cad.report.embedding import embedded
from sesame_cad.report.file_links import file_links
from sesame_cad.report.sections import (
    numbers_section,
    player,
    rules_section,
    shape_section,
    warnings_section,
)
from sesame_cad.report.shape_view import shape_view
from sesame_cad.report.stitch_view import STITCH_DATA, stitch_view
from sesame_cad.report.tables import circuits_table, inputs_table

Data = dict[str, Any]

REPORT_FILE = "report.html"

_COLOURS = 64


def report_html(
    design: Design, data: Data, records: Records, violations: Sequence[Violation] = ()
) -> str:
    """Write the page.

    Parameters
    ----------
    data : dict
        What `design.json` holds, with the files that lie beside the page.
    records : Records
        As decoded from the DST file.
    violations : sequence of Violation
        Rules that these records break; a package has none.
    """
    laid = design.pattern
    shape, stitches = shape_view(design), stitch_view(design, records, violations)
    diameters = laid.circuit.of_stages(design.spec.diameters_mm)
    return page(
        "page",
        data["name"],
        warnings=warnings_section(data),
        shape=shape_section(shape, Template(asset("viewer.html"))),
        rules=rules_section(stitches),
        player=player(records, stitches),
        cut=cut_drawing(laid),
        circuit=circuit_drawing(laid, data["circuits"], diameters),
        circuits=circuits_table(data),
        numbers=numbers_section(data),
        inputs=inputs_table(data),
        files=file_links(["design.json", *data["files"]]),
        data="\n".join(
            embedded(name, value)
            for name, value in (
                ("shape-data", shape),
                (STITCH_DATA, stitches),
                ("colours", {"fabric": _colours("viridis"), "wire": _colours("plasma")}),
            )
            if value is not None
        ),
        script=script(),
    )


def _colours(name: str) -> list[list[int]]:
    """Colours of a scale from low to high, as a person with any colour vision tells them apart."""
    table = colormaps[name]
    return [[round(255 * part) for part in table(k / (_COLOURS - 1))[:3]] for k in range(_COLOURS)]
