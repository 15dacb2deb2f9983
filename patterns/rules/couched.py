"""Where along its wire each needle point of the couching lies."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from patterns.locks import POINTS_PER_LOCK
from patterns.path import Vectors
from patterns.rules.subject import Subject
from patterns.stitching import ROUNDING_MM
from patterns.violation import Violation
from patterns.wire_index import Indices, Nearest, Numbers


@dataclass(frozen=True)
class Couched:
    """The needle points of one wire block between its locks, with their places on the wire.

    Attributes
    ----------
    block, stage : int
        Which block of the plan, and which stage it ties down.
    nearest : Nearest
        Place of every needle point of the block on its stage, those of the locks included.
    lead : int
        Needle points of the first lock, before the one that counts.
    station_mm, side_mm : arrays (n,)
        Of the needle points between the locks.
    """

    subject: Subject
    block: int
    stage: int
    nearest: Nearest
    lead: int
    station_mm: Numbers
    side_mm: Numbers

    @property
    def astray(self) -> Indices:
        """Needle points, counted through the block, that are not beside the wire."""
        allowed = ROUNDING_MM + self.subject.stitching.lock_length_mm
        with np.errstate(invalid="ignore"):
            return np.flatnonzero(~(self.nearest.overshoot_mm <= allowed))

    @property
    def needles_mm(self) -> Vectors:
        """Needle points (n, 2) between the locks."""
        end = self.lead + len(self.station_mm)
        return self.subject.needles_mm[self.block][self.lead : end]

    @property
    def rounding_mm(self) -> Numbers:
        """How much rounding can lengthen the advance of each stitch (n - 1,) along the wire.

        Seen from a point at distance d on the inside of a bend of radius R, the wire runs
        R / (R - d) times as far.
        """
        curvature = 1 / self.subject.circuit.smallest_radius_mm
        depth = np.minimum(np.abs(self.side_mm) * curvature, 0.5)
        stretched = ROUNDING_MM / (1 - depth)
        return stretched[1:] + stretched[:-1]

    def fault(self, rule: str, i: int, message: str, actual: float, allowed: float) -> Violation:
        """Report a fault at needle point ``i`` between the locks."""
        found = {"actual": actual, "allowed": allowed}
        return self.subject.fault(rule, message, self.block, self.lead + i, **found)


def couched(subject: Subject) -> Iterator[Couched]:
    """Look at every block that ties down a stage of the circuit."""
    for block, nearest in subject.couching_places.items():
        lead = _lock_points(subject, block, nearest.side_mm, 1)
        trail = _lock_points(subject, block, nearest.side_mm, -1)
        inner = slice(lead, max(len(nearest.side_mm) - trail, lead + 1))
        between = nearest.station_mm[inner], nearest.side_mm[inner]
        yield Couched(subject, block, subject.plan.blocks[block].stage, nearest, lead, *between)


def _lock_points(subject: Subject, block: int, side: Numbers, step: int) -> int:
    """Count the points before the last one at which a lock at one end still goes back and forth.

    Of a head that swings its needle the points lie on the wire, on no side of it.
    """
    needles, side = subject.needles_mm[block][::step], side[::step]
    size = subject.stitching.lock_length_mm + 2 * ROUNDING_MM
    near = np.hypot(*(needles - needles[0]).T) <= size
    swings = subject.machine.couching == "centreline"
    lock = near if swings else near & (side * side[0] > 0)
    count = int(np.argmin(lock)) - 1 if not np.all(lock) else len(needles) - 1
    return min(count, POINTS_PER_LOCK) if swings else count
