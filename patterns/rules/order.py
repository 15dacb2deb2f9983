"""The blocks a plan must have, in the order in which they must be sewn."""

from __future__ import annotations

from patterns.circuit import Circuit
from patterns.plan import BlockKind
from patterns.rules.subject import Subject
from patterns.violation import Violation

_RULE = "blocks"
_Part = tuple[BlockKind, int]


def check_blocks(subject: Subject) -> list[Violation]:
    """Check for marks (if any), stages with a cover before each but the first, stripes and ties.

    Each must be there once, in order, and nothing else; stripes only when they are asked for. The
    cover before a further wire may be left out, for that wire need not touch another. Ties come
    last: those of loops that touch must be there if they are asked for, and those to another layer
    may be; `patterns.rules.contact_ties` and `patterns.rules.ties` say where they must be.
    """
    circuit = subject.circuit
    parts = [(block.kind, block.stage) for block in subject.plan.blocks]
    order = _order(len(circuit.stages), striped=subject.stitching.stripes != "none")
    faults = [
        Violation(_RULE, f"{_name(circuit, part)} is missing: no block {part[0].value}", 0.0, 0.0)
        for part in order[1:]
        if part not in parts and not _may_lack(subject, part)
    ]
    latest, latest_at = -1, 0
    for i, part in enumerate(parts):
        if part not in order:
            faults.append(_fault(subject, i, f"{_name(circuit, part)} is none of the circuit's"))
            continue
        rank = order.index(part)
        if part in parts[:i]:
            faults.append(_fault(subject, i, f"{_name(circuit, part)} is sewn a second time"))
        elif rank < latest:
            late = _name(circuit, parts[latest_at])
            faults.append(
                _fault(subject, i, f"{_name(circuit, part)} is sewn too late, after {late}")
            )
        if rank > latest:
            latest, latest_at = rank, i
    return faults


def _may_lack(subject: Subject, part: _Part) -> bool:
    kind, stage = part
    circuit = subject.circuit
    if kind is BlockKind.TIES:
        return subject.stitching.ties == "none" or not circuit.layout.contacts
    return kind is BlockKind.COVER and circuit.begins_wire(stage)


def _order(stages: int, *, striped: bool) -> list[_Part]:
    """Everything that is sewn, in order; the marks, which need not be, first."""
    wires = [(kind, k) for k in range(stages) for kind in (BlockKind.COVER, BlockKind.WIRE)]
    stripes = [(BlockKind.STRIPES, 0)] if striped else []
    return [(BlockKind.MARKS, 0), *wires[1:], *stripes, (BlockKind.TIES, 0)]


def _name(circuit: Circuit, part: _Part) -> str:
    kind, stage = part
    known = 0 <= stage < len(circuit.stages)
    name = circuit.stage_name(stage) if known else f"stage {stage + 1}"
    names = {
        BlockKind.MARKS: "the registration marks",
        BlockKind.COVER: f"the cover before {name} of the wire",
        BlockKind.WIRE: f"{name} of the wire",
        BlockKind.STRIPES: "the block of stripes",
        BlockKind.TIES: "the block of ties",
    }
    return names[kind]


def _fault(subject: Subject, block: int, message: str) -> Violation:
    needles = subject.needles_mm[block]
    x, y = needles[0] if len(needles) else (0.0, 0.0)
    return Violation(_RULE, message, float(x), float(y), block)
