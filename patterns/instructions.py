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

MARKS_TEXT = "a thread that stands out against the fabric: the registration marks."
STRIPES_TEXT = "a thread that does not stretch: stripes across the loops, over the laid wire."


def with_thread(machine: Machine, what: str) -> str:
    """Say what is done with thread alone: on machines without heads, under the usual foot."""
    return f"{'Embroidery foot' if machine.hand_guided else 'Thread head'}, {what}"


@dataclass(frozen=True)
class Instructions:
    """Words for the blocks of one circuit or several.

    Attributes
    ----------
    circuit : Circuit
    diameters_mm : tuple of float
        Wire diameter of each stage.
    machine : Machine
    satin : sequence of sequences of arrays (n, 2)
        Needle points in mm of the covers before the second stage, the third, and so on.
    """

    circuit: Circuit
    diameters_mm: tuple[float, ...]
    machine: Machine
    satin: Sequence[Sequence[Vectors]]

    def wire(self, stage: int) -> str:
        """Before a stage of the wire."""
        whose = "" if len(self.circuit.parts) > 1 else " of the wire"
        laid = f"{self._name(stage)}{whose} is laid."
        if self.circuit.begins_wire(stage):
            text = f"{self._load(stage)} {laid}"
        else:
            text = f"{self._head}, the same wire: take the slack back. {laid}"
        if not self.circuit.ends_wire(stage):
            return text
        return (
            f"{text} Then cut the wire {FREE_TAIL_MM:g} mm beyond the last stitch, and crimp both "
            f"tails after release."
        )

    def cover(self, stage: int) -> str:
        """Before the cover on which a stage will lie."""
        count = len(self.satin[stage - 1])
        satin = with_thread(
            self.machine,
            f"cover thread: satin on the laid wire for {self._lowered(self._name(stage))}, "
            f"{count} crossing{'s' if count > 1 else ''}.",
        )
        if self.circuit.begins_wire(stage):
            return satin
        return (
            f"Do not cut the wire: pull out at least {self._slack_mm(stage)} mm of slack and hold "
            f"it clear of the needle. {satin}"
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

    def _load(self, stage: int) -> str:
        """Mount the wire that begins with a stage."""
        part = self.circuit.part_of_stage[stage]
        slack = max((self._slack_mm(later) for later in self._own(stage)[1:]), default=0)
        return (
            f"{self._head}: load at least {ceil(self.circuit.parts[part].wire_length_mm)} mm of "
            f"{self.diameters_mm[stage]:g} mm wire, both tails included, and {slack} mm of slack. "
            f"Let {FREE_TAIL_MM:g} mm of wire stand out behind the needle, for the crimp."
        )

    def _own(self, stage: int) -> list[int]:
        """Stages of the wire that a stage is of."""
        of_stage = self.circuit.part_of_stage
        return [k for k, part in enumerate(of_stage) if part == of_stage[stage]]

    def _name(self, stage: int) -> str:
        """Name a stage as "Stage 1 of 2", and its circuit if it has a name."""
        number, _, circuit = self.circuit.stage_name(stage).partition(" of ")
        name = f"{number.capitalize()} of {len(self._own(stage))}"
        return f"{name} of {circuit}" if circuit else name

    @staticmethod
    def _lowered(name: str) -> str:
        return name[:1].lower() + name[1:]

    def _slack_mm(self, stage: int) -> int:
        """How far the cover's needle goes from where the wire hangs."""
        hangs, _ = self.circuit.stages[stage].at(0.0)
        return ceil(np.hypot(*(np.concatenate(list(self.satin[stage - 1])) - hangs).T).max())
