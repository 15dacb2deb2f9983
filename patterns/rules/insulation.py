"""Cover thread lies between the stages of the wire wherever they come together."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from patterns.path import Vectors
from patterns.rules.near import near_stretches
from patterns.rules.satin import satin_crossings
from patterns.rules.subject import Subject
from patterns.violation import Violation
from patterns.wire_index import Indices, Numbers, WireIndex

_RULE = "insulation"
INSULATION = _RULE
_TOLERANCE_MM = 0.01
_PLACES = 5
"""Places of a stretch at which the wire that comes near is looked for."""


def check_insulation(subject: Subject) -> list[Violation]:
    """Where a later stage comes near an earlier one, satin sewn between them crosses the earlier.

    The places are found from the paths themselves. A stage that comes near to itself is a short
    circuit too, for no cover can lie there.
    """
    station, block = satin_crossings(subject)
    faults: list[Violation] = []
    for stage in range(len(subject.stages)):
        stretches, on_top = _meetings(subject, stage)
        for later in np.unique(on_top).tolist():
            between = block < subject.laying.get(later, len(subject.plan.blocks))
            crossed = np.sort(station[between] - subject.starts_mm[stage])
            faults.extend(_uncovered(subject, stage, later, stretches[on_top == later], crossed))
    return faults + _check_each_stage(subject)


def _meetings(subject: Subject, stage: int) -> tuple[Vectors, Indices]:
    """Stretches (n, 2) of a stage that later stages come near to, and the first such stage (n,)."""
    later = subject.stage_of_piece > stage
    diameter = np.array(subject.diameters_mm)[subject.stage_of_piece]
    found = [
        _meeting(subject, stage, later & (diameter == one), subject.separation_mm(stage, one))
        for one in np.unique(diameter[later]).tolist()
    ]
    stretches = np.concatenate([np.empty((0, 2)), *(own for own, _ in found)])
    return stretches, np.concatenate([np.empty(0, dtype=np.int64), *(top for _, top in found)])


def _meeting(
    subject: Subject, stage: int, later: NDArray[np.bool_], separation: float
) -> tuple[Vectors, Indices]:
    """Give the same for some pieces of wire, all of one diameter."""
    wire, start = subject.stages[stage], subject.starts_mm[stage]
    stretches = near_stretches(wire, subject.wire, -start, separation, later)
    on_top = np.full(len(stretches), len(subject.stages))
    for share in np.linspace(0.0, 1.0, _PLACES):
        place = stretches[:, 0] + share * (stretches[:, 1] - stretches[:, 0])
        apart = (place + start, np.pi / 2 * separation)
        which, piece = subject.wire.within(wire.at(place), separation, apart, later)
        np.minimum.at(on_top, which, subject.stage_of_piece[piece])
    found = on_top < len(subject.stages)
    return stretches[found], on_top[found]


def _uncovered(
    subject: Subject, stage: int, later: int, stretches: Vectors, crossed: Numbers
) -> list[Violation]:
    largest = subject.stitching.largest_cover_gap_mm
    message = (
        f"short circuit: {_both(subject, stage, later)} of the wire meet, and no cover "
        f"stitches at most {largest:.2f} mm apart lie between them; bare length"
    )
    wire = subject.stages[stage]
    return [_fault(wire, bare, message) for bare in _bare(stretches, crossed, largest)]


def _both(subject: Subject, stage: int, later: int) -> str:
    """Name two stages, of one wire or of two."""
    circuit = subject.circuit
    if len(circuit.parts) == 1:
        return f"stages {stage + 1} and {later + 1}"
    return f"{circuit.stage_name(stage)} and {circuit.stage_name(later)}"


def _check_each_stage(subject: Subject) -> list[Violation]:
    faults: list[Violation] = []
    for k, wire in enumerate(subject.stages):
        message = (
            f"short circuit: {subject.circuit.stage_name(k)} of the wire comes near itself; length"
        )
        separation = subject.separation_mm(k, subject.diameters_mm[k])
        stretches = near_stretches(wire, wire, 0.0, separation)
        faults.extend(_fault(wire, stretch, message) for stretch in stretches)
    return faults


def _fault(wire: WireIndex, stretch_mm: Numbers, message: str) -> Violation:
    x, y = wire.at(np.array([stretch_mm.mean()]))[0]
    bare = float(stretch_mm[1] - stretch_mm[0])
    return Violation(_RULE, message, float(x), float(y), actual=bare, allowed=0.0)


def _bare(stretches: Vectors, crossed: Numbers, largest_gap_mm: float) -> list[Numbers]:
    """Give the parts of the stretches that lie in a gap between crossings longer than allowed."""
    edges = np.concatenate([[-np.inf], crossed, [np.inf]])
    wide = np.flatnonzero(np.diff(edges) > largest_gap_mm)
    start, end = edges[wide], edges[wide + 1]
    bare: list[Numbers] = []
    for a, b in stretches:
        for k in range(np.searchsorted(end, a), np.searchsorted(start, b)):
            part = np.array([max(a, start[k]), min(b, end[k])])
            if part[1] - part[0] > _TOLERANCE_MM:
                bare.append(part)
    return bare
