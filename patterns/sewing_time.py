"""How long a plan takes to sew."""

from __future__ import annotations

from patterns.plan import StitchPlan


def sewing_time_s(
    plan: StitchPlan, speed_spm: float, wire_speed_spm: float, stop_time_s: float
) -> float:
    """Estimate the time on the machine, without jumps.

    Parameters
    ----------
    speed_spm, wire_speed_spm
        Stitches per minute with thread, and with wire.
    stop_time_s
        What the operator takes before every block, the first included.
    """
    seconds = stop_time_s * len(plan.blocks)
    for block in plan.blocks:
        speed = wire_speed_spm if block.kind.is_wire else speed_spm
        seconds += 60 * sum(len(run.needles) for run in block.runs) / speed
    return seconds
