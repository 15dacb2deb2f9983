"""The list of blocks beside a stitch file: what is on the needle, in which colour, and what to do.

DST, EXP and U01 hold no colours; this list stands in for them, a line a block, for a spreadsheet.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence

from patterns.plan import StitchPlan
from sesame_cad.threads import Thread

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
"""Headings. ``block`` counts from 1; ``colour`` is that of files which hold colours, as in
HTML; ``colour_name`` names the thread on the spool; ``instruction`` is what the operator
does at the stop before the block."""


def block_list_csv(plan: StitchPlan, threads: Sequence[Thread]) -> str:
    """List the blocks of a plan as comma-separated values (RFC 4180), with headings.

    Parameters
    ----------
    threads
        One for each block.
    """
    text = io.StringIO()
    writer = csv.writer(text)
    writer.writerow(COLUMNS)
    for k, (block, thread) in enumerate(zip(plan.blocks, threads, strict=True)):
        writer.writerow(
            (
                k + 1,
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
