"""The blocks a plan must have, in the order in which they must be sewn."""

from __future__ import annotations

from patterns.plan import BlockKind
from patterns.rules.subject import Subject
from patterns.violation import Violation

_RULE = "blocks"
_NEEDED = (BlockKind.WIRE_FIRST, BlockKind.COVER, BlockKind.WIRE_SECOND)
_NAME = {
    BlockKind.MARKS: "the registration marks",
    BlockKind.WIRE_FIRST: "the first half of the wire",
    BlockKind.COVER: "the cover between the halves",
    BlockKind.WIRE_SECOND: "the second half of the wire",
}


def check_blocks(subject: Subject) -> list[Violation]:
    """Check for marks (if any), first half, cover, second half: each once, in that order."""
    kinds = [block.kind for block in subject.plan.blocks]
    faults = [
        Violation(_RULE, f"{_NAME[kind]} is missing: no block {kind.value}", 0.0, 0.0)
        for kind in _NEEDED
        if kind not in kinds
    ]
    latest, latest_at = -1, 0
    order = list(BlockKind)
    for i, kind in enumerate(kinds):
        rank = order.index(kind)
        if kind in kinds[:i]:
            faults.append(_fault(subject, i, f"{_NAME[kind]} is sewn a second time"))
        elif rank < latest:
            late = _NAME[kinds[latest_at]]
            faults.append(_fault(subject, i, f"{_NAME[kind]} is sewn too late, after {late}"))
        if rank > latest:
            latest, latest_at = rank, i
    return faults


def _fault(subject: Subject, block: int, message: str) -> Violation:
    needles = subject.needles_mm[block]
    x, y = needles[0] if len(needles) else (0.0, 0.0)
    return Violation(_RULE, message, float(x), float(y), block)
