"""Solve a sweep's chunks in this process, one after the other."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from sesame_cad.sweeps.outcome import Outcome
from sesame_cad.sweeps.plan import SweepPlan, solve_chunk

Save = Callable[[int, list[Outcome]], None]


def solve_here(plan: SweepPlan, chunks: Sequence[int], save: Save) -> None:
    """Solve chunks, and hand over each as it is done."""
    for index in chunks:
        save(index, solve_chunk(plan.model, plan.keys, plan.chunk(index)))
