"""`report.html` of beams with sleeves: both hoopings, the sheets, and what the sleeves do."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable, Iterator, Mapping
from html import escape
from typing import Any

from patterns.records import Records
from sesame_cad.files.cut_line import cut_line
from sesame_cad.report.assets import page, script
from sesame_cad.report.circuit_drawing import circuit_drawing
from sesame_cad.report.cut_drawing import cut_drawing
from sesame_cad.report.embedding import embedded
from sesame_cad.report.file_links import file_links
from sesame_cad.report.sections import player, rules_section, warnings_list
from sesame_cad.report.sheet_drawing import sheet_drawing
from sesame_cad.report.stitch_view import STITCH_DATA, of_layer, stitch_view
from sesame_cad.report.tables import circuits_table, inputs_table, table
from sesame_cad.sleeve.design import SleeveDesign
from sesame_cad.sleeve.summary import sleeve_rows, sleeve_warnings

Data = dict[str, Any]

_NO_STATES = '<p class="note">No states are predicted: layout.shape is "none".</p>'


def sleeve_report_html(
    design: SleeveDesign,
    data: Data,
    records: Mapping[str, Records],
    pictures: Iterable[tuple[str, bytes]],
) -> str:
    """Write the page.

    Parameters
    ----------
    data : dict
        What `design.json` holds, with the files that lie beside the page.
    records : mapping
        Those of each layer, as decoded from its DST file.
    pictures : iterable
        Words for each picture of the states, and the picture, a PNG.
    """
    views = {name: stitch_view(one, records[name], ()) for name, one in design.hoopings.items()}
    return page(
        "sleeves",
        data["name"],
        warnings=warnings_list(sleeve_warnings(data)),
        states="".join(_picture(*one) for one in pictures) or _NO_STATES,
        stitches="".join(
            f"<h3>{name} array</h3>{rules_section(view)}" + player(records[name], view, name)
            for name, view in views.items()
        ),
        sheets="".join(_sheets(design)),
        fabric="".join(_fabric(design)),
        circuits="".join(_circuits(design, data)),
        numbers=table((), sleeve_rows(data)) + _left_out(data),
        inputs=inputs_table(data),
        files=file_links(["design.json", *data["files"]]),
        data="\n".join(embedded(of_layer(STITCH_DATA, name), view) for name, view in views.items()),
        script=script(),
    )


def _picture(words: str, content: bytes) -> str:
    encoded = b64encode(content).decode("ascii")
    return (
        f'<figure><img alt="{escape(words)}" style="max-width: 100%" '
        f'src="data:image/png;base64,{encoded}"><figcaption>{escape(words)}</figcaption></figure>'
    )


def _sheets(design: SleeveDesign) -> Iterator[str]:
    for sheet in design.pattern.cutting.sheets:
        drawn = sheet_drawing(map(cut_line, sheet.cuts), sheet.nested.mat, sheet.name)
        yield (
            f"<figure>{drawn}<figcaption>Sheet {escape(sheet.name)}: lines inside pieces (blue) "
            "are cut before their outsides (red); lines every centimetre.</figcaption></figure>"
        )


def _fabric(design: SleeveDesign) -> Iterator[str]:
    for name, made in design.hoopings.items():
        yield (
            f"<figure>{cut_drawing(made.pattern)}<figcaption>Fabric of the {name} array, stretched "
            "in its hoop, in mm.</figcaption></figure>"
        )


def _circuits(design: SleeveDesign, data: Data) -> Iterator[str]:
    for name, made in design.hoopings.items():
        laid, layer = made.pattern, data["hoopings"][name]
        diameters = laid.circuit.of_stages(made.spec.diameters_mm)
        yield (
            f"<figure>{circuit_drawing(laid, layer['circuits'], diameters)}<figcaption>Wire of the "
            f"{name} array; A and B are its terminals.</figcaption></figure>"
        )
        yield circuits_table(layer)


def _left_out(data: Data) -> str:
    """Say what the model leaves out, and by which number that is judged."""
    if data["sleeve"] is None:
        return ""
    rows = [
        (
            one["term"],
            one["measure"],
            ("not known" if one["value"] is None else f"{one['value']:.3g}")
            + (", matters" if one["matters"] else ""),
        )
        for one in data["sleeve"]["omitted_terms"]
    ]
    head = ("left out", "judged by", "")
    return table(head, rows, caption="What the model leaves out")
