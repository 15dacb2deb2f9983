"""What a check found wrong, and where."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Violation:
    """One broken rule at one place.

    Attributes
    ----------
    rule : str
        Name of the rule.
    message : str
        What is wrong, for whoever stands at the machine.
    x_mm, y_mm : float
        Where; the centre of the hoop when the fault has no place (a missing block).
    block : int or None
        Index of the block in the plan; None when the fault is not one of the plan.
    stitch : int or None
        Index of the needle point in the block, counted through all its runs.
    actual, allowed : float or None
        What was found and the limit it breaks, in mm unless the message says otherwise.
    """

    rule: str
    message: str
    x_mm: float
    y_mm: float
    block: int | None = None
    stitch: int | None = None
    actual: float | None = None
    allowed: float | None = None

    def __str__(self) -> str:
        """Give one line for the terminal; blocks and stitches are counted from 1 there."""
        where = f"at ({self.x_mm:.2f}, {self.y_mm:.2f}) mm"
        if self.block is not None:
            where += f", block {self.block + 1}"
        if self.stitch is not None:
            where += f", stitch {self.stitch + 1}"
        found = "" if self.actual is None else f": {self.actual:.3f}"
        limit = "" if self.allowed is None else f" (allowed {self.allowed:.3f})"
        return f"{self.rule}: {self.message} {where}{found}{limit}"
