"""What the operator does at the stop before each block."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil

import numpy as np

from patterns.circuit import Circuit
from patterns.couching import FREE_TAIL_MM
from patterns.machine import Machine
from patterns.path import Vectors

MARKS_TEXT = "Thread head, a thread that stands out against the fabric: the registration marks."

STRIPES_TEXT = (
    "Thread head, a thread that does not stretch: stripes across the loops, over the laid wire."
)


@dataclass(frozen=True)
class Instructions:
    """Words for the blocks of a circuit.

    Attributes
    ----------
    circuit : Circuit
    wire_diameter_mm : float
    machine : Machine
    satin : sequence of sequences of arrays (n, 2)
        Needle points in mm of the covers before the second stage, the third, and so on.
    """

    circuit: Circuit
    wire_diameter_mm: float
    machine: Machine
    satin: Sequence[Sequence[Vectors]]

    def wire(self, stage: int) -> str:
        """Before a stage of the wire."""
        laid = f"{self._name(stage)} of the wire is laid."
        if stage == 0:
            slack = max(self._slack_mm(later) for later in range(1, self._count))
            return (
                f"{self._head}: load at least {ceil(self.circuit.wire_length_mm)} mm of "
                f"{self.wire_diameter_mm:g} mm wire, both tails included, and {slack} mm of slack. "
                f"Let {FREE_TAIL_MM:g} mm of wire stand out behind the needle, for the crimp. "
                f"{laid}"
            )
        text = f"{self._head}, the same wire: take the slack back. {laid}"
        if stage < self._count - 1:
            return text
        return (
            f"{text} Then cut the wire {FREE_TAIL_MM:g} mm beyond the last stitch, and crimp both "
            f"tails after release."
        )

    def cover(self, stage: int) -> str:
        """Before the cover on which a stage will lie."""
        count = len(self.satin[stage - 1])
        return (
            f"Do not cut the wire: pull out at least {self._slack_mm(stage)} mm of slack and hold "
            f"it clear of the needle. Thread head, cover thread: satin on the laid wire for "
            f"{self._name(stage).lower()}, {count} crossing{'s' if count > 1 else ''}."
        )

    @property
    def _head(self) -> str:
        """Name what lays the wire, and how it is to be set."""
        if self.machine.hand_guided:
            return (
                "Presser foot for cording, wire led by hand along the middle of the zigzag, slowly"
            )
        if self.machine.couching == "centreline":
            return f"Wire head, swing set to {self.machine.swing_mm:g} mm"
        return "Wire head"

    @property
    def _count(self) -> int:
        return len(self.circuit.stages)

    def _name(self, stage: int) -> str:
        return f"Stage {stage + 1} of {self._count}"

    def _slack_mm(self, stage: int) -> int:
        """How far the cover's needle goes from where the wire hangs."""
        hangs, _ = self.circuit.stages[stage].at(0.0)
        return ceil(np.hypot(*(np.concatenate(list(self.satin[stage - 1])) - hangs).T).max())
