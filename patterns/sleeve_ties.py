"""Ties that hold an upper row of loops to a lower one, along both sides of the beam between."""

from __future__ import annotations

from math import cos, pi, radians, sin

import numpy as np

from patterns.couching import needle_clearance_mm
from patterns.instructions import with_thread
from patterns.laid_wire import LaidWire
from patterns.layout import Loop
from patterns.machine import Machine
from patterns.plan import Block, BlockKind
from patterns.sewn_run import thread_run
from patterns.stitching import Stitching
from patterns.ties import tie_runs

TIES_PER_EDGE = 2


def tie_block(
    loops: tuple[Loop, ...],
    laid: LaidWire,
    *,
    wire_diameter_mm: float,
    angle_deg: float,
    length_mm: float,
    machine: Machine,
    stitching: Stitching,
    before: str,
) -> Block:
    """Sew ties across the wire at both edges of every loop, on both sides of its stripe.

    The bars go over the wires of both layers, from inside the loops to the fabric outside, so that
    thread holds wire to wire; the needle goes in beside them.

    Parameters
    ----------
    loops
        Circles, row by row; ties are sewn along one edge of a row and back along the other.
    laid
        The wire of both layers.
    angle_deg
        Direction of the ties from the middle of a loop, measured from the stripe.
    length_mm
        From hole to hole.
    before
        What the operator does with beams and upper layer at the stop before.

    Raises
    ------
    PatternError
        As `patterns.ties.tie_runs`.
    """
    ways = np.array([way for row in _rows(loops) for way in _around(row, radians(angle_deg))])
    runs = tie_runs(
        ways[:, :2],
        ways[:, 2:],
        laid,
        length_mm=length_mm,
        clear_mm=needle_clearance_mm(wire_diameter_mm, machine, stitching),
        lock_length_mm=stitching.lock_length_mm,
    )
    what = "the thread that does not stretch: ties that hold the upper loops to the lower ones."
    text = f"{before} {with_thread(machine, what)}"
    return Block(BlockKind.TIES, text, tuple(thread_run(run, machine) for run in runs))


def _rows(loops: tuple[Loop, ...]) -> list[list[Loop]]:
    """Loops of equal height, from the lowest, each from the left."""
    heights = sorted({round(loop.y_mm, 6) for loop in loops})
    return [
        sorted((one for one in loops if round(one.y_mm, 6) == height), key=lambda one: one.x_mm)
        for height in heights
    ]


def _around(row: list[Loop], angle_rad: float) -> list[tuple[float, float, float, float]]:
    """Place on the wire, and direction across it, of the ties of a row."""
    lower = [3 * pi / 2 - angle_rad, 3 * pi / 2 + angle_rad]
    upper = [pi / 2 - angle_rad, pi / 2 + angle_rad]
    way = [(loop, angle) for loop in row for angle in lower]
    way += [(loop, angle) for loop in reversed(row) for angle in upper]
    return [(*loop.point_mm(angle), cos(angle), sin(angle)) for loop, angle in way]
