"""The list of blocks beside a stitch file: what is on the needle, in which colour, and what to do.

DST, EXP and U01 hold no colours; this list stands in for them, a line a block, for a spreadsheet.
"""

from __future__ import annotations

import csv
import io

from patterns.plan import StitchPlan
from sesame_cad.threads import thread_of

COLUMNS = (
    "block",
    "head",
    "needle",
    "material",
    "colour",
    "colour_name",
    "stitches",
    "instruction",
)
"""Headings. ``block`` counts from 1; ``colour`` is as in HTML; ``instruction`` is what the operator
does at the stop before the block."""


def block_list_csv(plan: StitchPlan) -> str:
    """List the blocks of a plan as comma-separated values (RFC 4180), with headings."""
    text = io.StringIO()
    writer = csv.writer(text)
    writer.writerow(COLUMNS)
    for number, block in enumerate(plan.blocks, start=1):
        thread = thread_of(block)
        writer.writerow(
            (
                number,
                thread.head,
                thread.needle,
                thread.material,
                thread.colour,
                thread.colour_name,
                sum(len(run.needles) for run in block.runs),
                block.instruction,
            )
        )
    return text.getvalue()
