"""Ties that hold neighbouring loops to each other where they touch."""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, sin

import numpy as np

from patterns.errors import PatternError
from patterns.instructions import with_thread
from patterns.laid_wire import LaidWire
from patterns.layout import Contact, Layout
from patterns.machine import Machine
from patterns.plan import Block, BlockKind
from patterns.sewn_run import thread_run
from patterns.stitching import Stitching
from patterns.ties import tie_runs

_TOGETHER_MM = 1e-6


def contact_ties(
    layout: Layout,
    laid: LaidWire,
    *,
    clear_mm: float,
    machine: Machine,
    stitching: Stitching,
) -> Block | None:
    """Sew a tie over both wires of every contact, from inside one loop to inside the other.

    Tied so, the loops stay tangent after release, as the model takes them to be; the bars lie
    square to the tangent, about which the loops may hinge. Both wires lie below the thread,
    with the cover between them; the needle goes in on either side of both.

    Parameters
    ----------
    laid
        All wire.
    clear_mm
        Smallest distance of the needle from a centreline.

    Returns
    -------
    Block or None
        The ties, row by row, forth and back; none where no two loops touch.

    Raises
    ------
    PatternError
        When a tie would bring the needle to a wire; the message says where and what would help.
    """
    if not layout.contacts:
        return None
    contacts = list(_row_by_row(layout))
    normals = [layout.loops[c.first].normal_rad(c.x_mm, c.y_mm) for c in contacts]
    try:
        runs = tie_runs(
            np.array([(c.x_mm, c.y_mm) for c in contacts]),
            np.array([(cos(angle), sin(angle)) for angle in normals]),
            laid,
            length_mm=2 * (clear_mm + stitching.lock_length_mm),  # locks lie on either side of wire
            clear_mm=clear_mm,
            lock_length_mm=stitching.lock_length_mm,
        )
    except PatternError as error:
        raise PatternError(
            f"{error}; take larger loops, shorter locks, a thinner needle, or "
            'stitching.ties = "none"'
        ) from None
    count = f"{len(runs)} contact{'s' if len(runs) > 1 else ''}"
    what = f"a thread that does not stretch: ties over both wires where loops touch, {count}."
    sewn = tuple(thread_run(run, machine) for run in runs)
    return Block(BlockKind.TIES, with_thread(machine, what), sewn)


def _row_by_row(layout: Layout) -> Iterator[Contact]:
    """Contacts of equal height together, every other row backward: short ways between them."""
    heights = sorted({round(contact.y_mm / _TOGETHER_MM) for contact in layout.contacts})
    rank = {height: k for k, height in enumerate(heights)}

    def place(contact: Contact) -> tuple[int, float]:
        row = rank[round(contact.y_mm / _TOGETHER_MM)]
        return row, contact.x_mm if row % 2 == 0 else -contact.x_mm

    yield from sorted(layout.contacts, key=place)
