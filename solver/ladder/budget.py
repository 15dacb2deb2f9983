"""How much work one answer may take on meshes before it is refused.

Work is counted, not timed: the same scene has the same answer on every machine.
"""

from __future__ import annotations

MOST_WORK = 600_000
"""Steps times vertices, with the weights below: about 20 s of one processor."""

_WITH_BENDING = 6.0
"""What a step on fabric that resists bending costs, over one on fabric that does not."""
_IN_CONTACT = 1.5
"""The same of a step with barriers."""
_FEWEST_STEPS = 20
"""With fewer left a mesh is not begun; what was begun may take so many."""


class Budget:
    """Work that is left, in steps times vertices.

    Attributes
    ----------
    work : float
    ran_short : bool
        Whether a solve was given fewer steps than it asked for, or a mesh was not begun.
    """

    def __init__(self, work: float = MOST_WORK) -> None:
        self.work = float(work)
        self.ran_short = False

    def _steps_left(self, vertices: int, alpha: float, *, contact: bool) -> int:
        return int(self.work / (vertices * _cost(alpha, contact=contact)))

    def allows(self, vertices: int, alpha: float, *, contact: bool = False) -> bool:
        """Whether enough is left to begin a mesh of so many vertices."""
        enough = self._steps_left(vertices, alpha, contact=contact) >= _FEWEST_STEPS
        self.ran_short |= not enough
        return enough

    def steps(self, asked: int, vertices: int, alpha: float, *, contact: bool = False) -> int:
        """Steps, of so many asked for, that a solve on so many vertices may take."""
        left = max(self._steps_left(vertices, alpha, contact=contact), _FEWEST_STEPS)
        self.ran_short |= left < asked
        return min(left, asked)

    def spend(self, work: float, alpha: float, *, contact: bool = False) -> None:
        """Count the steps times vertices that a solve took."""
        self.work -= work * _cost(alpha, contact=contact)


def _cost(alpha: float, *, contact: bool) -> float:
    return (_WITH_BENDING if alpha > 0 else 1.0) * (_IN_CONTACT if contact else 1.0)
