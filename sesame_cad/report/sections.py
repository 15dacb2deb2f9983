"""Parts of the page that are there only for some designs, and lists of what there may be many."""

from __future__ import annotations

from html import escape
from string import Template
from typing import Any

from patterns.records import Records
from sesame_cad.report.assets import asset
from sesame_cad.report.phase_diagram import phase_diagram
from sesame_cad.report.stitch_view import STITCH_DATA, of_layer
from sesame_cad.report.tables import accuracy_table, facts_table, omitted_table, shapes_table
from sesame_cad.summary import warnings

Data = dict[str, Any]

_WAY = {
    True: "Every shape on the slider's way is solved; between neighbours the page draws straight "
    "lines. Released, the loop takes the shapes that a softer and softer wire allows; "
    "heated, those of wire that is more and more austenite, at the temperatures below the slider.",
    False: "Flat, cold and hot are known; the shapes between them were not solved.",
}


def warnings_section(data: Data) -> str:
    """Say what may spoil the array, before anything else."""
    return warnings_list(warnings(data))


def warnings_list(found: list[str]) -> str:
    """List warnings, or say that there are none."""
    if not found:
        return '<p class="good">No warnings.</p>'
    items = "".join(f"<li>{escape(one)}</li>" for one in found)
    return f'<ul class="warnings">{items}</ul>'


def shape_section(view: Data | None, template: Template) -> str:
    """Give the 3-D view, or say that there is none."""
    if view is None:
        return '<p class="note">No shape is predicted: layout.shape is "none".</p>'
    states = view["states"]
    ends = len(states) - 1
    cold = next(k for k, state in enumerate(states) if state["stop"] == "cold")
    return template.substitute(
        way=escape(_way(view)), cold_percent=f"{100 * cold / ends:.2f}", last=ends
    )


def _way(view: Data) -> str:
    if view["kind"] == "cell" and not view["whole"]:
        return "Flat, cold and hot are solved; a shape between them did not come out."
    return _WAY[view["whole"]]


def player(records: Records, stitches: Data, layer: str = "") -> str:
    """Give a stitch player, of one of several layers if there are such."""
    return Template(asset("player.html")).substitute(
        id=of_layer("player", layer),
        stitches=of_layer(STITCH_DATA, layer),
        records=len(records.command),
        blocks=_block_items(stitches["blocks"]),
    )


def _block_items(blocks: list[Data]) -> str:
    """List the blocks of stitches as buttons that lead to the stop before each."""
    return "".join(
        f'<li><button type="button" data-block="{k}"><span class="spool" '
        f'style="background:{escape(block["colour"])}"></span><b>{k + 1}. '
        f"{escape(block['material'])}</b> <small>{escape(block['place'])}, "
        f"{escape(block['colourName'])}</small><span>{escape(block['instruction'])}</span>"
        "</button></li>"
        for k, block in enumerate(blocks)
    )


def rules_section(stitches: Data) -> str:
    """Say whether the stitches keep the design rules."""
    broken = stitches["violations"]
    if not broken:
        return '<p class="good">The design rules hold.</p>'
    items = "".join(f"<li>{escape(one['text'])}</li>" for one in broken)
    return f'<ul class="warnings">{items}</ul>'


def numbers_section(data: Data) -> str:
    """Give all tables, and the phase diagram of circles."""
    return "".join(
        [
            '<div class="columns"><div>',
            shapes_table(data),
            facts_table(data),
            "</div>",
            f"<figure>{_diagram(data)}</figure></div>",
            accuracy_table(data),
            omitted_table(data),
        ]
    )


def _diagram(data: Data) -> str:
    if data["cold"] is None:
        return ""
    if data["threshold"] is None:
        return (
            "<figcaption>The law of the threshold is that of circles, not of ellipses.</figcaption>"
        )
    threshold = data["threshold"]["critical_beta"]
    caption = (
        f"Where the design lies. A circle stays flat where β is {threshold:.4f} or more at this "
        "strain (the fabric's tension T = 12 β)."
    )
    return f"{phase_diagram(data)}<figcaption>{escape(caption)}</figcaption>"
