"""The stitch plan: what the needle does, in whole machine units, block by block."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

UNITS_PER_MM = 10
"""Stitch files count in 0.1 mm (Tajima DST)."""

Points = NDArray[np.int64]
"""Needle points, shape (n, 2), in units of 0.1 mm, y pointing away from the operator."""


def quantise(points_mm: NDArray[np.float64]) -> Points:
    """Round millimetres to machine units, halves upward on both sides of zero."""
    return np.floor(UNITS_PER_MM * np.asarray(points_mm, dtype=float) + 0.5).astype(np.int64)


class BlockKind(StrEnum):
    """What a block of stitches is for."""

    MARKS = "marks"
    WIRE = "wire"
    COVER = "cover"
    STRIPES = "stripes"
    TIES = "ties"

    @property
    def is_wire(self) -> bool:
        """Whether the wire head is at work: no trim, no jump."""
        return self is BlockKind.WIRE


@dataclass(frozen=True)
class Run:
    """Stitches without a jump between them.

    Attributes
    ----------
    approach : tuple of int
        Where the jumps before the run end; the first stitch goes from there to ``needles[0]``.
    needles : Points
        Where the needle goes in.
    """

    approach: tuple[int, int]
    needles: Points


@dataclass(frozen=True)
class Block:
    """Runs sewn with one head and thread, between two stops of the machine.

    Attributes
    ----------
    instruction : str
        What the operator does at the stop before the block.
    stage : int
        Of wire, which stage of the circuit is laid, from 0; of a cover, the stage that is laid next
        on top of it; of marks, stripes and ties, 0.
    """

    kind: BlockKind
    instruction: str
    runs: tuple[Run, ...]
    stage: int = 0


@dataclass(frozen=True)
class StitchPlan:
    """Blocks in the order in which they are sewn; the origin is the centre of the hoop."""

    blocks: tuple[Block, ...]
