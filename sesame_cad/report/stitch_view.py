"""The stitches as the machine will make them: what the stitch player shows."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from patterns.circuit import Circuit
from patterns.records import Command, Records
from patterns.violation import Violation
from sesame_cad.drawing_colours import stage_colour
from sesame_cad.pipeline import Design
from sesame_cad.report.packing import packed_integers, packed_reals, unpacked
from sesame_cad.threads import Thread, threads_of

Data = dict[str, Any]

STITCH_DATA = "stitch-data"
"""Name of the data in the page."""


def of_layer(name: str, layer: str) -> str:
    """Give the name of something in a page, of one of several layers if there are such."""
    return f"{name}-{layer}" if layer else name


CODES = (Command.STITCH, Command.JUMP, Command.STOP, Command.END)
"""Commands by their number in the page."""

WIRE_STEP_MM = 1.0
"""The wire is drawn through points of its centreline that are this near each other."""


def stitch_view(design: Design, records: Records, violations: Sequence[Violation]) -> Data:
    """Data of the stitch player.

    Parameters
    ----------
    records : Records
        As decoded from the DST file.
    violations : sequence of Violation
        Rules that they break; none in a package.
    """
    laid, spec = design.pattern, design.spec
    diameters = laid.circuit.of_stages(spec.diameters_mm)
    blocks = zip(laid.plan.blocks, threads_of(laid.plan, spec.machine), strict=True)
    return {
        "steps": packed_integers(np.diff(records.xy, axis=0, prepend=0).astype(np.int8)),
        "commands": packed_integers(_codes(records)),
        "blocks": [
            {
                "kind": str(block.kind),
                "instruction": block.instruction,
                "wire": _wire(laid.circuit, block.stage, diameters) if block.kind.is_wire else None,
            }
            | _thread(thread)
            for block, thread in blocks
        ],
        "rings": [packed_reals(ring) for ring in laid.outline.rings],
        "hoopMm": [spec.machine.hoop_width_mm, spec.machine.hoop_height_mm],
        "violations": [
            {"rule": one.rule, "text": str(one), "xMm": one.x_mm, "yMm": one.y_mm}
            for one in violations
        ],
    }


def viewed_records(data: Data) -> Records:
    """Read the records back out of what `stitch_view` gave."""
    names = np.array([str(command) for command in CODES])
    steps = unpacked(data["steps"]).astype(np.int64)
    return Records(names[unpacked(data["commands"])], np.cumsum(steps, axis=0))


def _codes(records: Records) -> NDArray[np.uint8]:
    codes = np.zeros(len(records.command), dtype=np.uint8)
    for code, command in enumerate(CODES):
        codes[records.command == command] = code
    return codes


def _thread(thread: Thread) -> Data:
    return {
        "material": thread.material,
        "place": thread.place,
        "colour": thread.colour,
        "colourName": thread.colour_name,
    }


def _wire(circuit: Circuit, stage: int, diameters_mm: tuple[float, ...]) -> Data:
    path = circuit.stages[stage]
    count = max(2, int(np.ceil(path.length_mm / WIRE_STEP_MM)) + 1)
    points, _ = path.at(np.linspace(0, path.length_mm, count))
    return {
        "diameterMm": diameters_mm[stage],
        "colour": stage_colour(stage),
        "points": packed_reals(points),
    }
