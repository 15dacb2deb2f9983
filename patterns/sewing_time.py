"""How long a plan takes to sew."""

from __future__ import annotations

from dataclasses import dataclass

from patterns.plan import Block, StitchPlan


@dataclass(frozen=True, slots=True)
class SewingPace:
    """How fast machine and operator work; jumps take no time.

    Attributes
    ----------
    thread_spm, wire_spm : float
        Stitches per minute with thread, and with wire.
    stop_time_s : float
        What the operator takes before every block, the first included.
    """

    thread_spm: float
    wire_spm: float
    stop_time_s: float

    def block_s(self, block: Block) -> float:
        """Time for a block and the stop before it."""
        speed = self.wire_spm if block.kind.is_wire else self.thread_spm
        return self.stop_time_s + 60 * sum(len(run.needles) for run in block.runs) / speed

    def plan_s(self, plan: StitchPlan) -> float:
        """Time for a whole plan."""
        return sum(self.block_s(block) for block in plan.blocks)
